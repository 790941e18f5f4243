/* Null pointers: the caller is at fault, but the user would see a crash of the importer. */
#include "unit.h"

#include <stdio.h>
#include <string.h>

#define ERROR(call) check(#call " is fmi2Error", fmi.call == fmi2Error)

static void null_instance(void) {
    double x = 0;
    int i = 0;
    fmi2String string = "";
    fmi2Status status;
    fmi2FMUstate state = NULL;
    char bytes[8] = {0};
    size_t size;
    fmi2Component const none = NULL;
    ERROR(SetDebugLogging(none, fmi2True, 0, NULL));
    ERROR(SetupExperiment(none, fmi2False, 0, 0, fmi2False, 0));
    ERROR(EnterInitializationMode(none));
    ERROR(ExitInitializationMode(none));
    ERROR(Terminate(none));
    ERROR(Reset(none));
    ERROR(GetReal(none, &rate, 1, &x));
    ERROR(GetInteger(none, &integer, 1, &i));
    ERROR(GetBoolean(none, &rate, 1, &i));
    ERROR(GetString(none, &rate, 1, &string));
    ERROR(SetReal(none, &rate, 1, &x));
    ERROR(SetInteger(none, &integer, 1, &i));
    ERROR(SetBoolean(none, &rate, 1, &i));
    ERROR(SetString(none, &rate, 1, &string));
    ERROR(GetFMUstate(none, &state));
    ERROR(SetFMUstate(none, state));
    ERROR(FreeFMUstate(none, &state));
    ERROR(SerializedFMUstateSize(none, state, &size));
    ERROR(SerializeFMUstate(none, state, bytes, sizeof bytes));
    ERROR(DeSerializeFMUstate(none, bytes, sizeof bytes, &state));
    ERROR(GetDirectionalDerivative(none, &force, 1, &rate, 1, &x, &x));
    ERROR(SetRealInputDerivatives(none, &rate, 1, &i, &x));
    ERROR(GetRealOutputDerivatives(none, &force, 1, &i, &x));
    ERROR(DoStep(none, 0, 1e-6, fmi2True));
    ERROR(CancelStep(none));
    ERROR(GetStatus(none, fmi2DoStepStatus, &status));
    ERROR(GetRealStatus(none, fmi2LastSuccessfulTime, &x));
    ERROR(GetIntegerStatus(none, fmi2LastSuccessfulTime, &i));
    ERROR(GetBooleanStatus(none, fmi2Terminated, &i));
    ERROR(GetStringStatus(none, fmi2PendingStatus, &string));
    fmi.FreeInstance(NULL);
    check("FreeInstance(NULL) returns", true);
}

/* An error ends the simulation; each call below starts from the instance as it was. */
static fmi2Component c;
static fmi2FMUstate before;
static fmi2FMUstate restored(void) {
    last_message[0] = 0;
    return fmi.SetFMUstate(c, before) == fmi2OK ? before : NULL;
}

/* fmi2Error, with the function's name in the message */
#define REFUSED(name, ...) \
    check(#name "(c, " #__VA_ARGS__ ") is refused with a message", \
          restored() && fmi.name(c, __VA_ARGS__) == fmi2Error && strstr(last_message, "fmi2" #name ": ") != NULL)
/* and a message that an argument is null */
#define NULL_REFUSED(name, ...) \
    do { \
        REFUSED(name, __VA_ARGS__); \
        check("its message says that an argument is null", strstr(last_message, " is null") != NULL); \
    } while (0)
#define ACCEPTED(name, ...) \
    check(#name "(c, " #__VA_ARGS__ ") is fmi2OK", restored() && fmi.name(c, __VA_ARGS__) == fmi2OK)

static void null_arguments(void) {
    double x = 0;
    int i = 0;
    fmi2FMUstate none = NULL;
    static char bytes[4096];
    size_t size = 0;
    NULL_REFUSED(GetReal, NULL, 1, &x);
    NULL_REFUSED(GetReal, &force, 1, NULL);
    NULL_REFUSED(SetReal, NULL, 1, &x);
    NULL_REFUSED(SetReal, &rate, 1, NULL);
    NULL_REFUSED(GetInteger, NULL, 1, &i);
    NULL_REFUSED(GetInteger, &integer, 1, NULL);
    NULL_REFUSED(SetInteger, NULL, 1, &i);
    REFUSED(SetInteger, &integer, 1, NULL);
    NULL_REFUSED(GetBoolean, NULL, 1, NULL);
    NULL_REFUSED(GetString, NULL, 1, NULL);
    NULL_REFUSED(SetBoolean, NULL, 1, NULL);
    NULL_REFUSED(SetString, NULL, 1, NULL);
    REFUSED(GetBoolean, &rate, 1, NULL);
    REFUSED(GetString, &rate, 1, NULL);
    REFUSED(SetBoolean, &rate, 1, NULL);
    REFUSED(SetString, &rate, 1, NULL);
    REFUSED(GetDirectionalDerivative, NULL, 1, NULL, 1, NULL, NULL);
    REFUSED(GetDirectionalDerivative, &force, 1, &rate, 1, NULL, NULL);
    REFUSED(SetRealInputDerivatives, NULL, 1, NULL, NULL);
    REFUSED(SetRealInputDerivatives, &rate, 1, NULL, NULL);
    REFUSED(GetRealOutputDerivatives, NULL, 1, NULL, NULL);
    REFUSED(GetRealOutputDerivatives, &force, 1, NULL, NULL);
    NULL_REFUSED(SetDebugLogging, fmi2True, 1, NULL);
    NULL_REFUSED(SetDebugLogging, fmi2True, 1, (fmi2String[]){NULL});
    NULL_REFUSED(GetStatus, fmi2DoStepStatus, NULL);
    NULL_REFUSED(GetRealStatus, fmi2LastSuccessfulTime, NULL);
    NULL_REFUSED(GetIntegerStatus, fmi2LastSuccessfulTime, NULL);
    NULL_REFUSED(GetBooleanStatus, fmi2Terminated, NULL);
    NULL_REFUSED(GetStringStatus, fmi2PendingStatus, NULL);
    NULL_REFUSED(GetFMUstate, NULL);
    NULL_REFUSED(SetFMUstate, NULL);
    NULL_REFUSED(SerializedFMUstateSize, NULL, &size);
    NULL_REFUSED(SerializedFMUstateSize, before, NULL);
    NULL_REFUSED(SerializeFMUstate, NULL, bytes, sizeof bytes);
    ACCEPTED(SerializedFMUstateSize, before, &size);
    check("a serialized state has a size that fits here", size > 0 && size <= sizeof bytes);
    NULL_REFUSED(SerializeFMUstate, before, NULL, size);
    REFUSED(SerializeFMUstate, before, bytes, size - 1);
    REFUSED(SerializeFMUstate, before, NULL, 0);
    ACCEPTED(SerializeFMUstate, before, bytes, size);
    NULL_REFUSED(DeSerializeFMUstate, NULL, size, &none);
    NULL_REFUSED(DeSerializeFMUstate, bytes, size, NULL);
    REFUSED(DeSerializeFMUstate, NULL, 0, &none);
    check("a refused state leaves the pointer alone", none == NULL);
    ACCEPTED(FreeFMUstate, NULL);
    ACCEPTED(FreeFMUstate, &none);
}

static void nothing_of_nothing(void) {
    ACCEPTED(GetReal, NULL, 0, NULL);
    ACCEPTED(GetInteger, NULL, 0, NULL);
    ACCEPTED(GetBoolean, NULL, 0, NULL);
    ACCEPTED(GetString, NULL, 0, NULL);
    ACCEPTED(SetReal, NULL, 0, NULL);
    ACCEPTED(SetInteger, NULL, 0, NULL);
    ACCEPTED(SetBoolean, NULL, 0, NULL);
    ACCEPTED(SetString, NULL, 0, NULL);
    ACCEPTED(SetDebugLogging, fmi2True, 0, NULL);
}

/* Foreign text that an FMU might repeat in its message must not become a printf conversion. */
static void foreign_text(void) {
    ACCEPTED(SetDebugLogging, fmi2True, 1, (fmi2String[]){"%s%n%n#r0#"});
    int before_it = messages;
    check("a GUID with commands of printf is refused with a message",
          fmi.Instantiate(instance_name, fmi2CoSimulation, "%s%n#", "", &callbacks, fmi2False, fmi2True) == NULL &&
              messages == before_it + 1);
}

void check_null_pointers(void) {
    null_instance();
    c = ready();
    check("a state can be saved", fmi.GetFMUstate(c, &before) == fmi2OK && before != NULL);
    null_arguments();
    nothing_of_nothing();
    foreign_text();
    ACCEPTED(FreeFMUstate, &before);
    fmi.FreeInstance(c);
}
