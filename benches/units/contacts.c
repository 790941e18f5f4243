/*
 * CONTACTS equal contacts in one FMU, written carefully by hand in C: arrays over all contacts allow the compiler to process
 * several at a time. References are those of Brinell: first all rates, then all forces. The parameters are fixed. The checks
 * are the same as in contact.c.
 *
 * A step first tests whether all contacts of a block stay on their branches. Only otherwise are they processed one by one.
 */
#include "clock.h"
#include "law.h"

#include <string.h>

enum { BLOCK = 8, FIRST_FORCE = CONTACTS, END = 2 * CONTACTS };

/* the arrays hold the fields of Contact and Branch */
typedef struct {
    Clock clock;
    Law law;
    double rate[CONTACTS];
    double sum[CONTACTS], rest[CONTACTS], least[CONTACTS], lower[CONTACTS], upper[CONTACTS];
    double origin[CONTACTS], constant[CONTACTS], linear[CONTACTS], power[CONTACTS];
    /* needed when a branch is left */
    double largest[CONTACTS], unloading[CONTACTS];
    Kind kind[CONTACTS], from[CONTACTS];
} State;

static Contact contact_at(const State *state, size_t i)
{
    return (Contact){
        .sum = state->sum[i],
        .rest = state->rest[i],
        .branch = {
            .lower = state->lower[i],
            .upper = state->upper[i],
            .origin = state->origin[i],
            .constant = state->constant[i],
            .linear = state->linear[i],
            .power = state->power[i],
            .least = state->least[i],
        },
        .largest = state->largest[i],
        .power = state->unloading[i],
        .kind = state->kind[i],
        .from = state->from[i],
    };
}

static void put_contact(State *state, size_t i, const Contact *contact)
{
    state->sum[i] = contact->sum;
    state->rest[i] = contact->rest;
    state->least[i] = contact->branch.least;
    state->lower[i] = contact->branch.lower;
    state->upper[i] = contact->branch.upper;
    state->origin[i] = contact->branch.origin;
    state->constant[i] = contact->branch.constant;
    state->linear[i] = contact->branch.linear;
    state->power[i] = contact->branch.power;
    state->largest[i] = contact->largest;
    state->unloading[i] = contact->power;
    state->kind[i] = contact->kind;
    state->from[i] = contact->from;
}

static void make_initial(State *state)
{
    Parameters given = PARAMETERS_OF_THE_SCENE;
    Contact untouched;
    state->clock = BEFORE_ANY_STEP;
    state->law = make_law(&given);
    start(&untouched, &state->law, given.gap);
    memset(state->rate, 0, sizeof state->rate);
    for (size_t i = 0; i < CONTACTS; i++)
        put_contact(state, i, &untouched);
}

static void copy_state(State *to, const State *from)
{
    memcpy(to, from, sizeof *to);
}

#include "lifecycle.h"

/* two numbers at a time, and the result of their comparison: available on every x86-64 and AArch64, in the syntax of gcc and clang */
typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
typedef long long Mask __attribute__((vector_size(16)));

static Pair pair_at(const double *numbers)
{
    return *(const Pair *)numbers;
}

/* whether the references are consecutive */
static bool are_in_a_row(const fmi2ValueReference references[], size_t count)
{
    unsigned differs = 0;
    for (size_t i = 0; i < count; i++)
        differs |= references[i] ^ (references[0] + (unsigned)i);
    return !differs;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = component;
    if (!is_in(unit, INSTANTIATED | INITIALIZATION | STEPPING))
        return refuse(unit, "fmi2SetReal: out of order");
    if (count == 0)
        return fmi2OK;
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

/* the importer's array does not overlap the FMU's data */
static void forces(const State *restrict state, size_t first, size_t count, fmi2Real *restrict values)
{
    for (size_t i = 0; i < count; i++)
        values[i] = force(state, first + i);
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    Unit *unit = component;
    if (!is_in(unit, INITIALIZATION | STEPPING | TERMINATED | FAILED))
        return refuse(unit, "fmi2GetReal: out of order");
    if (count == 0)
        return fmi2OK;
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

/* one by one, if not all stay on their branches */
static bool advance_each(State *state, size_t first, size_t end, double step)
{
    for (size_t i = first; i < end; i++) {
        double increment = state->rate[i] * step;
        double before = state->sum[i], sum = before + increment, rest = before - sum + increment + state->rest[i];
        double indentation = sum + rest;
        if (indentation > state->lower[i] && indentation < state->upper[i] && increment >= state->least[i]) {
            state->sum[i] = sum;
            state->rest[i] = rest;
        } else {
            Contact contact = contact_at(state, i);
            if (!leave(&contact, &state->law, sum, rest))
                return false;
            put_contact(state, i, &contact);
        }
    }
    return true;
}

static bool advance_block(State *state, size_t first, double step)
{
    Pair sums[BLOCK / 2], rests[BLOCK / 2];
    Mask stays = {-1, -1};
    for (size_t k = 0; k < BLOCK / 2; k++) {
        size_t i = first + 2 * k;
        Pair before = pair_at(state->sum + i), increment = pair_at(state->rate + i) * step;
        sums[k] = before + increment;
        rests[k] = pair_at(state->rest + i) + (increment - (sums[k] - before));
        Pair indentation = sums[k] + rests[k];
        stays &= (indentation > pair_at(state->lower + i)) & (indentation < pair_at(state->upper + i))
               & (increment >= pair_at(state->least + i));
    }
    if (!LIKELY(stays[0] & stays[1]))
        return advance_each(state, first, first + BLOCK, step);
    memcpy(state->sum + first, sums, sizeof sums);
    memcpy(state->rest + first, rests, sizeof rests);
    return true;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Unit *unit = component;
    (void)no_state_is_set_before;
    if (!is_in(unit, STEPPING))
        return refuse(unit, "fmi2DoStep: out of order");
    State *state = &unit->state;
    double end = time + step;
    if (!LIKELY(is_plain(&state->clock, time, step, end)) && !is_in_time(&state->clock, time, step))
        return refuse(unit, "fmi2DoStep: the step doesn't fit to the last one, or isn't positive, or ends too late");
    bool done = true;
    size_t first = 0;
    for (; done && first + BLOCK <= CONTACTS; first += BLOCK)
        done = advance_block(state, first, step);
    if (!done || !advance_each(state, first, CONTACTS, step))
        return refuse(unit, "fmi2DoStep: an indentation is out of range");
    state->clock.time = end;
    return fmi2OK;
}
