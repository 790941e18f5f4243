/*
 * A body for the tests of importers: `force` reduces its closing speed, and is constant over a step. All functions of
 * co-simulation exist, because many importers load them all; those that a body does not need return an error.
 */
#include "phases.h"

#include <stdlib.h>

enum { FORCE, RATE, MASS, INITIAL_RATE, ACCELERATION, VARIABLES };

/* closing acceleration by all forces but that of the contact [m/s^2] */
#ifndef GRAVITY
#define GRAVITY 0.0
#endif

typedef struct {
    double values[VARIABLES];
} Body;

static const Body START = {{0.0, 1.0, 4e-3, 1.0, GRAVITY}};

const char *fmi2GetTypesPlatform(void) { return "default"; }

const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)guid, (void)resources, (void)callbacks, (void)visible, (void)logging;
    Body *body = type == fmi2CoSimulation ? malloc(sizeof *body) : NULL;
    if (body)
        *body = START;
    return body;
}

void fmi2FreeInstance(fmi2Component component) { free(component); }

fmi2Status fmi2Reset(fmi2Component component)
{
    *(Body *)component = START;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Body *body = component;
    for (size_t i = 0; i < count; i++) {
        if (references[i] >= VARIABLES || references[i] == RATE || references[i] == ACCELERATION)
            return fmi2Error;
        body->values[references[i]] = values[i];
        if (references[i] == INITIAL_RATE)
            body->values[RATE] = values[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    const Body *body = component;
    for (size_t i = 0; i < count; i++) {
        if (references[i] >= VARIABLES)
            return fmi2Error;
        values[i] = body->values[references[i]];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_state_is_set_before)
{
    Body *body = component;
    (void)time, (void)no_state_is_set_before;
    body->values[RATE] += step * (body->values[ACCELERATION] - body->values[FORCE] / body->values[MASS]);
    return fmi2OK;
}

/* logging is accepted but never happens; for other types, only calls without values are accepted */
fmi2Status fmi2SetDebugLogging(fmi2Component component) { return (void)component, fmi2OK; }

#define NO_OTHER_TYPE(function) \
    fmi2Status function(fmi2Component component, const fmi2ValueReference references[], size_t count, const void *values) \
    { \
        return (void)component, (void)references, (void)values, count == 0 ? fmi2OK : fmi2Error; \
    }
NO_OTHER_TYPE(fmi2GetInteger)
NO_OTHER_TYPE(fmi2GetBoolean)
NO_OTHER_TYPE(fmi2GetString)
NO_OTHER_TYPE(fmi2SetInteger)
NO_OTHER_TYPE(fmi2SetBoolean)
NO_OTHER_TYPE(fmi2SetString)

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state) { return (void)component, (void)state, fmi2Error; }

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) { return (void)component, (void)state, fmi2Error; }

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *state) { return (void)component, (void)state, fmi2Error; }

#define REFUSED(function) \
    fmi2Status function(fmi2Component component) { return (void)component, fmi2Error; }
REFUSED(fmi2SerializedFMUstateSize)
REFUSED(fmi2SerializeFMUstate)
REFUSED(fmi2DeSerializeFMUstate)
REFUSED(fmi2GetDirectionalDerivative)
REFUSED(fmi2SetRealInputDerivatives)
REFUSED(fmi2GetRealOutputDerivatives)
REFUSED(fmi2CancelStep)
REFUSED(fmi2GetStatus)
REFUSED(fmi2GetRealStatus)
REFUSED(fmi2GetIntegerStatus)
REFUSED(fmi2GetBooleanStatus)
REFUSED(fmi2GetStringStatus)
