/* An FMU's library called by a C program: driver LIBRARY GUID RATE FORCE PARAMETER INTEGER, the last four being value
   references. Prints a line for each check; the exit status is the number of those that failed. */
#include "unit.h"

#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct unit fmi;
const char *guid;
fmi2ValueReference rate, force, parameter, integer;

static int failed;

void check(const char *name, bool good) {
    printf("%s %s\n", good ? "ok" : "FAIL", name);
    failed += !good;
}

/* printf conversions, and the character with which a message refers to a variable: no part of a name may be taken for one */
const char instance_name[] = "100%n %s #r1#";
int environment;

int messages, wrong_messages;
char last_message[1024];

/* Whether printf prints the text without reading arguments, and no part of it refers to a variable. */
static bool is_complete(const char *text) {
    for (; *text != 0; text++) {
        if (*text == '%' || *text == '#') {
            if (text[1] != *text) {
                return false;
            }
            text++;
        }
    }
    return true;
}

/* A message has a declared category, is complete without arguments, and is one line without a line end. */
static bool is_good(fmi2Status status, const char *category, const char *message) {
    static const char *const categories[] = {"logStatusError", "logStatusDiscard", "logStatusWarning"};
    static const fmi2Status statuses[] = {fmi2Error, fmi2Discard, fmi2Warning};
    if (category == NULL || message == NULL || !is_complete(message) || *message == 0 || strchr(message, '\n') != NULL) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        if (strcmp(category, categories[i]) == 0) {
            return status == statuses[i];
        }
    }
    return false;
}

void logger(fmi2ComponentEnvironment given, fmi2String name, fmi2Status status, fmi2String category,
            fmi2String message, ...) {
    messages++;
    if (given != &environment || name == NULL || strcmp(name, instance_name) != 0 || !is_good(status, category, message)) {
        printf("wrong message: %s %s %s\n", name ? name : "-", category ? category : "-", message ? message : "-");
        wrong_messages++;
        return;
    }
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(last_message, sizeof last_message, message, arguments);
    va_end(arguments);
}

int forbidden_calls;

static void *allocate(size_t number, size_t size) {
    forbidden_calls++;
    return calloc(number, size);
}

static void release(void *memory) {
    forbidden_calls++;
    free(memory);
}

static void finished(fmi2ComponentEnvironment given, fmi2Status status) {
    (void)given;
    (void)status;
    forbidden_calls++;
}

const fmi2CallbackFunctions callbacks = {logger, allocate, release, finished, &environment};

fmi2Component instantiate(void) {
    return fmi.Instantiate(instance_name, fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2True);
}

fmi2Component ready(void) {
    fmi2Component c = instantiate();
    if (c == NULL || fmi.SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0) != fmi2OK ||
        fmi.EnterInitializationMode(c) != fmi2OK || fmi.ExitInitializationMode(c) != fmi2OK) {
        printf("FAIL an instance can be made: %s\n", last_message);
        exit(1);
    }
    return c;
}

fmi2Status set_rate(fmi2Component c, double value) { return fmi.SetReal(c, &rate, 1, &value); }

double get(fmi2Component c, fmi2ValueReference reference) {
    double value = -1e300;
    return fmi.GetReal(c, &reference, 1, &value) == fmi2OK ? value : -1e300;
}

double step(fmi2Component c, int number, double value) {
    const double size = 1e-7;
    if (set_rate(c, value) != fmi2OK || fmi.DoStep(c, number * size, size, fmi2True) != fmi2OK) {
        return -1e300;
    }
    return get(c, force);
}

/* A pointer to a function is not a pointer to an object, but POSIX guarantees the same bytes. */
static bool load(void *library, const char *name, void *function) {
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

int main(int count, char **arguments) {
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (count != 7) {
        fprintf(stderr, "usage: driver LIBRARY GUID RATE FORCE PARAMETER INTEGER\n");
        return 2;
    }
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        printf("FAIL the library can be loaded: %s\n", dlerror());
        return 1;
    }
    bool complete = true;
#define LOAD(name) complete &= load(library, "fmi2" #name, &fmi.name);
    FUNCTIONS(LOAD)
    check("all functions are found", complete);
    if (!complete) {
        return 1;
    }
    guid = arguments[2];
    fmi2ValueReference *const references[] = {&rate, &force, &parameter, &integer};
    for (int i = 0; i < 4; i++) {
        *references[i] = (fmi2ValueReference)strtoul(arguments[3 + i], NULL, 10);
    }
    check("version and platform", strcmp(fmi.GetVersion(), "2.0") == 0 && strcmp(fmi.GetTypesPlatform(), "default") == 0);

    check_instances();
    check_memory();

    check("messages were logged", messages > 2);
    check("every message is complete, of one line, of a declared category, from the right instance", wrong_messages == 0);
    check("the importer's memory functions and stepFinished were never called", forbidden_calls == 0);
    check("the library can be unloaded", dlclose(library) == 0);
    return failed;
}
