/* Compiles only if the FMU's functions have the signatures of the standard: C refuses to declare a function twice
   with different types.

   brinell.h is the header of the FMU's functions, generated from the Rust source. FMI2_FUNCTION_PREFIX is not defined,
   so the standard's header declares the plain names. */
#include "fmi2Functions.h"

#include "brinell.h"
