/* An FMU's library in a host: host LIBRARY GUID INPUT[,INPUT...] OUTPUT... < HISTORY

   INPUT and OUTPUT are value references. Each line of HISTORY contains the value of all inputs and a step [s], each as the
   16 hexadecimal digits of its bits. The outputs after each step are printed in the same format. The second half is repeated
   from a state that was serialized. After the word "end", the program prints the host, how often the FMU allocated and freed
   memory of the importer, and the message of a rejected call. The exit status is 0 if every call succeeded as expected. */
#include "load.h"
#include "unit.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct unit fmi_of_host;
static char message[512];
static int taken, given_back;

static void *take(size_t count, size_t size) {
    taken++;
    return calloc(count, size);
}

static void give_back(void *memory) {
    given_back++;
    free(memory);
}

/* The library sends complete messages, which a host in C can print unchanged. */
static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                        fmi2String text, ...) {
    (void)environment;
    va_list arguments;
    va_start(arguments, text);
    int length = snprintf(message, sizeof message, "%s %d %s ", name, (int)status, category);
    vsnprintf(message + length, sizeof message - (size_t)length, text, arguments);
    va_end(arguments);
}

static void demand(bool good, const char *what) {
    if (!good) {
        printf("FAIL %s: %s\n", what, message);
        exit(1);
    }
}

static double number(const char *digits) {
    uint64_t bits = strtoull(digits, NULL, 16);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

struct step {
    double input, size;
};

struct way {
    fmi2ValueReference inputs[64], outputs[64];
    size_t input_count, output_count, step_count;
    struct step *steps;
};

/* Runs from step `first` to the end; `values` receives the outputs of all steps. */
static void go(fmi2Component c, const struct way *way, size_t first, double *values) {
    double time = 0.0;
    for (size_t i = 0; i < way->step_count; i++) {
        const struct step *step = &way->steps[i];
        if (i >= first) {
            double rates[64];
            for (size_t j = 0; j < way->input_count; j++) {
                rates[j] = step->input;
            }
            demand(fmi_of_host.SetReal(c, way->inputs, way->input_count, rates) == fmi2OK, "SetReal");
            demand(fmi_of_host.DoStep(c, time, step->size, fmi2True) == fmi2OK, "DoStep");
            double *row = values + i * way->output_count;
            demand(fmi_of_host.GetReal(c, way->outputs, way->output_count, row) == fmi2OK, "GetReal");
        }
        time += step->size;
    }
}

/* Repeats the second half from the bytes of a state. */
static void go_twice(fmi2Component c, struct way *way, double *values) {
    const size_t all = way->step_count, middle = all / 2, size = all * way->output_count * sizeof *values;
    fmi2FMUstate state = NULL, copy = NULL;
    size_t length = 0;
    way->step_count = middle;
    go(c, way, 0, values);
    way->step_count = all;
    demand(fmi_of_host.GetFMUstate(c, &state) == fmi2OK, "GetFMUstate");
    demand(fmi_of_host.SerializedFMUstateSize(c, state, &length) == fmi2OK, "SerializedFMUstateSize");
    char *bytes = malloc(length);
    double *again = malloc(size);
    go(c, way, middle, values);
    memcpy(again, values, size);
    demand(fmi_of_host.SerializeFMUstate(c, state, bytes, length) == fmi2OK, "SerializeFMUstate");
    demand(fmi_of_host.DeSerializeFMUstate(c, bytes, length, &copy) == fmi2OK, "DeSerializeFMUstate");
    demand(fmi_of_host.SetFMUstate(c, copy) == fmi2OK, "SetFMUstate");
    memset(again + middle * way->output_count, 0, size - middle * way->output_count * sizeof *values);
    go(c, way, middle, again);
    demand(memcmp(again, values, size) == 0, "the same bits after restoring");
    demand(fmi_of_host.FreeFMUstate(c, &state) == fmi2OK && fmi_of_host.FreeFMUstate(c, &copy) == fmi2OK, "FreeFMUstate");
    free(bytes);
    free(again);
}

static void read_history(struct way *way) {
    char input[32], size[32];
    size_t room = 1024;
    way->steps = malloc(room * sizeof *way->steps);
    while (scanf("%31s %31s", input, size) == 2) {
        if (way->step_count == room) {
            room *= 2;
            way->steps = realloc(way->steps, room * sizeof *way->steps);
        }
        way->steps[way->step_count++] = (struct step){number(input), number(size)};
    }
}

static void print(const struct way *way, const double *values) {
    for (size_t i = 0; i < way->step_count * way->output_count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        printf("%016" PRIx64 "%c", bits, (i + 1) % way->output_count == 0 ? '\n' : ' ');
    }
}

int main(int count, char **arguments) {
    if (count < 5 || count > 4 + 64) {
        fprintf(stderr, "usage: host LIBRARY GUID INPUT[,INPUT...] OUTPUT...\n");
        return 2;
    }
    struct way way = {.output_count = (size_t)count - 4};
    for (char *next = arguments[3]; *next != '\0' && way.input_count < 64; next += strcspn(next, ",") + 1) {
        way.inputs[way.input_count++] = (fmi2ValueReference)strtoul(next, NULL, 10);
        if (next[strcspn(next, ",")] == '\0') {
            break;
        }
    }
    for (int i = 4; i < count; i++) {
        way.outputs[i - 4] = (fmi2ValueReference)strtoul(arguments[i], NULL, 10);
    }
    read_history(&way);
    void *library = load_library(arguments[1], message, sizeof message);
    demand(library != NULL, "the library can be loaded");
#define LOAD(name) demand(load_function(library, "fmi2" #name, &fmi_of_host.name), "fmi2" #name);
    FUNCTIONS(LOAD)
    demand(strcmp(fmi_of_host.GetVersion(), "2.0") == 0, "GetVersion");
    demand(strcmp(fmi_of_host.GetTypesPlatform(), "default") == 0, "GetTypesPlatform");

    const fmi2CallbackFunctions callbacks = {log_message, take, give_back, NULL, NULL};
    fmi2Component c = fmi_of_host.Instantiate("host", fmi2CoSimulation, arguments[2], "", &callbacks, fmi2False, fmi2True);
    demand(c != NULL, "Instantiate");
    demand(fmi_of_host.SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK, "SetupExperiment");
    demand(fmi_of_host.EnterInitializationMode(c) == fmi2OK, "EnterInitializationMode");
    demand(fmi_of_host.ExitInitializationMode(c) == fmi2OK, "ExitInitializationMode");
    double *values = malloc((way.step_count + 1) * way.output_count * sizeof *values);
    go_twice(c, &way, values);
    print(&way, values);

    fmi2ValueReference unknown = 1000000;
    demand(fmi_of_host.GetReal(c, &unknown, 1, values) == fmi2Error, "an unknown reference is refused");
    fmi_of_host.FreeInstance(c);
    unload_library(library);
    free(values);
    free(way.steps);
    printf("end\n%s\nmemory %d %d\n%s\n", host_name(), taken, given_back, message);
    return 0;
}
