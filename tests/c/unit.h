/* An FMU's library, loaded by a C program, and the named checks of the driver. */
#ifndef UNIT_H
#define UNIT_H

#include "fmi2Functions.h"

#include <stdbool.h>
#include <stddef.h>

/* Every function with its type in the standard's headers; member and symbol have the same name. */
#define FUNCTIONS(X) \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) X(SetupExperiment) \
    X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger) X(GetBoolean) \
    X(GetString) X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) X(GetDirectionalDerivative) \
    X(SetRealInputDerivatives) X(GetRealOutputDerivatives) X(DoStep) X(CancelStep) X(GetStatus) X(GetRealStatus) \
    X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus) X(EnterEventMode) X(NewDiscreteStates) \
    X(EnterContinuousTimeMode) X(CompletedIntegratorStep) X(SetTime) X(SetContinuousStates) X(GetDerivatives) \
    X(GetEventIndicators) X(GetContinuousStates) X(GetNominalsOfContinuousStates)

#define MEMBER(name) fmi2##name##TYPE *name;
struct unit { FUNCTIONS(MEMBER) };

/* the FMU under test: its functions, and the values from its model description */
extern struct unit fmi;
extern const char *guid;
extern fmi2ValueReference rate, force, parameter, integer;

/* prints "ok NAME" or "FAIL NAME" and counts */
void check(const char *name, bool good);

/* the default name of instances; the environment that the logger must get */
extern const char instance_name[];
extern int environment;

/* the messages of the logger; `last_message` is the last one, as printed by printf */
extern int messages, wrong_messages;
extern char last_message[1024];
void logger(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);

/* calls of the importer's memory functions and of stepFinished: there must be none */
extern int forbidden_calls;
extern const fmi2CallbackFunctions callbacks;

fmi2Component instantiate(void);
/* an instance ready for steps from time 0 */
fmi2Component ready(void);
fmi2Status set_rate(fmi2Component, double);
double get(fmi2Component, fmi2ValueReference);
/* sets the rate, makes a step of 1e-7 s, returns the force */
double step(fmi2Component, int number, double rate);

/* calloc, malloc, realloc and free of the process while `counting`; in counting.c */
extern bool counts_allocations;
void count_from_here(void);
void stop_counting(void);
long allocations(void);
long releases(void);
/* from now on calloc returns NULL; from now on it doesn't */
void use_up_memory(void);
void have_memory(void);

void check_instances(void);
void check_memory(void);

#endif
