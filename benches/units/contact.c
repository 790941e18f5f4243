/*
 * The contact of Brinell's first scene as an expert would write it by hand in C: the measure for the generated unit.
 *
 * Loading after Big-Alabo, Harrison and Cartmell (2015), unloading by contact radius, and the dent stays. The parameters
 * are fixed. What is kept between steps is the branch of the law, so that a step that stays on it is a few comparisons.
 * Checks are those of a careful unit: null pointers, call order, references, finite input, times. What nearly every call
 * is, one value and a step that follows the last one, is looked for first; all else is out of its way.
 */
#include "fmi2.h"
#include "law.h"

#include <stdlib.h>
#include <string.h>

enum { INDENTATION_RATE, FORCE };

typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8, FAILED = 16 } Phase;

/* what a saved state holds */
typedef struct {
    Phase phase;
    bool experiment_defined;
    double time;
    double limit; /* where plain steps end: at the stop time while stepping, and nowhere otherwise */
    double rate;
    Contact contact;
    double stop;
} State;

typedef struct {
    State state;
    Law law;
    fmi2CallbackFunctions callbacks;
    char name[];
} Unit;

static State initial_state(void)
{
    return (State){
        .phase = INSTANTIATED,
        .limit = -DBL_MAX,
        .contact = UNTOUCHED,
        .stop = DBL_MAX,
    };
}

static void set_phase(State *state, Phase phase)
{
    state->phase = phase;
    state->limit = phase == STEPPING ? state->stop : -DBL_MAX;
}

COLD static fmi2Status refuse(Unit *unit, fmi2String message)
{
    set_phase(&unit->state, FAILED);
    if (unit->callbacks.logger)
        unit->callbacks.logger(unit->callbacks.componentEnvironment, unit->name, fmi2Error, "logStatusError", "%s", message);
    return fmi2Error;
}

static bool is_in(const Unit *unit, unsigned phases)
{
    return LIKELY(unit->state.phase & phases);
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
    unit->law = make_law();
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
    if (!is_in(unit, INSTANTIATED))
        return refuse(unit, "fmi2SetupExperiment: out of order");
    if (!isfinite(start) || (stop_defined && !(isfinite(stop) && stop >= start)))
        return refuse(unit, "fmi2SetupExperiment: start and stop must be finite, and stop not before start");
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
    if (!is_in(unit, INSTANTIATED) || !unit->state.experiment_defined)
        return refuse(unit, "fmi2EnterInitializationMode: out of order");
    set_phase(&unit->state, INITIALIZATION);
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, INITIALIZATION))
        return refuse(unit, "fmi2ExitInitializationMode: out of order");
    set_phase(&unit->state, STEPPING);
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2Terminate: out of order");
    set_phase(&unit->state, TERMINATED);
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

COLD static fmi2Status set_any(Unit *unit, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, INSTANTIATED | INITIALIZATION | STEPPING))
        return refuse(unit, "fmi2SetReal: out of order");
    if (count > 0 && (!references || !values))
        return refuse(unit, "fmi2SetReal: null pointer");
    for (size_t i = 0; i < count; i++) {
        if (references[i] != INDENTATION_RATE)
            return refuse(unit, "fmi2SetReal: no such input");
        if (!isfinite(values[i]))
            return refuse(unit, "fmi2SetReal: indentation_rate must be finite");
    }
    /* one input only: the last value counts */
    if (count > 0)
        unit->state.rate = values[count - 1];
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(unit && count == 1 && references && *references == INDENTATION_RATE && values
               && unit->state.phase == STEPPING && isfinite(*values))) {
        unit->state.rate = *values;
        return fmi2OK;
    }
    return set_any(unit, references, count, values);
}

/* the force is evaluated here and not in the step, so that steps that nobody looks at don't pay for it */
static double force(const State *state)
{
    return force_on(&state->contact.branch, state->contact.sum + state->contact.rest);
}

COLD static fmi2Status get_any(Unit *unit, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, INITIALIZATION | STEPPING | TERMINATED | FAILED))
        return refuse(unit, "fmi2GetReal: out of order");
    if (count > 0 && (!references || !values))
        return refuse(unit, "fmi2GetReal: null pointer");
    for (size_t i = 0; i < count; i++) {
        switch (references[i]) {
        case INDENTATION_RATE:
            values[i] = unit->state.rate;
            break;
        case FORCE:
            values[i] = force(&unit->state);
            break;
        default:
            return refuse(unit, "fmi2GetReal: no such variable");
        }
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(unit && count == 1 && references && *references == FORCE && values && unit->state.phase == STEPPING)) {
        *values = force(&unit->state);
        return fmi2OK;
    }
    return get_any(unit, references, count, values);
}

/* the second look at times that aren't plainly right: room for rounding far from zero */
static bool times_are_close(const State *state, double time, double step)
{
    double rounding = 32.0 * DBL_EPSILON * (fabs(time) + fabs(state->time));
    return step > 0.0 && step < INFINITY && fabs(time - state->time) <= 0.1 * step + rounding
        && time + step - state->stop <= 1e-3 * step + rounding;
}

COLD static fmi2Status do_any_step(Unit *unit, double time, double step)
{
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2DoStep: out of order");
    State *state = &unit->state;
    if (!times_are_close(state, time, step))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    if (!advance(&state->contact, &unit->law, state->rate * step))
        return refuse(unit, "fmi2DoStep: the indentation is out of range");
    state->time = time + step;
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    if (LIKELY(unit)) {
        State *state = &unit->state;
        Contact *contact = &state->contact;
        double end = time + step, increment = state->rate * step;
        /* no addition waits for the rest of the one before */
        double sum = contact->sum + increment, rest = contact->rest + (increment - (sum - contact->sum));
        double indentation = sum + rest;
        /* a step that isn't positive is not larger than any distance; comparisons fail for NaN */
        if (LIKELY(fabs(time - state->time) * 10.0 < step && end <= state->limit && indentation >= contact->branch.lower
                   && indentation < contact->branch.upper && increment >= contact->least)) {
            contact->sum = sum;
            contact->rest = rest;
            state->time = end;
            return fmi2OK;
        }
    }
    return do_any_step(unit, time, step);
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
