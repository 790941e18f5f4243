/* The system loads the library; with NAMESPACE, into a separate namespace without access to the process. */
#define _GNU_SOURCE
#include "load.h"

#include <stdio.h>
#include <string.h>

#ifdef _WIN32

#include <windows.h>

void *load_library(const char *path, char *message, size_t size) {
    void *library = (void *)LoadLibraryA(path);
    if (library == NULL) {
        snprintf(message, size, "error %lu of LoadLibrary", GetLastError());
    }
    return library;
}

bool load_function(void *library, const char *name, void *function) {
    FARPROC symbol = GetProcAddress((HMODULE)library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

void unload_library(void *library) { FreeLibrary((HMODULE)library); }

/* wine provides a function that Windows does not have */
const char *host_name(void) {
    static char name[64];
    const char *(*version)(void) = NULL;
    HMODULE ntdll = GetModuleHandleA("ntdll.dll");
    if (ntdll != NULL && load_function((void *)ntdll, "wine_get_version", &version)) {
        snprintf(name, sizeof name, "wine %s", version());
        return name;
    }
    return "Windows";
}

#else

#include <dlfcn.h>
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

void *load_library(const char *path, char *message, size_t size) {
#ifdef NAMESPACE
    void *library = dlmopen(LM_ID_NEWLM, path, RTLD_NOW | RTLD_LOCAL);
#else
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
#endif
    if (library == NULL) {
        snprintf(message, size, "%s", dlerror());
    }
    return library;
}

/* A pointer to a function is not a pointer to an object, but POSIX guarantees the same bytes. */
bool load_function(void *library, const char *name, void *function) {
    void *symbol = dlsym(library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

void unload_library(void *library) { dlclose(library); }

const char *host_name(void) {
    static char name[64];
#ifdef __GLIBC__
    snprintf(name, sizeof name, "glibc %s", gnu_get_libc_version());
#else
    snprintf(name, sizeof name, "another C library");
#endif
    return name;
}

#endif
