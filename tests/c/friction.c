/*
 * An importer in C with a contact that has friction, in one or two tangential directions:
 * friction LIBRARY GUID RATE FORCE COEFFICIENT {TANGENTIAL_RATE TANGENTIAL_FORCE}...
 */
#include "fmi2Functions.h"

#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FUNCTIONS(X) \
    X(Instantiate) X(FreeInstance) X(SetupExperiment) X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) \
    X(SetReal) X(GetReal) X(DoStep) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) X(SerializedFMUstateSize) \
    X(SerializeFMUstate) X(DeSerializeFMUstate)
#define MEMBER(name) static fmi2##name##TYPE *name;
FUNCTIONS(MEMBER)

static fmi2ValueReference rate, force, coefficient, slips[2], pulls[2];
static int directions, failures;
static const double STEP = 1e-7;

static void check(const char *name, int good)
{
    printf("%s %s\n", good ? "ok" : "FAIL", name);
    failures += !good;
}

static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment, (void)name, (void)status, (void)category;
    va_list arguments;
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

/* the force, and behind it the tangential ones */
struct forces { double values[3]; };

static struct forces forces_of(fmi2Component contact)
{
    struct forces found = {{0.0, 0.0, 0.0}};
    GetReal(contact, &force, 1, found.values);
    GetReal(contact, pulls, (size_t)directions, found.values + 1);
    return found;
}

/* the step with this number; counts those that fail */
static struct forces step(fmi2Component contact, int number, int *refused)
{
    double phase = 0.05 * number;
    double normal = 0.5 * cos(phase), tangential[2] = {0.4 * sin(1.7 * phase), 0.3 * cos(0.6 * phase)};
    *refused += SetReal(contact, &rate, 1, &normal) != fmi2OK;
    *refused += SetReal(contact, slips, (size_t)directions, tangential) != fmi2OK;
    *refused += DoStep(contact, number * STEP, STEP, fmi2False) != fmi2OK;
    return forces_of(contact);
}

int main(int count, char *arguments[])
{
    if (count < 8 || count > 10)
        return 2;
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return fprintf(stderr, "%s\n", dlerror()), 2;
#define LOAD(name) *(void **)&name = dlsym(library, "fmi2" #name);
    FUNCTIONS(LOAD)
    fmi2ValueReference *targets[] = {&rate, &force, &coefficient, &slips[0], &pulls[0], &slips[1], &pulls[1]};
    for (int i = 3; i < count; i++)
        *targets[i - 3] = (fmi2ValueReference)strtoul(arguments[i], NULL, 10);
    directions = (count - 6) / 2;

    fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    fmi2Component contact = Instantiate("contact", fmi2CoSimulation, arguments[2], "", &callbacks, fmi2False, fmi2False);
    check("an instance", contact != NULL);
    double mu = 0.25, read = 0.0;
    check("a coefficient is set", SetReal(contact, &coefficient, 1, &mu) == fmi2OK);
    SetupExperiment(contact, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    check("initialization", EnterInitializationMode(contact) == fmi2OK && ExitInitializationMode(contact) == fmi2OK);
    check("the coefficient is read", GetReal(contact, &coefficient, 1, &read) == fmi2OK && read == mu);

    int refused = 0, bound = 1, sideways = 0, apart = 1;
    fmi2FMUstate state = NULL;
    struct forces before = {{0.0, 0.0, 0.0}}, after[40];
    for (int number = 0; number < 140; number++) {
        struct forces now = step(contact, number, &refused);
        double pull = hypot(now.values[1], now.values[2]);
        bound &= pull <= mu * now.values[0] * (1.0 + 1e-9);
        sideways += pull > 0.0;
        apart &= now.values[0] > 0.0 || pull == 0.0;
        if (number == 99) {
            check("a state is kept", GetFMUstate(contact, &state) == fmi2OK);
            before = now;
        } else if (number > 99) {
            after[number - 100] = now;
        }
    }
    check("no step is refused", refused == 0);
    check("Coulomb's bound", bound && sideways > 50 && apart);

    size_t size = 0;
    SerializedFMUstateSize(contact, state, &size);
    fmi2Byte *bytes = malloc(size);
    check("a state as bytes", bytes && SerializeFMUstate(contact, state, bytes, size) == fmi2OK);
    FreeFMUstate(contact, &state);
    check("bytes as a state", DeSerializeFMUstate(contact, bytes, size, &state) == fmi2OK);
    check("a state is restored", SetFMUstate(contact, state) == fmi2OK);
    struct forces restored = forces_of(contact);
    check("it has the same forces", memcmp(&restored, &before, sizeof before) == 0);
    int same = 1;
    for (int number = 100; number < 140; number++) {
        struct forces now = step(contact, number, &refused);
        same &= memcmp(&now, &after[number - 100], sizeof now) == 0;
    }
    check("it continues with the same bits", same && refused == 0);

    double bad = NAN;
    check("a rate that is no number is refused", SetReal(contact, slips, 1, &bad) == fmi2Error);
    FreeFMUstate(contact, &state);
    FreeInstance(contact);
    free(bytes);
    return failures != 0;
}
