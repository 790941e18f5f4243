#define HUGE_VAL ((double)1e300 * 1e300)
