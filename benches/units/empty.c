/*
 * An FMU without physics: the input is stored, the step advances the time, and the output is the input. It shows the cost of
 * the FMI calls themselves, which is the lower limit for any FMU.
 *
 * It checks what the standard requires of an FMU: the order of calls and references; that a step is positive, follows the
 * last one and does not go beyond the stop time. It does not check for null pointers (see lifecycle.h), nor whether the input
 * is finite, because nothing is computed from it. Calls with one value, and steps that clearly follow, are handled first.
 */
#include "clock.h"

enum { INPUT, OUTPUT };

typedef struct {
    Clock clock;
    double input;
} State;

static void make_initial(State *state)
{
    *state = (State){.clock = BEFORE_ANY_STEP};
}

static void copy_state(State *to, const State *from)
{
    *to = *from;
}

#include "lifecycle.h"

COLD static fmi2Status set_any(Unit *unit, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    if (!is_in(unit, INSTANTIATED | INITIALIZATION | STEPPING))
        return refuse(unit, "fmi2SetReal: out of order");
    for (size_t i = 0; i < count; i++)
        if (references[i] != INPUT)
            return refuse(unit, "fmi2SetReal: no such input");
    if (count > 0)
        unit->state.input = values[count - 1];
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(count == 1 && *references == INPUT && unit->state.clock.phase == STEPPING)) {
        unit->state.input = *values;
        return fmi2OK;
    }
    return set_any(unit, references, count, values);
}

COLD static fmi2Status get_any(Unit *unit, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    if (!is_in(unit, INITIALIZATION | STEPPING | TERMINATED | FAILED))
        return refuse(unit, "fmi2GetReal: out of order");
    for (size_t i = 0; i < count; i++) {
        if (references[i] > OUTPUT)
            return refuse(unit, "fmi2GetReal: no such variable");
        values[i] = unit->state.input;
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(count == 1 && *references == OUTPUT && unit->state.clock.phase == STEPPING)) {
        *values = unit->state.input;
        return fmi2OK;
    }
    return get_any(unit, references, count, values);
}

COLD static fmi2Status do_any_step(Unit *unit, double time, double step)
{
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2DoStep: out of order");
    if (!is_in_time(&unit->state.clock, time, step))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    unit->state.clock.time = time + step;
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    double end = time + step;
    if (LIKELY(is_plain(&unit->state.clock, time, step, end))) {
        unit->state.clock.time = end;
        return fmi2OK;
    }
    return do_any_step(unit, time, step);
}
