/*
 * Life cycle, order of calls and saved states of the FMUs in this folder. An FMU includes this file after it has defined a
 * saved state (State, with a field `clock`) and the functions to create (make_initial) and to copy one (copy_state).
 *
 * It checks what only the FMU can know and what would lead to a wrong result: the order of calls, the GUID and the type of
 * FMU, start and stop time, memory. It does not check what the standard leaves to the caller: null pointers, and components
 * and states that do not belong to the FMU.
 */
#ifndef UNITS_LIFECYCLE_H
#define UNITS_LIFECYCLE_H

#include "clock.h"
#include "fmi2.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    State state;
    fmi2CallbackFunctions callbacks;
    char name[];
} Unit;

static void set_phase(Unit *unit, Phase phase)
{
    Clock *clock = &unit->state.clock;
    clock->phase = phase;
    clock->limit = phase == STEPPING ? clock->stop : -DBL_MAX;
}

static bool is_in(const Unit *unit, unsigned phases)
{
    return unit->state.clock.phase & phases;
}

COLD static fmi2Status refuse(Unit *unit, fmi2String message)
{
    set_phase(unit, FAILED);
    if (unit->callbacks.logger)
        unit->callbacks.logger(unit->callbacks.componentEnvironment, unit->name, fmi2Error, "logStatusError", "%s", message);
    return fmi2Error;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)resources, (void)visible, (void)logging;
    if (strcmp(guid, UNIT_GUID) != 0 || type != fmi2CoSimulation)
        return NULL;
    size_t length = strlen(name) + 1;
    Unit *unit = malloc(sizeof *unit + length);
    if (!unit)
        return NULL;
    make_initial(&unit->state);
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
    if (!is_in(unit, INSTANTIATED))
        return refuse(unit, "fmi2SetupExperiment: out of order");
    if (!isfinite(start) || (stop_defined && !(isfinite(stop) && stop >= start)))
        return refuse(unit, "fmi2SetupExperiment: start and stop must be finite, and stop not before start");
    unit->state.clock.time = start;
    unit->state.clock.stop = stop_defined ? stop : DBL_MAX;
    unit->state.clock.experiment_defined = true;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    Unit *unit = component;
    if (!is_in(unit, INSTANTIATED) || !unit->state.clock.experiment_defined)
        return refuse(unit, "fmi2EnterInitializationMode: out of order");
    set_phase(unit, INITIALIZATION);
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    Unit *unit = component;
    if (!is_in(unit, INITIALIZATION))
        return refuse(unit, "fmi2ExitInitializationMode: out of order");
    set_phase(unit, STEPPING);
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    Unit *unit = component;
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2Terminate: out of order");
    set_phase(unit, TERMINATED);
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    Unit *unit = component;
    make_initial(&unit->state);
    return fmi2OK;
}

COLD static fmi2Status make_state(Unit *unit, fmi2FMUstate *saved)
{
    State *made = malloc(sizeof *made);
    if (!made)
        return refuse(unit, "fmi2GetFMUstate: no memory");
    *made = unit->state;
    *saved = made;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *saved)
{
    Unit *unit = component;
    if (!LIKELY(*saved))
        return make_state(unit, saved);
    copy_state(*saved, &unit->state);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate saved)
{
    Unit *unit = component;
    copy_state(&unit->state, saved);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *saved)
{
    (void)component;
    free(*saved);
    *saved = NULL;
    return fmi2OK;
}

#endif
