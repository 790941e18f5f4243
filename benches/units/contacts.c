/*
 * CONTACTS equal contacts in one unit, as an expert would write them by hand in C: arrays over all contacts, so that the
 * compiler takes several at a time. References are those of Brinell: first all rates, then all forces.
 *
 * A step looks first whether a block of contacts stays on its branches; only in a block where one doesn't are contacts
 * taken one by one.
 */
#include "fmi2.h"
#include "law.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8, FIRST_FORCE = CONTACTS, END = 2 * CONTACTS };

typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8, FAILED = 16 } Phase;

/* what a saved state holds; the arrays are the fields of Contact and Branch */
typedef struct {
    Phase phase;
    bool experiment_defined;
    double time;
    double limit; /* where plain steps end: at the stop time while stepping, and nowhere otherwise */
    double stop;
    double rate[CONTACTS];
    double sum[CONTACTS], rest[CONTACTS], least[CONTACTS], lower[CONTACTS], upper[CONTACTS];
    double origin[CONTACTS], constant[CONTACTS], linear[CONTACTS], power[CONTACTS];
    double largest[CONTACTS];
} State;

typedef struct {
    State state;
    Law law;
    fmi2CallbackFunctions callbacks;
    char name[];
} Unit;

static Contact contact_at(const State *state, size_t i)
{
    return (Contact){
        .sum = state->sum[i],
        .rest = state->rest[i],
        .least = state->least[i],
        .branch = {state->lower[i], state->upper[i], state->origin[i], state->constant[i], state->linear[i], state->power[i]},
        .largest = state->largest[i],
    };
}

static void put_contact(State *state, size_t i, const Contact *contact)
{
    state->sum[i] = contact->sum;
    state->rest[i] = contact->rest;
    state->least[i] = contact->least;
    state->lower[i] = contact->branch.lower;
    state->upper[i] = contact->branch.upper;
    state->origin[i] = contact->branch.origin;
    state->constant[i] = contact->branch.constant;
    state->linear[i] = contact->branch.linear;
    state->power[i] = contact->branch.power;
    state->largest[i] = contact->largest;
}

static void make_initial(State *state)
{
    const Contact untouched = UNTOUCHED;
    state->phase = INSTANTIATED;
    state->experiment_defined = false;
    state->time = 0.0;
    state->limit = -DBL_MAX;
    state->stop = DBL_MAX;
    for (size_t i = 0; i < CONTACTS; i++) {
        state->rate[i] = 0.0;
        put_contact(state, i, &untouched);
    }
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
    make_initial(&unit->state);
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
    make_initial(&unit->state);
    return fmi2OK;
}

/* two numbers at a time, and what comparing them gives: what every x86-64 and AArch64 has, in the words of gcc and clang */
typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
typedef long long Mask __attribute__((vector_size(16)));

static Pair pair_at(const double *numbers)
{
    return *(const Pair *)numbers;
}

/* whether the references count up from the first one */
static bool are_in_a_row(const fmi2ValueReference references[], size_t count)
{
    unsigned differs = 0;
    for (size_t i = 0; i < count; i++)
        differs |= references[i] ^ (references[0] + (unsigned)i);
    return !differs;
}

/* what is infinite or NaN is not zero when it is taken from itself */
static bool are_finite(const fmi2Real values[], size_t count)
{
    Mask finite = {-1, -1};
    size_t i = 0;
    for (; i + 2 <= count; i += 2)
        finite &= pair_at(values + i) - pair_at(values + i) == 0.0;
    return (finite[0] & finite[1]) && (i == count || isfinite(values[i]));
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, INSTANTIATED | INITIALIZATION | STEPPING))
        return refuse(unit, "fmi2SetReal: out of order");
    if (count == 0)
        return fmi2OK;
    if (!references || !values)
        return refuse(unit, "fmi2SetReal: null pointer");
    if (!are_finite(values, count))
        return refuse(unit, "fmi2SetReal: an indentation_rate must be finite");
    size_t first = references[0];
    if (LIKELY(first < FIRST_FORCE && count <= FIRST_FORCE - first && are_in_a_row(references, count))) {
        memcpy(unit->state.rate + first, values, count * sizeof *values);
        return fmi2OK;
    }
    for (size_t i = 0; i < count; i++)
        if (references[i] >= FIRST_FORCE)
            return refuse(unit, "fmi2SetReal: no such input");
    for (size_t i = 0; i < count; i++)
        unit->state.rate[references[i]] = values[i];
    return fmi2OK;
}

static double force(const State *state, size_t i)
{
    double z = state->sum[i] + state->rest[i] - state->origin[i];
    return state->constant[i] + z * (state->linear[i] + state->power[i] * sqrt(z));
}

/* the importer's array is none of the unit's */
static void forces(const State *restrict state, size_t first, size_t count, fmi2Real *restrict values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = force(state, first + i);
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, INITIALIZATION | STEPPING | TERMINATED | FAILED))
        return refuse(unit, "fmi2GetReal: out of order");
    if (count == 0)
        return fmi2OK;
    if (!references || !values)
        return refuse(unit, "fmi2GetReal: null pointer");
    size_t first = references[0];
    if (LIKELY(first >= FIRST_FORCE && first < END && count <= END - first && are_in_a_row(references, count))) {
        forces(&unit->state, first - FIRST_FORCE, count, values);
        return fmi2OK;
    }
    for (size_t i = 0; i < count; i++) {
        if (references[i] >= END)
            return refuse(unit, "fmi2GetReal: no such variable");
        values[i] = references[i] < FIRST_FORCE ? unit->state.rate[references[i]]
                                                : force(&unit->state, references[i] - FIRST_FORCE);
    }
    return fmi2OK;
}

/* the second look at times that aren't plainly right: room for rounding far from zero */
static bool times_are_close(const State *state, double time, double step)
{
    double rounding = 32.0 * DBL_EPSILON * (fabs(time) + fabs(state->time));
    return step > 0.0 && step < INFINITY && fabs(time - state->time) <= 0.1 * step + rounding
        && time + step - state->stop <= 1e-3 * step + rounding;
}

/* one by one, where not all stay on their branches */
COLD static bool advance_each(State *state, const Law *law, size_t first, size_t end, double step)
{
    for (size_t i = first; i < end; i++) {
        double increment = state->rate[i] * step;
        double sum = state->sum[i] + increment, rest = state->rest[i] + (increment - (sum - state->sum[i]));
        double indentation = sum + rest;
        if (indentation >= state->lower[i] && indentation < state->upper[i] && increment >= state->least[i]) {
            state->sum[i] = sum;
            state->rest[i] = rest;
        } else {
            Contact contact = contact_at(state, i);
            if (!advance(&contact, law, increment))
                return false;
            put_contact(state, i, &contact);
        }
    }
    return true;
}

static bool advance_block(State *state, const Law *law, size_t first, double step)
{
    Pair sums[BLOCK / 2], rests[BLOCK / 2];
    Mask stays = {-1, -1};
    for (size_t k = 0; k < BLOCK / 2; k++) {
        size_t i = first + 2 * k;
        Pair before = pair_at(state->sum + i), increment = pair_at(state->rate + i) * step;
        sums[k] = before + increment;
        rests[k] = pair_at(state->rest + i) + (increment - (sums[k] - before));
        Pair indentation = sums[k] + rests[k];
        stays &= (indentation >= pair_at(state->lower + i)) & (indentation < pair_at(state->upper + i))
               & (increment >= pair_at(state->least + i));
    }
    if (!LIKELY(stays[0] & stays[1]))
        return advance_each(state, law, first, first + BLOCK, step);
    memcpy(state->sum + first, sums, sizeof sums);
    memcpy(state->rest + first, rests, sizeof rests);
    return true;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    if (!unit)
        return fmi2Error;
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2DoStep: out of order");
    State *state = &unit->state;
    double end = time + step;
    bool plain = fabs(time - state->time) * 10.0 < step && end <= state->limit;
    if (!LIKELY(plain) && !times_are_close(state, time, step))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    bool done = true;
    size_t first = 0;
    for (; done && first + BLOCK <= CONTACTS; first += BLOCK)
        done = advance_block(state, &unit->law, first, step);
    if (!done || !advance_each(state, &unit->law, first, CONTACTS, step))
        return refuse(unit, "fmi2DoStep: an indentation is out of range");
    state->time = end;
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
