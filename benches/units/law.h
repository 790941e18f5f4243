/* The law of Brinell's first scene, and one contact that follows it. */
#ifndef UNITS_LAW_H
#define UNITS_LAW_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#define LIKELY(condition) __builtin_expect(!!(condition), 1)
#define COLD __attribute__((cold, noinline))

static const double PI = 3.14159265358979323846;

/* material */
static const double RADIUS = 5e-3;          /* [m] */
static const double YOUNGS_MODULUS = 206e9; /* [Pa] */
static const double POISSONS_RATIO = 0.3;
static const double YIELD_STRENGTH = 300e6; /* [Pa] */

/* loading law, in yield indentations and yield strengths */
static const double SECOND_REGION = 13.93;
static const double FULLY_PLASTIC = 82.5;
static const double YIELD_PRESSURE = 1.1;
static const double PLASTIC_PRESSURE = 2.8;

static const double LARGEST_INDENTATION = 1e100; /* [m] */

/* F = constant + z (linear + power sqrt(z)), z = indentation - origin >= 0, for lower <= indentation < upper */
typedef struct {
    double lower, upper, origin, constant, linear, power;
} Branch;

/* apart */
#define OPEN ((Branch){-LARGEST_INDENTATION, DBL_TRUE_MIN, -LARGEST_INDENTATION, 0.0, 0.0, 0.0})

typedef struct {
    double sum, rest; /* the indentation, and what the roundings of the sum have lost (Neumaier) */
    double least;     /* the smallest increment that stays on the branch: zero on the loading curve */
    Branch branch;
    double largest; /* not kept on the loading curve, where it is the present indentation */
} Contact;

/* before any motion */
#define UNTOUCHED ((Contact){.least = -DBL_MAX, .branch = OPEN})

/* constants of the law, computed once for an instance */
typedef struct {
    double modulus;
    double yield_indentation;
    double residual_rounding;
    Branch elastic, first, second, plastic;
} Law;

static double force_on(const Branch *branch, double indentation)
{
    double z = indentation - branch->origin;
    return branch->constant + z * (branch->linear + branch->power * sqrt(z));
}

static Law make_law(void)
{
    Law law;
    law.modulus = YOUNGS_MODULUS / (1.0 - POISSONS_RATIO * POISSONS_RATIO);
    double stiffness = 4.0 / 3.0 * law.modulus * sqrt(RADIUS);
    double strain = 0.75 * PI * YIELD_PRESSURE * YIELD_STRENGTH / law.modulus;
    double d_y = RADIUS * strain * strain, f_y = stiffness * (d_y * sqrt(d_y));
    double from_yield = SECOND_REGION - 1.0;
    double second_slope = 1.5 * sqrt(from_yield), second_force = from_yield * sqrt(from_yield) + 1.0;
    double plastic_force = second_slope * (FULLY_PLASTIC - SECOND_REGION) + second_force;
    double plastic_slope = 2.0 * PLASTIC_PRESSURE / YIELD_PRESSURE;
    double second = SECOND_REGION * d_y, plastic = FULLY_PLASTIC * d_y, slope = f_y / d_y;
    law.yield_indentation = d_y;
    law.residual_rounding = 8.0 * DBL_EPSILON;
    law.elastic = (Branch){DBL_TRUE_MIN, d_y, 0.0, 0.0, 0.0, stiffness};
    law.first = (Branch){d_y, second, d_y, f_y, 0.0, stiffness};
    law.second = (Branch){second, plastic, second, second_force * f_y, second_slope * slope, 0.0};
    law.plastic = (Branch){plastic, LARGEST_INDENTATION, plastic, plastic_force * f_y, plastic_slope * slope, 0.0};
    return law;
}

static const Branch *loading_branch(const Law *law, double indentation)
{
    if (indentation < law->first.lower)
        return &law->elastic;
    if (indentation < law->second.lower)
        return &law->first;
    return indentation < law->plastic.lower ? &law->second : &law->plastic;
}

/* from the largest indentation, beyond yield, down to the dent that remains */
static Branch unloading_branch(const Law *law, double largest)
{
    double force = force_on(loading_branch(law, largest), largest);
    double pressure = YIELD_PRESSURE + log(2.0 * (largest / law->yield_indentation) - 1.0) / 3.0;
    double area = force / (PI * fmin(pressure, PLASTIC_PRESSURE) * YIELD_STRENGTH);
    double radius = sqrt(fmax(area, RADIUS * law->yield_indentation));
    double residual = largest - 0.75 * force / (law->modulus * radius);
    if (fabs(residual) < law->residual_rounding * largest)
        residual = 0.0;
    double recovery = largest - residual;
    return (Branch){residual, largest, residual, 0.0, 0.0, force / (recovery * sqrt(recovery))};
}

/* finds the branch at `indentation`; at a corner the one in the direction of motion */
COLD static bool enter(Contact *contact, const Law *law, double indentation, bool rising)
{
    if (!(indentation > -LARGEST_INDENTATION && indentation < LARGEST_INDENTATION))
        return false;
    double largest = fmax(fmax(contact->largest, contact->sum + contact->rest), indentation);
    Branch branch = OPEN;
    double least = -DBL_MAX;
    if (indentation > 0.0 && indentation >= largest) {
        branch = *loading_branch(law, indentation);
        branch.lower = indentation;
        least = 0.0;
    } else if (largest <= law->yield_indentation) {
        if (indentation > 0.0) {
            branch = law->elastic;
            branch.upper = largest;
        }
    } else {
        Branch unloading = unloading_branch(law, largest);
        double residual = unloading.lower;
        if (indentation > residual || (rising && indentation == residual)) {
            branch = unloading;
            branch.lower = nextafter(residual, INFINITY);
        } else {
            branch.upper = residual;
        }
    }
    contact->largest = largest;
    contact->branch = branch;
    contact->least = least;
    return true;
}

/* the step that may leave the branch; false if the indentation is out of range */
COLD static bool advance(Contact *contact, const Law *law, double increment)
{
    double sum = contact->sum + increment, rest = contact->rest + (increment - (sum - contact->sum));
    /* no motion, no other branch; what overflows has no rest */
    double indentation = isfinite(sum) ? sum + rest : sum;
    if (indentation != contact->sum + contact->rest && !enter(contact, law, indentation, increment > 0.0))
        return false;
    contact->sum = sum;
    contact->rest = rest;
    return true;
}

#endif
