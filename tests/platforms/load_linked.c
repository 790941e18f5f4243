/* The library is part of the host: its C source was compiled with it. */
#include "load.h"
#include "unit.h"

#include <string.h>

#define ENTRY(name) {"fmi2" #name, (void (*)(void))fmi2##name},
static const struct {
    const char *name;
    void (*function)(void);
} functions[] = {FUNCTIONS(ENTRY)};

void *load_library(const char *path, char *message, size_t size) {
    (void)path, (void)message, (void)size;
    return (void *)&functions[0].name;
}

bool load_function(void *library, const char *name, void *function) {
    (void)library;
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if (strcmp(functions[i].name, name) == 0) {
            memcpy(function, &functions[i].function, sizeof functions[i].function);
            return true;
        }
    }
    return false;
}

void unload_library(void *library) { (void)library; }

const char *host_name(void) { return "linked"; }
