/* Memory: none is allocated by steps or by saving to an existing state, and all of it is freed. */
#include "unit.h"

#include <stdlib.h>
#include <string.h>

/* Counts are available only where the functions of the process can be replaced. */
static void check_count(const char *name, bool good) {
    if (counts_allocations) {
        check(name, good);
    }
}

/* The checks below would pass if nothing were counted at all. */
static void counting_counts(void) {
    count_from_here();
    fmi2Component c = instantiate();
    long one = allocations();
    fmi.FreeInstance(c);
    stop_counting();
    check_count("an instance is one piece of memory", one == 1);
    check_count("which is given back", allocations() == 1 && releases() == 1);
    count_from_here();
    c = fmi.Instantiate(instance_name, fmi2CoSimulation, "another", "", &callbacks, fmi2False, fmi2False);
    stop_counting();
    check_count("a refused instance keeps no memory", c == NULL && allocations() == releases());
}

static void stepping(fmi2Component c) {
    count_from_here();
    double sum = 0;
    for (int i = 0; i < 1000; i++) {
        sum += step(c, i, i < 900 ? 0.1 : -0.1);
    }
    stop_counting();
    check("1000 steps press", sum > 0);
    check_count("setting, stepping and reading take no memory", allocations() == 0 && releases() == 0);
}

/* Saves, steps, restores, steps: the same bits, with the state and with its bytes, which create a new state each time. */
static void states(fmi2Component c, fmi2FMUstate *state, fmi2FMUstate *other) {
    size_t size = 0;
    bool good = fmi.GetFMUstate(c, state) == fmi2OK && fmi.SerializedFMUstateSize(c, *state, &size) == fmi2OK;
    char *bytes = calloc(1, size);
    good &= fmi.SerializeFMUstate(c, *state, bytes, size) == fmi2OK;
    good &= fmi.DeSerializeFMUstate(c, bytes, size, other) == fmi2OK && *other != *state;
    fmi2FMUstate const first = *state;
    count_from_here();
    for (int i = 0; i < 100; i++) {
        good &= fmi.GetFMUstate(c, state) == fmi2OK;
        good &= fmi.SerializedFMUstateSize(c, *state, &size) == fmi2OK;
        good &= fmi.SerializeFMUstate(c, *state, bytes, size) == fmi2OK;
        good &= fmi.FreeFMUstate(c, other) == fmi2OK;
        /* the old pointer does not matter: it is only written */
        *other = (fmi2FMUstate)(size_t)(i % 2 ? 0x10 : 0);
        good &= fmi.DeSerializeFMUstate(c, bytes, size, other) == fmi2OK;
        double there = step(c, 1000 + i, 0.3);
        good &= there > 0 && fmi.SetFMUstate(c, *state) == fmi2OK && step(c, 1000 + i, 0.3) == there;
        good &= fmi.SetFMUstate(c, *other) == fmi2OK && step(c, 1000 + i, 0.3) == there;
    }
    stop_counting();
    check("a saved state, and one from bytes, lead to the same bits", good);
    check("a state that is there is used again", first == *state);
    check_count("saving, restoring and serializing take no memory", allocations() == 100 && releases() == 100);
    free(bytes);
}

/* When memory runs out, the error must still be reported. */
static void errors(fmi2Component c) {
    double value = -1.0;
    count_from_here();
    bool good = fmi.SetReal(c, &parameter, 1, &value) == fmi2Error && fmi.DoStep(c, 0, 1, fmi2True) == fmi2Error;
    good &= fmi.Reset(c) == fmi2OK;
    stop_counting();
    check("after errors an instance can be reset", good);
    check_count("errors, their messages and a reset take no memory", allocations() == 0 && releases() == 0);
}

/* A library that gets no memory says so. What is there goes on after a reset, and no pointer changes. */
static void no_memory(void) {
    if (!counts_allocations) {
        return;
    }
    fmi2Component c = ready();
    fmi2FMUstate state = NULL, none = NULL, old = &environment;
    size_t size = 0;
    bool good = fmi.GetFMUstate(c, &state) == fmi2OK && fmi.SerializedFMUstateSize(c, state, &size) == fmi2OK;
    char *bytes = calloc(1, size);
    good &= fmi.SerializeFMUstate(c, state, bytes, size) == fmi2OK;
    int const before = messages;
    use_up_memory();
    fmi2Component const refused = fmi.Instantiate(instance_name, fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2False);
    bool told = messages == before + 1 && strstr(last_message, "out of memory") != NULL;
    good &= fmi.GetFMUstate(c, &none) == fmi2Error && none == NULL;
    told &= messages == before + 2 && strstr(last_message, "out of memory") != NULL;
    good &= fmi.SetFMUstate(c, state) == fmi2OK && fmi.DeSerializeFMUstate(c, bytes, size, &old) == fmi2Error;
    told &= messages == before + 3 && strstr(last_message, "out of memory") != NULL;
    /* what needs no new memory works */
    good &= old == &environment && fmi.SetFMUstate(c, state) == fmi2OK && fmi.GetFMUstate(c, &state) == fmi2OK;
    double const force = step(c, 0, 0.3);
    have_memory();
    check("without memory an instance, a state and one from bytes are refused", refused == NULL && good);
    check("which is told", told);
    check("and the instance goes on from a state", force > 0);
    good = fmi.FreeFMUstate(c, &state) == fmi2OK && state == NULL;
    check("and its state is freed", good);
    fmi.FreeInstance(c);
    free(bytes);
}

void check_memory(void) {
    counting_counts();
    no_memory();
    fmi2FMUstate state = NULL, other = NULL;
    fmi2Component c = ready();
    stepping(c);
    states(c, &state, &other);
    errors(c);
    count_from_here();
    bool good = fmi.FreeFMUstate(c, &state) == fmi2OK && fmi.FreeFMUstate(c, &other) == fmi2OK;
    check_count("freeing a state gives its memory back", releases() == 2);
    good &= state == NULL && other == NULL && fmi.Terminate(c) == fmi2OK;
    fmi.FreeInstance(c);
    stop_counting();
    check("states are freed and their pointers null", good);
    check_count("every piece of memory is given back", releases() == 3 && allocations() == 0);
}
