/*
 * FMUs of strangers, which harm the process that loads them: compiled with one of
 *   END    ends the process with success when it is loaded
 *   CRASH  aborts when it is loaded
 *   HANG   never returns when it is loaded
 *   FORK   ends the process and leaves another one that holds its pipes
 *   TALK   prints gigabytes in one line and ends the process
 *   FORCE=x  every Real is x, whatever is set
 */
#include "phases.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef FORCE
#define FORCE 0.0
#endif

__attribute__((constructor)) static void load(void)
{
#if defined END
    _exit(0);
#elif defined CRASH
    abort();
#elif defined HANG
    for (;;)
        pause();
#elif defined FORK
    if (fork() == 0) {
        sleep(60);
        _exit(0);
    }
    _exit(0);
#elif defined TALK
    static char piece[1 << 20];
    memset(piece, 'x', sizeof piece);
    for (int i = 0; i < 2000; i++)
        fwrite(piece, 1, sizeof piece, stderr);
    _exit(0);
#endif
}

static char instance;

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)resources, (void)callbacks, (void)visible, (void)logging;
    return &instance;
}

void fmi2FreeInstance(fmi2Component component) { (void)component; }

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    return (void)component, (void)on, (void)count, (void)categories, fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component) { return (void)component, fmi2OK; }

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    (void)component, (void)references;
    for (size_t i = 0; i < count; i++)
        values[i] = FORCE;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    return (void)component, (void)references, (void)count, (void)values, fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_way_back)
{
    return (void)component, (void)time, (void)step, (void)no_way_back, fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                       const int orders[], const fmi2Real values[])
{
    return (void)component, (void)references, (void)count, (void)orders, (void)values, fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                        const int orders[], fmi2Real values[])
{
    return (void)orders, fmi2GetReal(component, references, count, values);
}
