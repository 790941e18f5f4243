/* An FMU with a loss below yield, used by a C program: losses LIBRARY GUID KIND NAME=REFERENCE..., where KIND is "fitted", "waves"
   or "plate". Prints a line for each check; the exit status is the number of those that failed. */
#include "fmi2Functions.h"

#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FUNCTIONS(X) \
    X(Instantiate) X(FreeInstance) X(SetupExperiment) X(EnterInitializationMode) X(ExitInitializationMode) X(Reset) \
    X(GetReal) X(SetReal) X(DoStep) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) X(SerializedFMUstateSize) \
    X(SerializeFMUstate) X(DeSerializeFMUstate)
#define MEMBER(name) fmi2##name##TYPE *name;
static struct { FUNCTIONS(MEMBER) } fmi;

static const char *guid;
static int failed;
static char last_message[1024];

static void check(const char *name, bool good) {
    printf("%s %s\n", good ? "ok" : "FAIL", name);
    failed += !good;
}

/* as a check, with the number that failed it */
static void within(const char *name, double error, double bound) {
    char text[200];
    snprintf(text, sizeof text, "%s: %.1e of %.0e", name, error, bound);
    check(text, error <= bound);
}

static void logger(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String message, ...) {
    (void)e, (void)n, (void)s, (void)c;
    snprintf(last_message, sizeof last_message, "%s", message);
}

/* the outputs, whose places are those of their references; the parameter is absent for waves */
enum { FORCE, INDENTATION, WORK, ELASTIC, LOST, MEAN, OUTPUTS };
static const char *const names[] = {"force", "indentation", "work", "elastic_energy", "dissipated_energy", "mean_force"};
static fmi2ValueReference outputs[OUTPUTS], rate, parameter;
static const char *parameter_name;

static fmi2Component instantiate(void) {
    static fmi2CallbackFunctions const callbacks = {logger, NULL, NULL, NULL, NULL};
    return fmi.Instantiate("one", fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2True);
}

static void initialize(fmi2Component c) {
    bool const good = fmi.SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK &&
                      fmi.EnterInitializationMode(c) == fmi2OK && fmi.ExitInitializationMode(c) == fmi2OK;
    if (!good) {
        printf("FAIL initialization: %s\n", last_message);
        exit(1);
    }
}

static fmi2Component ready(void) {
    fmi2Component c = instantiate();
    initialize(c);
    return c;
}

static double get(fmi2Component c, int output) {
    double value = NAN;
    return fmi.GetReal(c, &outputs[output], 1, &value) == fmi2OK ? value : NAN;
}

static bool set(fmi2Component c, fmi2ValueReference reference, double value) {
    return fmi.SetReal(c, &reference, 1, &value) == fmi2OK;
}

/* An impact in three legs, of which each ends in contact: rates and times. */
enum { LEGS = 3 };
static const double rates[LEGS] = {0.5, -0.3, 0.45}, times[LEGS] = {4e-5, 1e-5, 3e-5};

/* What happened on the way. */
struct trace {
    double ends[LEGS][OUTPUTS];
    /* the sum of mean force times way, that of the trapezoids, and the largest errors, relative to the work */
    double work, trapezoids, size, balance, least_heat;
};

/* One leg in `count` steps; its time is that of the instance before. */
static double leg(fmi2Component c, int which, int count, double time, struct trace *trace) {
    double const step = times[which] / count, way = rates[which] * step;
    for (int i = 0; i < count; i++) {
        double const lost = get(c, LOST);
        bool const good = set(c, rate, rates[which]);
        /* the force at the start of the step follows the new rate */
        double const before = get(c, FORCE);
        if (!good || fmi.DoStep(c, time, step, fmi2True) != fmi2OK) {
            check(last_message, false);
            return NAN;
        }
        time += step;
        double const mean = get(c, MEAN);
        trace->work += mean * way;
        trace->trapezoids += 0.5 * (before + get(c, FORCE)) * way;
        trace->size += fabs(mean * way);
        trace->balance = fmax(trace->balance, fabs(get(c, WORK) - get(c, ELASTIC) - get(c, LOST)));
        trace->balance = fmax(trace->balance, fabs(get(c, WORK) - trace->work));
        trace->least_heat = fmin(trace->least_heat, get(c, LOST) - lost);
    }
    for (int i = 0; i < OUTPUTS; i++) {
        trace->ends[which][i] = get(c, i);
    }
    return time;
}

static struct trace impact(fmi2Component c, int count) {
    struct trace trace = {0};
    double time = 0;
    for (int which = 0; which < LEGS; which++) {
        time = leg(c, which, count, time, &trace);
    }
    return trace;
}

static bool same(struct trace const *one, struct trace const *other) { return memcmp(one, other, sizeof *one) == 0; }

static void steps(bool plate) {
    static const int counts[] = {1, 7, 100, 1000};
    struct trace first = {0};
    for (int i = 0; i < 4; i++) {
        fmi2Component c = ready();
        struct trace const trace = impact(c, counts[i]);
        fmi.FreeInstance(c);
        printf("ok --- %d steps: %g N, %g J lost\n", counts[i], trace.ends[LEGS - 1][FORCE], trace.ends[LEGS - 1][LOST]);
        check("it presses, stores and loses", trace.ends[0][FORCE] > 10 && trace.ends[0][ELASTIC] > 0 && trace.least_heat >= 0 &&
                                                  trace.ends[LEGS - 1][LOST] > 0);
        within("work is stored or lost", trace.balance / trace.size, 1e-9);
        if (i == 0) {
            first = trace;
        }
        double worst = 0;
        for (int which = 0; which < LEGS; which++) {
            for (int output = 0; output < MEAN; output++) {
                double const size = output == FORCE || output == INDENTATION ? first.ends[0][output] : first.size;
                worst = fmax(worst, fabs(trace.ends[which][output] - first.ends[which][output]) / size);
            }
        }
        within("as in one step", worst, plate ? 1e-9 : 1e-11);
    }
    fmi2Component c = ready();
    struct trace const trace = impact(c, 1000);
    fmi.FreeInstance(c);
    within("the force is that of the work", fabs(trace.trapezoids / trace.work - 1), 1e-5);
}

/* The force at another rate, without a step. */
static double force_at(fmi2Component c, double value) { return set(c, rate, value) ? get(c, FORCE) : NAN; }

static void force_follows(const char *kind) {
    fmi2Component c = ready();
    struct trace trace = {0};
    leg(c, 0, 10, 0, &trace);
    double const fast = force_at(c, 0.5), slow = force_at(c, 0.25), still = force_at(c, 0), back = force_at(c, -0.5);
    if (strcmp(kind, "plate") == 0) {
        check("the force on a plate doesn't follow the rate", fast == slow && slow == still && still == back);
    } else {
        within("the force follows the rate", fabs((slow - still) / (fast - still) - 0.5), 1e-12);
        within("also to the other side", fabs((still - back) / (fast - still) - 1), 1e-12);
        check("faster is harder", fast > 1.0001 * still);
        check("the same rate gives the same bits", force_at(c, 0.5) == fast);
    }
    if (strcmp(kind, "fitted") == 0) {
        double const e = 0.9, chi = fast / still - 1;
        within("by the factor of Hunt and Crossley", fabs((1 + chi) / (1 - chi * e) / exp(chi * (1 + e)) - 1), 1e-13);
    }
    fmi.FreeInstance(c);
}

/* Saved in contact, within the second leg: the instance, and another one from the bytes, go on with the same bits. */
static void states(void) {
    fmi2Component c = ready(), other = ready();
    struct trace lost = {0}, one = {0}, two = {0}, three = {0};
    double const time = leg(c, 1, 9, leg(c, 0, 9, 0, &lost), &lost);
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    bool good = fmi.GetFMUstate(c, &state) == fmi2OK && fmi.SerializedFMUstateSize(c, state, &size) == fmi2OK;
    char *bytes = calloc(1, size);
    good &= fmi.SerializeFMUstate(c, state, bytes, size) == fmi2OK;
    good &= fmi.DeSerializeFMUstate(other, bytes, size, &copy) == fmi2OK;
    leg(c, 2, 50, time, &one);
    good &= fmi.SetFMUstate(c, state) == fmi2OK && fmi.SetFMUstate(other, copy) == fmi2OK;
    leg(c, 2, 50, time, &two);
    leg(other, 2, 50, time, &three);
    check("a state is saved, loaded, and becomes bytes", good && one.size > 0);
    check("a loaded state goes on with the same bits", same(&one, &two));
    check("and so does another instance", same(&one, &three));
    good = fmi.FreeFMUstate(c, &state) == fmi2OK && fmi.FreeFMUstate(other, &copy) == fmi2OK;
    check("states are freed", good && state == NULL && copy == NULL);
    free(bytes);
    fmi.FreeInstance(c);
    fmi.FreeInstance(other);
}

static void resets(void) {
    fmi2Component c = ready();
    struct trace const first = impact(c, 40);
    bool const good = fmi.Reset(c) == fmi2OK;
    initialize(c);
    struct trace const second = impact(c, 40);
    check("after a reset the impact has the same bits", good && same(&first, &second));
    fmi.FreeInstance(c);
}

/* Whether the FMU refuses the value with a message that contains `said`; it then needs a reset. */
static bool refuses(fmi2Component c, fmi2ValueReference reference, double value, const char *said) {
    last_message[0] = 0;
    bool const good = !set(c, reference, value) && strstr(last_message, said) != NULL;
    if (!good) {
        printf("value %g, message \"%s\"\n", value, last_message);
    }
    return good && fmi.Reset(c) == fmi2OK;
}

static void parameters(bool plate) {
    static const double wrong[] = {-1, 0, 1e-4, 1.0000001, NAN, INFINITY, -INFINITY};
    static const double too_thin[] = {-1, 0, -0.0, NAN, INFINITY, -INFINITY};
    fmi2Component c = instantiate();
    bool good = true;
    for (size_t i = 0; i < (plate ? sizeof too_thin : sizeof wrong) / sizeof(double); i++) {
        good &= refuses(c, parameter, (plate ? too_thin : wrong)[i], parameter_name);
    }
    check("wrong values are refused with the name of the parameter", good);
    initialize(c);
    struct trace const before = impact(c, 20);
    check("the parameter is refused during the simulation", refuses(c, parameter, plate ? 0.02 : 0.8, parameter_name));
    check("a value is taken", set(c, parameter, plate ? 2e-3 : 0.5));
    initialize(c);
    struct trace const after = impact(c, 20);
    /* a thinner plate gives way before the force grows */
    check("and changes the loss", plate ? after.ends[0][FORCE] < 0.99 * before.ends[0][FORCE]
                                        : after.ends[0][LOST] > 1.01 * before.ends[0][LOST]);
    check("it is forgotten by a reset", fmi.Reset(c) == fmi2OK);
    initialize(c);
    struct trace const again = impact(c, 20);
    check("to the bit", same(&before, &again));
    fmi.FreeInstance(c);
}

/* A pointer to a function is not a pointer to an object, but POSIX guarantees the same bytes. */
static bool load(void *library, const char *name, void *function) {
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

static bool reference_of(int count, char **arguments, const char *name, fmi2ValueReference *reference) {
    size_t const length = strlen(name);
    for (int i = 4; i < count; i++) {
        if (strncmp(arguments[i], name, length) == 0 && arguments[i][length] == '=') {
            *reference = (fmi2ValueReference)strtoul(arguments[i] + length + 1, NULL, 10);
            return true;
        }
    }
    return false;
}

int main(int count, char **arguments) {
    void *library = count > 4 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    bool good = library != NULL;
#define LOAD(name) good = good && load(library, "fmi2" #name, &fmi.name);
    FUNCTIONS(LOAD)
    good = good && reference_of(count, arguments, "indentation_rate", &rate);
    for (int i = 0; i < OUTPUTS; i++) {
        good = good && reference_of(count, arguments, names[i], &outputs[i]);
    }
    if (!good) {
        printf("FAIL library, functions and variables are found\n");
        return 1;
    }
    guid = arguments[2];
    const char *const kind = arguments[3];
    bool const plate = strcmp(kind, "plate") == 0;
    parameter_name = plate ? "target.plate_thickness" : "elastic_restitution";
    bool const has_parameter = reference_of(count, arguments, parameter_name, &parameter);
    check("the loss has its parameter", has_parameter == (strcmp(kind, "waves") != 0));
    steps(plate);
    force_follows(kind);
    states();
    resets();
    if (has_parameter) {
        parameters(plate);
    }
    return failed;
}
