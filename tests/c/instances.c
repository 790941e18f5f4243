/* Instances in threads, of which helgrind and valgrind see more than the suite of conformance; and their end. */
#include "unit.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum { THREADS = 8, STEPS = 20000 };

/* A hash of the bits of every force; the instance ends without fmi2Terminate. */
static void *run(void *result) {
    unsigned long long *hash = result;
    fmi2Component c = ready();
    for (int i = 0; i < STEPS; i++) {
        /* it loads, unloads and loads again */
        double value = step(c, i, 0.2 * cos(0.01 * i));
        unsigned long long bits;
        memcpy(&bits, &value, sizeof bits);
        *hash = (*hash ^ bits) * 0x100000001b3ULL;
    }
    fmi.FreeInstance(c);
    return NULL;
}

static void threads(void) {
    unsigned long long alone = 1, hashes[THREADS];
    pthread_t thread[THREADS];
    run(&alone);
    bool same = alone != 1;
    for (int t = 0; t < THREADS; t++) {
        hashes[t] = 1;
        same &= pthread_create(&thread[t], NULL, run, &hashes[t]) == 0;
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_join(thread[t], NULL);
        same &= hashes[t] == alone;
    }
    check("8 threads with an instance each get the same bits as one", same);
}

/* fmi2Terminate is not called, and the initialization is not completed. */
static void early_end(void) {
    fmi2Component c = instantiate();
    fmi.FreeInstance(c);
    c = instantiate();
    bool good = fmi.SetupExperiment(c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK;
    good &= fmi.EnterInitializationMode(c) == fmi2OK;
    fmi.FreeInstance(c);
    c = ready();
    good &= step(c, 0, 1.0) > 0;
    fmi.FreeInstance(c);
    check("an instance may be freed in any phase", good);
}

void check_instances(void) {
    threads();
    early_end();
}
