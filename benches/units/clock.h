/* Phase and time of an instance, and the check of the times of a step, common to all FMUs in this folder. */
#ifndef UNITS_CLOCK_H
#define UNITS_CLOCK_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#define LIKELY(condition) __builtin_expect(!!(condition), 1)
#define COLD __attribute__((cold, noinline))

typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8, FAILED = 16 } Phase;

typedef struct {
    double stop; /* [s] */
    bool experiment_defined;
    Phase phase;
    double limit; /* where plain steps end [s]: at the stop time while stepping, and nowhere otherwise */
    double time;  /* end of the last step [s] */
} Clock;

#define BEFORE_ANY_STEP ((Clock){.stop = DBL_MAX, .phase = INSTANTIATED, .limit = -DBL_MAX})

/*
 * Whether a step to `end` clearly follows the last one. It is false if the step is zero, negative or NaN, because no distance
 * is smaller. Here and elsewhere, the second operand of a comparison is the one in memory, which saves a load.
 */
static inline bool is_plain(const Clock *clock, double time, double step, double end)
{
    return fabs(time - clock->time) * 10.0 < step && !(end > clock->limit);
}

/* the second check, with a tolerance for rounding far from zero */
static inline bool is_in_time(const Clock *clock, double time, double step)
{
    double rounding = 32.0 * DBL_EPSILON * (fabs(time) + fabs(clock->time));
    return step > 0.0 && step < INFINITY && fabs(time - clock->time) <= 0.1 * step + rounding
        && time + step - clock->stop <= 1e-3 * step + rounding;
}

#endif
