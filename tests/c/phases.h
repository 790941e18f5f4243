/*
 * Functions of FMUs in tests to which a change of phase means nothing.
 */
#include "../../benches/units/fmi2.h"

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop)
{
    (void)component, (void)tolerance_defined, (void)tolerance, (void)start, (void)stop_defined, (void)stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) { return (void)component, fmi2OK; }

fmi2Status fmi2ExitInitializationMode(fmi2Component component) { return (void)component, fmi2OK; }

fmi2Status fmi2Terminate(fmi2Component component) { return (void)component, fmi2OK; }
