/*
 * An FMU as another vendor may write it: a linear spring without damping. It takes its memory from the importer, requires
 * the location of its resources, warns in every step, and has no parameters and no output except the force.
 */
#include "phases.h"

#include <string.h>

enum { INDENTATION_RATE, FORCE };

static const double STIFFNESS = 1e8; /* [N/m] */

typedef struct {
    fmi2CallbackFunctions callbacks;
    double rate, indentation;
} Spring;

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)visible, (void)logging;
    if (type != fmi2CoSimulation || strcmp(guid, "{spring}") != 0 || strncmp(resources, "file:///", 8) != 0)
        return NULL;
    Spring *spring = callbacks->allocateMemory(1, sizeof *spring);
    if (spring)
        spring->callbacks = *callbacks;
    return spring;
}

void fmi2FreeInstance(fmi2Component component)
{
    Spring *spring = component;
    spring->callbacks.freeMemory(spring);
}

fmi2Status fmi2Reset(fmi2Component component)
{
    Spring *spring = component;
    spring->rate = spring->indentation = 0;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Spring *spring = component;
    if (count != 1 || references[0] != INDENTATION_RATE)
        return fmi2Error;
    spring->rate = values[0];
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    const Spring *spring = component;
    if (count != 1 || references[0] != FORCE)
        return fmi2Error;
    values[0] = spring->indentation > 0 ? STIFFNESS * spring->indentation : 0;
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Spring *spring = component;
    (void)time, (void)no_state_is_set_before;
#ifdef REFUSES_SHORT_STEPS
    if (step < 1e-6)
        return fmi2Error;
#endif
    spring->indentation += step * spring->rate;
    return fmi2Warning;
}

fmi2Status fmi2SetDebugLogging(fmi2Component component) { return (void)component, fmi2OK; }

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component) { return (void)component, fmi2Error; }

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component) { return (void)component, fmi2Error; }
