/*
 * The contact of Brinell's first scene, written carefully by hand in C: the reference for the generated FMU. It has the same
 * law, the same sum of increments and the same parameters. Its only output is the force.
 *
 * It checks what the standard requires of an FMU: the order of calls, references and parameters; that a step is positive,
 * follows the last one and does not go beyond the stop time; and that the indentation stays finite. An input that is not
 * finite is rejected by the step that would use it. It does not check for null pointers (see lifecycle.h). The most frequent
 * calls, with one value or with a step that follows the last one and stays on its branch, are handled first.
 */
#include "clock.h"
#include "law.h"

#include <stdatomic.h>
#include <stddef.h>
#include <string.h>

enum { INDENTATION_RATE, FORCE, FIRST_PARAMETER = 5, PARAMETERS = sizeof(Parameters) / sizeof(double) };

typedef struct {
    Clock clock;
    double rate; /* [m/s] */
    Contact contact;
    unsigned long given_by; /* the same in all states with the same parameters */
    union {
        Parameters parameters;
        double values[PARAMETERS];
    };
    Law law;
} State;

static void make_initial(State *state)
{
    Parameters given = PARAMETERS_OF_THE_SCENE;
    state->clock = BEFORE_ANY_STEP;
    state->rate = 0.0;
    state->given_by = 0;
    state->parameters = given;
    state->law = make_law(&given);
    start(&state->contact, &state->law, given.gap);
}

COLD static void copy_all(State *to, const State *from)
{
    *to = *from;
}

/* parameters are copied only if they differ */
static inline void copy_state(State *to, const State *from)
{
    if (LIKELY(to->given_by == from->given_by))
        memcpy(to, from, offsetof(State, given_by));
    else
        copy_all(to, from);
}

#include "lifecycle.h"

/* number of times that parameters were set in all instances: no two settings have the same number */
static atomic_ulong settings;

static bool are_allowed(const Parameters *given)
{
    /* written positively to reject NaN */
    return given->radius > 0.0 && given->radius < INFINITY && given->modulus > 0.0 && given->modulus < INFINITY
        && given->poissons_ratio > -1.0 && given->poissons_ratio <= 0.5 && given->strength > 0.0
        && given->strength < INFINITY && fabs(given->gap) < LARGEST_INDENTATION;
}

COLD static fmi2Status set_any(Unit *unit, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    State *state = &unit->state;
    bool other_parameters = false;
    if (!is_in(unit, INSTANTIATED | INITIALIZATION | STEPPING))
        return refuse(unit, "fmi2SetReal: out of order");
    for (size_t i = 0; i < count; i++) {
        size_t parameter = references[i] - (size_t)FIRST_PARAMETER;
        if (references[i] == INDENTATION_RATE) {
            state->rate = values[i];
        } else if (parameter < PARAMETERS && !is_in(unit, STEPPING)) {
            state->values[parameter] = values[i];
            other_parameters = true;
        } else {
            return refuse(unit, "fmi2SetReal: no such input or parameter, or a parameter after initialization");
        }
    }
    if (other_parameters) {
        if (!are_allowed(&state->parameters))
            return refuse(unit, "fmi2SetReal: parameter out of range");
        state->given_by = atomic_fetch_add(&settings, 1) + 1;
        state->law = make_law(&state->parameters);
        start(&state->contact, &state->law, state->parameters.gap);
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(count == 1 && *references == INDENTATION_RATE && unit->state.clock.phase == STEPPING)) {
        unit->state.rate = *values;
        return fmi2OK;
    }
    return set_any(unit, references, count, values);
}

/* the force is evaluated here and not in the step, so that steps without a reading do not pay for it */
static inline double force(const Contact *contact)
{
    return force_on(&contact->branch, contact->sum + contact->rest);
}

COLD static fmi2Status get_any(Unit *unit, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    const State *state = &unit->state;
    if (!is_in(unit, INITIALIZATION | STEPPING | TERMINATED | FAILED))
        return refuse(unit, "fmi2GetReal: out of order");
    for (size_t i = 0; i < count; i++) {
        size_t parameter = references[i] - (size_t)FIRST_PARAMETER;
        if (references[i] == INDENTATION_RATE)
            values[i] = state->rate;
        else if (references[i] == FORCE)
            values[i] = force(&state->contact);
        else if (parameter < PARAMETERS)
            values[i] = state->values[parameter];
        else
            return refuse(unit, "fmi2GetReal: no such variable");
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (LIKELY(count == 1 && *references == FORCE && unit->state.clock.phase == STEPPING)) {
        *values = force(&unit->state.contact);
        return fmi2OK;
    }
    return get_any(unit, references, count, values);
}

/* the end of a step that leaves its branch */
static __attribute__((noinline)) fmi2Status step_off(Unit *unit, double end, double sum, double rest)
{
    if (!leave(&unit->state.contact, &unit->state.law, sum, rest))
        return refuse(unit, "fmi2DoStep: the indentation is out of range");
    unit->state.clock.time = end;
    return fmi2OK;
}

static inline fmi2Status move(Unit *unit, double end, double step)
{
    Contact *contact = &unit->state.contact;
    double before = contact->sum, increment = unit->state.rate * step, sum = before + increment;
    /* no addition waits for the rest of the one before */
    double rest = before - sum + increment + contact->rest;
    if (!LIKELY(stays(contact, sum + rest, increment)))
        return step_off(unit, end, sum, rest);
    contact->sum = sum;
    contact->rest = rest;
    unit->state.clock.time = end;
    return fmi2OK;
}

COLD static fmi2Status do_any_step(Unit *unit, double time, double step)
{
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2DoStep: out of order");
    if (!is_in_time(&unit->state.clock, time, step))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    return move(unit, time + step, step);
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    double end = time + step;
    if (!LIKELY(is_plain(&unit->state.clock, time, step, end)))
        return do_any_step(unit, time, step);
    return move(unit, end, step);
}
