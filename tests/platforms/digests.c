/* The bits of laws on some platform: digests LIBRARY digests < LIST. Each line of LIST has the arguments of brinell_digest, whose result
   is printed. */
#include "load.h"

#include <inttypes.h>
#include <stdio.h>

int main(int count, char **arguments) {
    char message[256] = "";
    void *library = count == 3 ? load_library(arguments[1], message, sizeof message) : NULL;
    uint64_t (*digest)(uint32_t, uint32_t, uint32_t, uint64_t);
    if (library == NULL || !load_function(library, "brinell_digest", &digest)) {
        printf("FAIL %s\n", message);
        return 1;
    }
    uint32_t law, unloading, way;
    uint64_t seed;
    while (scanf("%" SCNu32 " %" SCNu32 " %" SCNu32 " %" SCNu64, &law, &unloading, &way, &seed) == 4) {
        printf("%016" PRIx64 "\n", digest(law, unloading, way, seed));
    }
    printf("end\n%s\n", host_name());
    return 0;
}
