/* Instances: what they keep of their importer, and their independence of each other. */
#include "unit.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 8, STEPS = 20000, MANY = 10000, STEPS_OF_MANY = 20 };

/* The importer may keep strings and callbacks on its stack. */
static void copies(void) {
    char name[40], id[80], resources[] = "file:///resources";
    snprintf(name, sizeof name, "%s", instance_name);
    snprintf(id, sizeof id, "%s", guid);
    fmi2CallbackFunctions *own = malloc(sizeof *own);
    *own = callbacks;
    fmi2Component c = fmi.Instantiate(name, fmi2CoSimulation, id, resources, own, fmi2False, fmi2True);
    memset(name, 'x', sizeof name - 1);
    memset(id, 'x', sizeof id - 1);
    memset(resources, 'x', sizeof resources - 1);
    memset(own, 0x5a, sizeof *own);
    free(own);
    int before = messages;
    check("strings and callbacks are copied",
          c != NULL && fmi.DoStep(c, 0, 1, fmi2True) == fmi2Error && messages == before + 1 && wrong_messages == 0);
    fmi.FreeInstance(c);
}

/* A rate that loads, unloads and loads again, different for each number and the same for equal numbers. */
static double rate_of(int number, int i) { return (0.2 + 1e-4 * number) * cos(0.01 * i * (1 + number % 7)); }

/* One after the other, then all of them in turn: the forces must have the same bits. */
static void many(void) {
    static fmi2Component c[MANY];
    static double alone[MANY];
    bool works = true;
    double sum = 0;
    for (int n = 0; n < MANY; n++) {
        c[n] = ready();
        for (int i = 0; i < STEPS_OF_MANY; i++) {
            alone[n] = step(c[n], i, rate_of(n, i));
        }
        works &= alone[n] > -1e300;
        sum += alone[n];
        fmi.FreeInstance(c[n]);
    }
    check("10,000 instances one after the other press", works && sum > 0 && alone[1] != alone[MANY - 1]);
    for (int n = 0; n < MANY; n++) {
        c[n] = ready();
    }
    for (int i = 0; i < STEPS_OF_MANY; i++) {
        for (int n = 0; n < MANY; n++) {
            works &= step(c[n], i, rate_of(n, i)) > -1e300;
        }
    }
    for (int n = 0; n < MANY; n++) {
        works &= get(c[n], force) == alone[n];
    }
    check("10,000 instances in turns give what each gives alone", works);
    for (int n = MANY; n-- > 0;) {
        fmi.FreeInstance(c[n]);
    }
}

/* A hash of the bits of every force; the instance ends without fmi2Terminate. */
static void *run(void *result) {
    unsigned long long *hash = result;
    fmi2Component c = ready();
    for (int i = 0; i < STEPS; i++) {
        double value = step(c, i, rate_of(0, i));
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
    copies();
    many();
    threads();
    early_end();
}
