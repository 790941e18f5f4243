/* Counts the memory that an FMU's library takes from the process and gives back.

   The program is linked with -rdynamic and precedes the C library when the loader looks up a name, so the FMU finds these
   functions. With NO_COUNTING nothing is defined here: valgrind uses its own functions instead. */
#define _GNU_SOURCE
#include "unit.h"

#include <dlfcn.h>
#include <stdatomic.h>

static atomic_bool counting, exhausted;
static atomic_long allocated, released;

void count_from_here(void) {
    allocated = 0;
    released = 0;
    counting = true;
}

void stop_counting(void) { counting = false; }
long allocations(void) { return allocated; }
long releases(void) { return released; }
void use_up_memory(void) { exhausted = true; }
void have_memory(void) { exhausted = false; }

#ifdef NO_COUNTING
bool counts_allocations = false;
#else
bool counts_allocations = true;

/* the C library's own functions, under names that are not replaced */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void __libc_free(void *);

static void count(atomic_long *what) {
    if (counting) {
        (*what)++;
    }
}

void *malloc(size_t size) {
    count(&allocated);
    return __libc_malloc(size);
}

void *calloc(size_t number, size_t size) {
    count(&allocated);
    return exhausted ? NULL : __libc_calloc(number, size);
}

void *realloc(void *memory, size_t size) {
    count(&allocated);
    if (memory != NULL) {
        count(&released);
    }
    return __libc_realloc(memory, size);
}

void free(void *memory) {
    if (memory != NULL) {
        count(&released);
    }
    __libc_free(memory);
}
#endif
