/* A host that traps floating-point exceptions: exceptions LIBRARY GUID RATES DERIVATIVES OUTPUT..., where RATES is the number of
   inputs (the first value references), DERIVATIVES is "d" if they have derivatives, "l" for an FMU with a loss below yield, "p" if
   that is a plate, whose outputs have no derivatives, and "-" otherwise. The others are value references of Real outputs. A call
   that divides by zero, overflows or computes NaN ends this program with SIGFPE. */
#define _GNU_SOURCE
#include "fmi2Functions.h"

#include <dlfcn.h>
#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void quiet(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...) {
    (void)e, (void)n, (void)s, (void)c, (void)m;
}

#define LOAD(name) fmi2##name##TYPE *name = (fmi2##name##TYPE *)dlsym(library, "fmi2" #name)

int main(int count, char **arguments) {
    void *library = count > 4 ? dlopen(arguments[1], RTLD_NOW) : NULL;
    if (library == NULL) {
        return 2;
    }
    LOAD(Instantiate); LOAD(FreeInstance); LOAD(SetupExperiment); LOAD(EnterInitializationMode);
    LOAD(ExitInitializationMode); LOAD(GetReal); LOAD(SetReal); LOAD(DoStep); LOAD(GetFMUstate); LOAD(SetFMUstate);
    LOAD(FreeFMUstate); LOAD(GetRealOutputDerivatives); LOAD(SetRealInputDerivatives); LOAD(GetDirectionalDerivative);
    unsigned const rates = (unsigned)atoi(arguments[3]);
    static fmi2CallbackFunctions const callbacks = {quiet, NULL, NULL, NULL, NULL};
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    fmi2Component c = Instantiate("one", fmi2CoSimulation, arguments[2], "", &callbacks, 0, 1);
    fmi2Status worst = SetupExperiment(c, 0, 0, 0, 0, 0);
    worst |= EnterInitializationMode(c);
    worst |= ExitInitializationMode(c);
    /* after a touch at almost zero speed, a rate-dependent law rejects a faster rate */
    double const least = arguments[4][0] == 'd' ? 1e-300 : 1e-3;
    double const some[] = {0.0, -0.0, 1.0, 1.0, -0.3, -8.0, -least, least, 1e-3, 5.0, -1.0, 0.0, 9.0, -0.7, 0.01, -50.0};
    double time = 0, sum = 0;
    fmi2FMUstate state = NULL;
    for (int step = 0; step < 400; step++) {
        double const length = step % 3 ? 1e-7 : 2e-6;
        for (fmi2ValueReference rate = 0; rate < rates; rate++) {
            double const value = some[(step * 7 + step / 16 + (int)rate) % 16];
            worst |= SetReal(c, &rate, 1, &value);
            fmi2Integer const first = 1;
            double const acceleration = step % 5 ? 0.0 : -9.81;
            /* FMUs with a rate-dependent law have none */
            if (arguments[4][0] == 'd') {
                worst |= SetRealInputDerivatives(c, &rate, 1, &first, &acceleration);
            }
        }
        worst |= DoStep(c, time, length, 1);
        time += length;
        for (int output = 5; output < count; output++) {
            fmi2ValueReference const reference = (fmi2ValueReference)atoi(arguments[output]), input = 0;
            double value = 0, derivative = 0, slope = 0;
            double const direction = 1;
            fmi2Integer const first = 1;
            worst |= GetReal(c, &reference, 1, &value);
            if (arguments[4][0] != 'p') {
                worst |= GetRealOutputDerivatives(c, &reference, 1, &first, &derivative);
            }
            worst |= GetDirectionalDerivative(c, &reference, 1, &input, 1, &direction, &slope);
            sum += value;
        }
        worst |= GetFMUstate(c, &state);
        worst |= SetFMUstate(c, state);
    }
    /* FMUs with a loss at speeds from 1e-6 to 1e3 m/s, at rest in between, and steps without length, which they refuse */
    int const speeds = arguments[4][0] == 'l' || arguments[4][0] == 'p' ? 190 : 0;
    for (int i = 0; i < speeds; i++) {
        double const speed = pow(10, i % 19 * 0.5 - 6), turned = i % 3 == 2 ? -1 : i % 7 == 6 ? 0 : 1;
        double const value = turned * speed, length = (1 + i % 5) * 1e-7 / speed;
        fmi2ValueReference const rate = 0;
        worst |= SetReal(c, &rate, 1, &value);
        worst |= DoStep(c, time, length, 1);
        time += length;
        for (int output = 5; output < count; output++) {
            fmi2ValueReference const reference = (fmi2ValueReference)atoi(arguments[output]);
            double amount = 0, slope = 0;
            double const direction = 1;
            worst |= GetReal(c, &reference, 1, &amount);
            worst |= GetDirectionalDerivative(c, &reference, 1, &rate, 1, &direction, &slope);
            sum += amount;
        }
        if (i % 38 == 37) {
            worst |= GetFMUstate(c, &state);
            fmi2Status const refused = DoStep(c, time, i % 2 ? 0.0 : -0.0, 1);
            worst |= refused == fmi2Error ? fmi2OK : fmi2Error;
            worst |= SetFMUstate(c, state);
        }
    }
    worst |= FreeFMUstate(c, &state);
    FreeInstance(c);
    printf("%g\n", sum);
    return worst == fmi2OK ? 0 : 3;
}
