/* clang's own header of vector instructions includes it */
#include <stdlib.h>
#ifdef __cplusplus
extern "C" {
#endif
void *_aligned_malloc(size_t size, size_t alignment);
void _aligned_free(void *memory);
#ifdef __cplusplus
}
#endif
