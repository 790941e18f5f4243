/*
 * The law of Brinell's first scene, and one contact that follows it: loading after Big-Alabo, Harrison and Cartmell (2015),
 * unloading from the contact radius, and a permanent dent.
 *
 * Values that depend only on parameters are computed when these are set: boundaries in metres, factors of the branches, and
 * constants for unloading. A step that leaves its branch finds the next one from the present one.
 */
#ifndef UNITS_LAW_H
#define UNITS_LAW_H

#include "clock.h"

static const double PI = 3.14159265358979323846;

/* in yield indentations and yield strengths */
static const double SECOND_REGION = 13.93;
static const double FULLY_PLASTIC = 82.5;
static const double YIELD_PRESSURE = 1.1;
static const double PLASTIC_PRESSURE = 2.8;

static const double LARGEST_INDENTATION = 1e100; /* [m] */

/* the least increment of a branch that is followed in both directions [m] */
static const double EITHER_WAY = -DBL_MAX;

/* a dent shallower than this, relative to the largest indentation, is a rounding error */
static const double SHALLOWEST_DENT = 8.0 * DBL_EPSILON;

typedef struct {
    double radius;         /* of the rigid impactor [m] */
    double modulus;        /* Young's, of the target [Pa] */
    double poissons_ratio; /* of the target */
    double strength;       /* yield strength of the target [Pa] */
    double gap;            /* before any motion [m] */
} Parameters;

#define PARAMETERS_OF_THE_SCENE ((Parameters){5e-3, 206e9, 0.3, 300e6, 0.0})

typedef enum { ELASTIC, FIRST, SECOND, PLASTIC, APART, UNLOADED } Kind;

/* F = constant + z (linear + power sqrt(z)), z = indentation - origin, for lower < indentation < upper */
typedef struct {
    double lower, upper, origin, constant, linear, power;
    double least; /* the smallest increment that stays on the branch [m]: zero on the loading curve beyond yield */
} Branch;

/*
 * The state of a contact. A step stores sum and rest. They are not adjacent, so that no compiler combines them into one wide
 * store, for which the narrow loads of the next step would have to wait.
 */
typedef struct {
    double sum; /* the indentation [m] */
    Branch branch;
    double rest;    /* what the roundings of the sum have lost (Neumaier) [m] */
    double largest; /* where the last unloading began [m]; 0: nothing has yielded */
    double power;   /* of that unloading */
    Kind kind, from; /* the branch, and the one that the last unloading began on */
} Contact;

/* values that follow from the parameters */
typedef struct {
    Branch loading[4];     /* by kind */
    double yield;          /* indentation at yield [m] */
    double saturated;      /* from here the mean pressure is the plastic one [m] */
    double recovery;       /* its square over force and mean pressure, which is in yield strengths [m^2/N] */
    double recovery_yield; /* recovery over force while the contact radius is that of yield [m/N] */
} Law;

/* apart, up to `upper` */
static inline Branch apart(double upper)
{
    return (Branch){-LARGEST_INDENTATION, upper, -LARGEST_INDENTATION, 0.0, 0.0, 0.0, EITHER_WAY};
}

static inline double force_on(const Branch *branch, double indentation)
{
    double z = indentation - branch->origin;
    return branch->constant + z * (branch->linear + branch->power * sqrt(z));
}

/* whether a step to this indentation stays on the branch; false for NaN */
static inline bool stays(const Contact *contact, double indentation, double increment)
{
    const Branch *branch = &contact->branch;
    return indentation > branch->lower && !(indentation >= branch->upper) && increment >= branch->least;
}

/* inlined, so that the compiler computes the law of the scene, and not each instance */
static inline __attribute__((always_inline)) Law make_law(const Parameters *given)
{
    double modulus = given->modulus / (1.0 - given->poissons_ratio * given->poissons_ratio);
    double stiffness = 4.0 / 3.0 * modulus * sqrt(given->radius);
    double strain = 0.75 * PI * YIELD_PRESSURE * given->strength / modulus;
    double d_y = given->radius * strain * strain, f_y = stiffness * (d_y * sqrt(d_y)), slope = f_y / d_y;
    double from_yield = SECOND_REGION - 1.0;
    double second_slope = 1.5 * sqrt(from_yield), second_force = from_yield * sqrt(from_yield) + 1.0;
    double plastic_force = second_slope * (FULLY_PLASTIC - SECOND_REGION) + second_force;
    double plastic_slope = 2.0 * PLASTIC_PRESSURE / YIELD_PRESSURE;
    double second = SECOND_REGION * d_y, plastic = FULLY_PLASTIC * d_y, none = -LARGEST_INDENTATION;
    double springs_back = 0.75 / modulus;
    return (Law){
        .loading = {
            [ELASTIC] = {0.0, d_y, 0.0, 0.0, 0.0, stiffness, EITHER_WAY},
            [FIRST] = {none, second, d_y, f_y, 0.0, stiffness, 0.0},
            [SECOND] = {none, plastic, second, second_force * f_y, second_slope * slope, 0.0, 0.0},
            [PLASTIC] = {none, LARGEST_INDENTATION, plastic, plastic_force * f_y, plastic_slope * slope, 0.0, 0.0},
        },
        .yield = d_y,
        .saturated = 0.5 * d_y * (exp(3.0 * (PLASTIC_PRESSURE - YIELD_PRESSURE)) + 1.0),
        .recovery = springs_back * springs_back * PI * given->strength,
        .recovery_yield = springs_back / sqrt(given->radius * d_y),
    };
}

static void unload(Contact *contact, double residual)
{
    contact->kind = UNLOADED;
    contact->branch = (Branch){residual, contact->largest, residual, 0.0, 0.0, contact->power, EITHER_WAY};
}

static void part(Contact *contact, double upper)
{
    contact->kind = APART;
    contact->branch = apart(upper);
}

/* changes to this branch of the loading curve, or to a later one */
static void load(Contact *contact, const Law *law, double indentation, Kind kind)
{
    while (indentation >= law->loading[kind].upper)
        kind++;
    contact->kind = kind;
    contact->branch = law->loading[kind];
}

/* leaves the loading curve beyond yield, where the contact is at `largest` */
static __attribute__((noinline)) void turn(Contact *contact, const Law *law, double largest, double indentation)
{
    double force = force_on(&contact->branch, largest), pressure = PLASTIC_PRESSURE;
    if (largest < law->saturated)
        pressure = YIELD_PRESSURE + log(2.0 * (largest / law->yield) - 1.0) / 3.0;
    /* the larger of the two contact radii */
    double recovery = sqrt(law->recovery * force * pressure), recovery_yield = law->recovery_yield * force;
    if (recovery > recovery_yield)
        recovery = recovery_yield;
    double residual = largest - recovery;
    if (fabs(residual) < SHALLOWEST_DENT * largest)
        residual = 0.0;
    recovery = largest - residual;
    contact->from = contact->kind;
    contact->largest = largest;
    contact->power = force / (recovery * sqrt(recovery));
    if (indentation > residual)
        unload(contact, residual);
    else
        part(contact, residual);
}

/* before any motion; in contact if the gap is negative */
static inline __attribute__((always_inline)) void start(Contact *contact, const Law *law, double gap)
{
    contact->sum = 0.0 - gap;
    contact->rest = contact->largest = contact->power = 0.0;
    contact->from = ELASTIC;
    part(contact, DBL_TRUE_MIN);
    if (gap < 0.0)
        load(contact, law, contact->sum, ELASTIC);
}

/* a step that leaves the branch; false if the indentation is out of range */
static bool leave(Contact *contact, const Law *law, double sum, double rest)
{
    double indentation = sum + rest, before = contact->sum + contact->rest;
    /* written positively to reject NaN, which is also the rest after an overflow */
    if (!(fabs(indentation) < LARGEST_INDENTATION))
        return false;
    switch (contact->kind) {
    case APART:
        if (indentation < contact->largest)
            unload(contact, contact->branch.upper);
        else
            load(contact, law, indentation, contact->from);
        break;
    case UNLOADED:
        if (indentation < contact->largest)
            part(contact, contact->branch.lower);
        else
            load(contact, law, indentation, contact->from);
        break;
    case ELASTIC:
        if (indentation > 0.0)
            load(contact, law, indentation, FIRST);
        else
            part(contact, DBL_TRUE_MIN);
        break;
    default:
        /* without motion, the branch stays */
        if (indentation > before)
            load(contact, law, indentation, contact->kind + 1);
        else if (indentation < before)
            turn(contact, law, before, indentation);
    }
    contact->sum = sum;
    contact->rest = rest;
    return true;
}

#endif
