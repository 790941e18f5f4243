/* How a host loads a library; each kind of host is compiled with one of the two files that have these functions. */
#ifndef LOAD_H
#define LOAD_H

#include <stdbool.h>
#include <stddef.h>

/* The library at `path`; null with the reason in `message` of `size` bytes. */
void *load_library(const char *path, char *message, size_t size);
/* Writes the address of the function `name` to `function`. */
bool load_function(void *library, const char *name, void *function);
void unload_library(void *library);
/* The system on which the host runs. */
const char *host_name(void);

#endif
