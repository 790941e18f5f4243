/* What C source needs of Microsoft's C library, whose headers may not be copied. */
#ifndef STDLIB_H
#define STDLIB_H
typedef unsigned long long size_t;
#ifdef __cplusplus
#define NULL 0
extern "C" {
#else
#define NULL ((void *)0)
#endif
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *memory, size_t size);
void free(void *memory);
#ifdef __cplusplus
}
#endif
#endif
