#ifndef STRING_H
#define STRING_H
#include <stdlib.h>
#ifdef __cplusplus
extern "C" {
#endif
void *memcpy(void *to, const void *from, size_t size);
void *memmove(void *to, const void *from, size_t size);
void *memset(void *to, int byte, size_t size);
size_t strlen(const char *text);
#ifdef __cplusplus
}
#endif
#endif
