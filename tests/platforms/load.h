/* How a host loads a library; each kind of host is compiled with one of the two files that have these functions. */
#ifndef LOAD_H
#define LOAD_H

#include <stdbool.h>
#include <stddef.h>

/* The library at `path`; null with the reason in `message` of `size` bytes. */
void *load_library(const char *path, char *message, size_t size);
/* Puts the address of the function `name` at `function`. */
bool load_function(void *library, const char *name, void *function);
void unload_library(void *library);
/* What the host runs on. */
const char *host_name(void);

#endif
