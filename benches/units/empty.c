/*
 * A unit without physics: the input is stored, the step adds up time, the output is the input. With the checks of a
 * careful unit and nothing else, it shows what the calls of FMI themselves cost.
 */
#include "fmi2.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { INPUT, OUTPUT };

typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8, FAILED = 16 } Phase;

/* what a saved state holds */
typedef struct {
    Phase phase;
    bool experiment_defined;
    double time, stop;
    double input;
} State;

typedef struct {
    State state;
    fmi2CallbackFunctions callbacks;
    char name[];
} Unit;

__attribute__((cold, noinline)) static fmi2Status refuse(Unit *unit, fmi2String message)
{
    unit->state.phase = FAILED;
    if (unit->callbacks.logger)
        unit->callbacks.logger(unit->callbacks.componentEnvironment, unit->name, fmi2Error, "logStatusError", "%s", message);
    return fmi2Error;
}

static State initial_state(void)
{
    return (State){.phase = INSTANTIATED, .stop = DBL_MAX};
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)resources, (void)visible, (void)logging;
    if (!name || !*name || !guid || strcmp(guid, UNIT_GUID) != 0 || !callbacks || type != fmi2CoSimulation)
        return NULL;
    size_t length = strlen(name) + 1;
    Unit *unit = malloc(sizeof *unit + length);
    if (!unit)
        return NULL;
    unit->state = initial_state();
    unit->callbacks = *callbacks;
    memcpy(unit->name, name, length);
    return unit;
}

void fmi2FreeInstance(fmi2Component component)
{
    free(component);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    Unit *unit = component;
    (void)tolerance_defined, (void)tolerance;
    if (!unit)
        return fmi2Error;
    if (unit->state.phase != INSTANTIATED)
        return refuse(unit, "fmi2SetupExperiment: out of order");
    unit->state.time = start;
    unit->state.stop = stop_defined ? stop : DBL_MAX;
    unit->state.experiment_defined = true;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (unit->state.phase != INSTANTIATED || !unit->state.experiment_defined)
        return refuse(unit, "fmi2EnterInitializationMode: out of order");
    unit->state.phase = INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (unit->state.phase != INITIALIZATION)
        return refuse(unit, "fmi2ExitInitializationMode: out of order");
    unit->state.phase = STEPPING;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (unit->state.phase != STEPPING)
        return refuse(unit, "fmi2Terminate: out of order");
    unit->state.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    unit->state = initial_state();
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!(unit->state.phase & (INSTANTIATED | INITIALIZATION | STEPPING)))
        return refuse(unit, "fmi2SetReal: out of order");
    if (count > 0 && (!references || !values))
        return refuse(unit, "fmi2SetReal: null pointer");
    for (size_t i = 0; i < count; i++) {
        if (references[i] != INPUT)
            return refuse(unit, "fmi2SetReal: no such input");
        unit->state.input = values[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!(unit->state.phase & (INITIALIZATION | STEPPING | TERMINATED | FAILED)))
        return refuse(unit, "fmi2GetReal: out of order");
    if (count > 0 && (!references || !values))
        return refuse(unit, "fmi2GetReal: null pointer");
    for (size_t i = 0; i < count; i++) {
        if (references[i] > OUTPUT)
            return refuse(unit, "fmi2GetReal: no such variable");
        values[i] = unit->state.input;
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    if (!unit)
        return fmi2Error;
    if (unit->state.phase != STEPPING)
        return refuse(unit, "fmi2DoStep: out of order");
    double end = time + step;
    if (!(step > 0.0 && step < INFINITY && fabs(time - unit->state.time) <= 0.1 * step && end <= unit->state.stop))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    unit->state.time = end;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *saved)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!saved)
        return refuse(unit, "fmi2GetFMUstate: null pointer");
    if (!*saved && !(*saved = malloc(sizeof(State))))
        return refuse(unit, "fmi2GetFMUstate: no memory");
    *(State *)*saved = unit->state;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate saved)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!saved)
        return refuse(unit, "fmi2SetFMUstate: null pointer");
    unit->state = *(const State *)saved;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *saved)
{
    if (!component)
        return fmi2Error;
    if (saved) {
        free(*saved);
        *saved = NULL;
    }
    return fmi2OK;
}
