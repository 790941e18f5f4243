/* An FMI 2.0 co-simulation unit in C: the functions of FMI. Each copies its arguments into the memory of the module in
   brinell_unit.h, calls it, and copies results back. Compile this file; the two headers are parts of it. All other
   symbols are static. Needed: calloc, realloc, free, memcpy, memmove, memset, strlen. */
#include "brinell_unit.h"
#include "fmi2Functions.h"
#include <float.h>
#include <math.h> /* HUGE_VAL, no function */
#include <stdlib.h>
#include <string.h>
#ifndef BRINELL_NO_HARDWARE_SQRT
#if defined(__GNUC__) && defined(__SSE2__)
#include <emmintrin.h>
#define HARDWARE_SQRT(x) _mm_cvtsd_f64(_mm_sqrt_sd(_mm_set_sd(x), _mm_set_sd(x)))
#elif defined(_MSC_VER) && (defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP >= 2))
#include <emmintrin.h>
#define HARDWARE_SQRT(x) _mm_cvtsd_f64(_mm_sqrt_sd(_mm_set_sd(x), _mm_set_sd(x)))
#elif defined(__GNUC__) && defined(__aarch64__)
#include <arm_neon.h>
#define HARDWARE_SQRT(x) vget_lane_f64(vsqrt_f64(vdup_n_f64(x)), 0)
#endif
#endif
#define ROUND(n) (((n) + 15u) / 16u * 16u)
/* behind the data and the scene: results and pointers of a call, the component, a state, arguments */
#define RESULT ROUND(BLOCK_AT + SCENE_SIZE)
#define COMPONENT (RESULT + 64u)
#define RESERVED (VARIABLES * 16u + 64u)               /* for arrays of a call that names each variable once */
#define LEAST (COMPONENT + ROUND(FIXED_SIZE) - LOWEST) /* no memory is smaller */
#include "brinell_runtime.h"

static u32 import_calloc(Unit *m, u32 count, u32 size);
static void import_free(Unit *m, u32 place);
static void import_brinell_log(Unit *m, u32 name, u32 status, u32 category, u32 text);
#define BRINELL_FUNCTIONS
#include "brinell_unit.h"

typedef struct {
  Unit *m;
} Handle;
static fmi2Status fatal(const Unit *m, u32 status) { return m->failed ? fmi2Fatal : (fmi2Status)status; }
#define IN(c)                                \
  Unit *m = (c) ? ((Handle *)(c))->m : NULL; \
  if (!m) return fmi2Error;                  \
  if (m->failed) return fmi2Fatal
#define OUT(call) return fatal(m, call)

/* The module asks for memory: first for its component, then for states. */
static u32 import_calloc(Unit *m, u32 count, u32 size) {
  (void)count;
  if (!m->is_made) {
    m->is_made = 1;
    return size <= m->snapshot - COMPONENT ? (u32)COMPONENT : 0;
  }
  m->pending = size == m->state_size ? calloc(1, m->state_size) : NULL;
  if (!m->pending) return 0;
  memset(PLACE(m, m->snapshot), 0, size);
  return m->snapshot;
}
static void import_free(Unit *m, u32 place) {
  (void)m;
  (void)place;
}
static void import_brinell_log(Unit *m, u32 name, u32 status, u32 category, u32 text) {
  /* zeros follow the memory, so every text in it ends */
  if (name - LOWEST >= m->size || category - LOWEST >= m->size || text - LOWEST >= m->size) {
    m->failed = 1;
    return;
  }
  m->functions.logger(m->functions.componentEnvironment, (const char *)PLACE(m, name), (fmi2Status)status,
                      (const char *)PLACE(m, category), (const char *)PLACE(m, text));
}

/* Makes room for `n` times `each` bytes of arguments: only if an importer names variables more than once. */
static int room(fmi2Component c, Unit **unit, size_t n, u32 each) {
  Unit *m = *unit;
  u64 needed = (u64)(m->arguments - LOWEST) + (u64)n * each + 16;
  if (needed <= m->size) return 1;
  if (needed > 0x7fffffff || n > 0x7fffffff) return 0;
  m = (Unit *)realloc(m, sizeof(Unit) + (size_t)needed);
  if (!m) return 0;
  memset((u8 *)m->memory + m->size, 0, (size_t)needed - m->size + sizeof m->memory);
  m->size = (u32)needed;
  *unit = ((Handle *)c)->m = m;
  return 1;
}
static fmi2Status no_memory(Unit *m) {
  if (m->functions.logger)
    m->functions.logger(m->functions.componentEnvironment, "", fmi2Error, "logStatusError", "out of memory");
  return fmi2Error;
}
#define ROOM(n, each) \
  if (!room(c, &m, n, each)) return no_memory(m)
static u32 put_string(Unit *m, u32 place, const char *text) {
  size_t n = strlen(text) + 1;
  memcpy(PLACE(m, place), text, n);
  return place + (u32)n;
}
static u32 put_words(Unit *m, u32 place, const void *from, size_t n) { /* of 32 bits: place or null */
  size_t i;
  if (!from) return 0;
  for (i = 0; i < n; i++) {
    u32 word;
    memcpy(&word, (const char *)from + 4 * i, 4);
    put32(PLACE(m, place + 4 * i), word);
  }
  return place;
}
static u32 put_reals(Unit *m, u32 place, const fmi2Real *from, size_t n) {
  size_t i;
  if (!from) return 0;
  for (i = 0; i < n; i++) put64(PLACE(m, place + 8 * i), i64_reinterpret_f64(from[i]));
  return place;
}
static void get_reals(Unit *m, u32 place, fmi2Real *to, size_t n) {
  size_t i;
  for (i = 0; i < n; i++) to[i] = f64_reinterpret_i64(get64(PLACE(m, place + 8 * i)));
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

/* An instance with `bytes` of memory, with the data of the module and the scene. */
static Unit *loaded(Unit *old, u32 bytes) {
  Unit *m = (Unit *)realloc(old, sizeof(Unit) + bytes);
  size_t i;
  if (!m) {
    free(old);
    return NULL;
  }
  memset(m, 0, sizeof(Unit) + bytes);
  m->size = bytes;
  load_data(m);
  for (i = 0; i < SCENE_SIZE / 4; i++) put32(PLACE(m, BLOCK_AT + 4 * (u32)i), brinell_scene[i]);
  return m;
}
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean loggingOn) {
  Handle *handle;
  Unit *m;
  u64 instance, size;
  u32 state, serialized, text, reserved = RESERVED, component;
  size_t name_size = name ? strlen(name) + 1 : 0, guid_size = guid ? strlen(guid) + 1 : 0;
  (void)resources;
  if (!functions || name_size > 0x1000000 || guid_size > 0x1000000) return NULL;
  m = loaded(NULL, LEAST + 16);
  if (!m) return NULL;
  instance = (u64)unit_brinell_instance_size(m) + name_size;
  state = unit_brinell_state_size(m);
  serialized = unit_brinell_serialized_size(m);
  if (reserved < serialized + 16) reserved = serialized + 16;
  if (reserved < name_size + guid_size) reserved = (u32)(name_size + guid_size);
  size = COMPONENT - LOWEST + ROUND(instance) + ROUND((u64)state) + ROUND((u64)reserved);
  handle = (Handle *)calloc(1, sizeof(Handle));
  if (!handle || m->failed || size > 0x7fffffff) {
    free(handle);
    free(m);
    return NULL;
  }
  m = loaded(m, (u32)size);
  if (!m) {
    free(handle);
    return NULL;
  }
  handle->m = m;
  m->functions = *functions;
  m->state_size = state;
  m->serialized_size = serialized;
  m->snapshot = COMPONENT + (u32)ROUND(instance);
  m->arguments = m->snapshot + ROUND(state);
  put32(PLACE(m, RESULT), functions->logger != NULL);
  text = m->arguments;
  if (guid) text = put_string(m, text, guid);
  if (name) put_string(m, text, name);
  component = unit_Instantiate(m, name ? text : 0, (u32)type, guid ? m->arguments : 0, 0, RESULT, (u32)visible,
                                   (u32)loggingOn);
  if (!component || m->failed) {
    free(handle);
    free(m);
    return NULL;
  }
  return handle;
}
void fmi2FreeInstance(fmi2Component c) {
  if (c) {
    free(((Handle *)c)->m);
    free(c);
  }
}
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
  size_t i, bytes = 0;
  u32 place;
  IN(c);
  for (i = 0; categories && i < n; i++) bytes += categories[i] ? strlen(categories[i]) + 1 : 0;
  ROOM(n + bytes, 4);
  place = m->arguments + 4 * (u32)n;
  for (i = 0; categories && i < n; i++) {
    put32(PLACE(m, m->arguments + 4 * i), categories[i] ? place : 0);
    if (categories[i]) place = put_string(m, place, categories[i]);
  }
  OUT(unit_SetDebugLogging(m, COMPONENT, (u32)on, (u32)n, categories ? m->arguments : 0));
}
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean a, fmi2Real tolerance, fmi2Real start, fmi2Boolean b,
                               fmi2Real stop) {
  IN(c);
  OUT(unit_SetupExperiment(m, COMPONENT, (u32)a, tolerance, start, (u32)b, stop));
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  IN(c);
  OUT(unit_EnterInitializationMode(m, COMPONENT));
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  IN(c);
  OUT(unit_ExitInitializationMode(m, COMPONENT));
}
fmi2Status fmi2Terminate(fmi2Component c) {
  IN(c);
  OUT(unit_Terminate(m, COMPONENT));
}
fmi2Status fmi2Reset(fmi2Component c) {
  IN(c);
  OUT(unit_Reset(m, COMPONENT));
}
fmi2Status fmi2CancelStep(fmi2Component c) {
  IN(c);
  OUT(unit_CancelStep(m, COMPONENT));
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_set) {
  IN(c);
  OUT(unit_DoStep(m, COMPONENT, time, step, (u32)no_set));
}
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
  u32 references, values, status;
  IN(c);
  if (n == 1 && vr && value) {
    put32(PLACE(m, RESULT + 8), *vr);
    status = unit_GetReal(m, COMPONENT, RESULT + 8, 1, RESULT);
    if (status == fmi2OK) *value = f64_reinterpret_i64(get64(PLACE(m, RESULT)));
    OUT(status);
  }
  ROOM(n, 12);
  values = m->arguments;
  references = values + 8 * (u32)n;
  status = unit_GetReal(m, COMPONENT, put_words(m, references, vr, n), (u32)n, value ? values : 0);
  if (status == fmi2OK && value) get_reals(m, values, value, n);
  OUT(status);
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
  u32 references, values;
  IN(c);
  if (n == 1 && vr && value) {
    put32(PLACE(m, RESULT + 8), *vr);
    put64(PLACE(m, RESULT), i64_reinterpret_f64(*value));
    OUT(unit_SetReal(m, COMPONENT, RESULT + 8, 1, RESULT));
  }
  ROOM(n, 12);
  values = put_reals(m, m->arguments, value, n);
  references = m->arguments + 8 * (u32)n;
  OUT(unit_SetReal(m, COMPONENT, put_words(m, references, vr, n), (u32)n, values));
}
/* Integer, Boolean, String: 32 bits a value, in and out */
static fmi2Status get_words(fmi2Component c, u32 (*get)(Unit *, u32, u32, u32, u32), const fmi2ValueReference vr[],
                            size_t n, void *value) {
  u32 status;
  size_t i;
  IN(c);
  ROOM(n, 8);
  status = get(m, COMPONENT, put_words(m, m->arguments, vr, n), (u32)n, value ? m->arguments + 4 * (u32)n : 0);
  for (i = 0; status == fmi2OK && value && i < n; i++) {
    u32 word = get32(PLACE(m, m->arguments + 4 * (n + i)));
    memcpy((char *)value + 4 * i, &word, 4);
  }
  OUT(status);
}
static fmi2Status set_words(fmi2Component c, u32 (*set)(Unit *, u32, u32, u32, u32), const fmi2ValueReference vr[],
                            size_t n, const void *value) {
  IN(c);
  ROOM(n, 8);
  OUT(set(m, COMPONENT, put_words(m, m->arguments, vr, n), (u32)n, put_words(m, m->arguments + 4 * (u32)n, value, n)));
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[]) {
  return get_words(c, unit_GetInteger, vr, n, value);
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[]) {
  return get_words(c, unit_GetBoolean, vr, n, value);
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[]) {
  return set_words(c, unit_SetInteger, vr, n, value);
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[]) {
  return set_words(c, unit_SetBoolean, vr, n, value);
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[]) { /* there are none: an error, or nothing */
  IN(c);
  ROOM(n, 8);
  OUT(unit_GetString(m, COMPONENT, put_words(m, m->arguments, vr, n), (u32)n,
                         value ? m->arguments + 4 * (u32)n : 0));
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[]) {
  IN(c);
  ROOM(n, 8);
  OUT(unit_SetString(m, COMPONENT, put_words(m, m->arguments, vr, n), (u32)n,
                         value ? m->arguments + 4 * (u32)n : 0));
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
  u32 values, a;
  IN(c);
  ROOM(n, 16);
  a = m->arguments;
  values = put_reals(m, a, value, n);
  OUT(unit_SetRealInputDerivatives(m, COMPONENT, put_words(m, a + 8 * (u32)n, vr, n), (u32)n,
                                       put_words(m, a + 12 * (u32)n, order, n), values));
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[]) {
  u32 a, status;
  IN(c);
  ROOM(n, 16);
  a = m->arguments;
  status = unit_GetRealOutputDerivatives(m, COMPONENT, put_words(m, a + 8 * (u32)n, vr, n), (u32)n,
                                             put_words(m, a + 12 * (u32)n, order, n), value ? a : 0);
  if (status == fmi2OK && value) get_reals(m, a, value, n);
  OUT(status);
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t nUnknown,
                                        const fmi2ValueReference known[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
  u32 in, out, references, status;
  size_t n = nUnknown + nKnown;
  IN(c);
  ROOM(n, 12);
  out = m->arguments;
  in = out + 8 * (u32)nUnknown;
  references = in + 8 * (u32)nKnown;
  in = put_reals(m, in, dvKnown, nKnown);
  status = unit_GetDirectionalDerivative(m, COMPONENT, put_words(m, references, unknown, nUnknown), (u32)nUnknown,
                                             put_words(m, references + 4 * (u32)nUnknown, known, nKnown), (u32)nKnown,
                                             in, dvUnknown ? out : 0);
  if (status == fmi2OK && dvUnknown) get_reals(m, out, dvUnknown, nUnknown);
  OUT(status);
}
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
  u32 status;
  IN(c);
  status = unit_GetStatus(m, COMPONENT, (u32)s, value ? RESULT : 0);
  if (status == fmi2OK && value) *value = (fmi2Status)get32(PLACE(m, RESULT));
  OUT(status);
}
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
  u32 status;
  IN(c);
  status = unit_GetRealStatus(m, COMPONENT, (u32)s, value ? RESULT : 0);
  if (status == fmi2OK && value) get_reals(m, RESULT, value, 1);
  OUT(status);
}
static fmi2Status get_status_word(fmi2Component c, u32 (*get)(Unit *, u32, u32, u32), fmi2StatusKind s, int *value) {
  u32 status;
  IN(c);
  status = get(m, COMPONENT, (u32)s, value ? RESULT : 0);
  if (status == fmi2OK && value) *value = (int)get32(PLACE(m, RESULT));
  OUT(status);
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
  return get_status_word(c, unit_GetIntegerStatus, s, value);
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
  return get_status_word(c, unit_GetBooleanStatus, s, value);
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
  IN(c);
  OUT(unit_GetStringStatus(m, COMPONENT, (u32)s, value ? RESULT : 0));
}

/* States: the importer holds bytes of the module's own snapshot; one place in the memory takes the one of a call. */
static void bring(Unit *m, fmi2FMUstate state) { memcpy(PLACE(m, m->snapshot), state, m->state_size); }
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
  u32 status;
  IN(c);
  m->pending = NULL;
  if (state) {
    put32(PLACE(m, RESULT), *state ? m->snapshot : 0);
    if (*state) bring(m, *state);
  }
  status = unit_GetFMUstate(m, COMPONENT, state ? RESULT : 0);
  if (status == fmi2OK && !m->failed) {
    if (m->pending) *state = m->pending;
    memcpy(*state, PLACE(m, m->snapshot), m->state_size);
  } else
    free(m->pending);
  OUT(status);
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  IN(c);
  if (state) bring(m, state);
  OUT(unit_SetFMUstate(m, COMPONENT, state ? m->snapshot : 0));
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
  u32 status;
  IN(c);
  if (state) {
    put32(PLACE(m, RESULT), *state ? m->snapshot : 0);
    if (*state) bring(m, *state);
  }
  status = unit_FreeFMUstate(m, COMPONENT, state ? RESULT : 0);
  if (status == fmi2OK && state) {
    free(*state);
    *state = NULL;
  }
  OUT(status);
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
  u32 status;
  IN(c);
  if (state) bring(m, state);
  status = unit_SerializedFMUstateSize(m, COMPONENT, state ? m->snapshot : 0, size ? RESULT : 0);
  if (status == fmi2OK && size) *size = get32(PLACE(m, RESULT));
  OUT(status);
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  u32 status, n;
  IN(c);
  n = size > m->serialized_size ? m->serialized_size : (u32)size;
  ROOM(n, 1);
  if (state) bring(m, state);
  status = unit_SerializeFMUstate(m, COMPONENT, state ? m->snapshot : 0, bytes ? m->arguments : 0, n);
  if (status == fmi2OK && bytes) memcpy(bytes, PLACE(m, m->arguments), n);
  OUT(status);
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  u32 status, n;
  IN(c);
  n = size > m->serialized_size ? m->serialized_size + 1 : (u32)size;
  ROOM(n, 1);
  m->pending = NULL;
  if (bytes) memcpy(PLACE(m, m->arguments), bytes, n);
  status = unit_DeSerializeFMUstate(m, COMPONENT, bytes ? m->arguments : 0, n, state ? RESULT : 0);
  if (status == fmi2OK && !m->failed) {
    *state = m->pending;
    memcpy(*state, PLACE(m, m->snapshot), m->state_size);
  } else
    free(m->pending);
  OUT(status);
}

/* Model Exchange, for loaders that ask for all functions: each is refused. */
fmi2Status fmi2EnterEventMode(fmi2Component c) {
  IN(c);
  OUT(unit_EnterEventMode(m, COMPONENT));
}
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
  IN(c);
  (void)info;
  OUT(unit_NewDiscreteStates(m, COMPONENT, 0));
}
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  IN(c);
  OUT(unit_EnterContinuousTimeMode(m, COMPONENT));
}
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_set, fmi2Boolean *event, fmi2Boolean *end) {
  IN(c);
  (void)event;
  (void)end;
  OUT(unit_CompletedIntegratorStep(m, COMPONENT, (u32)no_set, 0, 0));
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  IN(c);
  OUT(unit_SetTime(m, COMPONENT, time));
}
/* The other five have an array and its length. */
static fmi2Status refuse(fmi2Component c, u32 (*function)(Unit *, u32, u32, u32), const void *values, size_t n) {
  IN(c);
  (void)values;
  OUT(function(m, COMPONENT, 0, (u32)n));
}
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) {
  return refuse(c, unit_SetContinuousStates, x, n);
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t n) {
  return refuse(c, unit_GetDerivatives, derivatives, n);
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t n) {
  return refuse(c, unit_GetEventIndicators, indicators, n);
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n) {
  return refuse(c, unit_GetContinuousStates, x, n);
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n) {
  return refuse(c, unit_GetNominalsOfContinuousStates, nominals, n);
}
