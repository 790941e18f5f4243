/* The run-time part of a unit: what WebAssembly's instructions are in C. Nothing here allocates, jumps or traps.
   An access outside the memory, impossible unless the library has a mistake, goes to its beginning and marks the
   instance as failed: the call then returns fmi2Fatal. */
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0) || defined(_M_FP_FAST)
#error "compile without -ffast-math, /fp:fast and the like: results would differ"
#endif
#if defined(__FLT_EVAL_METHOD__)
#define BRINELL_EVAL_METHOD __FLT_EVAL_METHOD__
#elif defined(FLT_EVAL_METHOD)
#define BRINELL_EVAL_METHOD FLT_EVAL_METHOD
#elif defined(_M_IX86) && (!defined(_M_IX86_FP) || _M_IX86_FP < 2)
#define BRINELL_EVAL_METHOD 2
#else
#define BRINELL_EVAL_METHOD 0
#endif
#if BRINELL_EVAL_METHOD != 0 && BRINELL_EVAL_METHOD != 1
#error "doubles are computed in another precision: use -msse2 -mfpmath=sse, /arch:SSE2, or another processor's"
#endif
#if defined(_MSC_VER) && !defined(__clang__)
#pragma fp_contract(off)
#elif defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("fp-contract=off", "no-unsafe-math-optimizations", "no-associative-math", "no-reciprocal-math", \
                     "signed-zeros", "trapping-math")
#else
#pragma STDC FP_CONTRACT OFF
#endif
/* what the module may leave unused */
#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#elif defined(_MSC_VER)
#pragma warning(disable : 4100 4101 4102 4189 4505)
#endif
typedef uint8_t u8;
typedef int8_t s8;
typedef uint16_t u16;
typedef int16_t s16;
typedef uint32_t u32;
typedef int32_t s32;
typedef uint64_t u64;
typedef int64_t s64;
typedef double f64;
typedef float f32;
typedef char double_is_64_bits[sizeof(f64) == 8 ? 1 : -1];

struct Unit {
  u32 stack;               /* stack pointer of the module */
  u32 size;                /* of the memory below [bytes] */
  u32 failed;              /* an access was outside the memory */
  u32 is_made;             /* the component has its place */
  u32 snapshot, arguments; /* places in the memory */
  u32 state_size, serialized_size;
  void *pending; /* the importer's copy of a new state */
  fmi2CallbackFunctions functions;
  u64 memory[1]; /* the last bytes of the allocation */
};
typedef struct Unit Unit;
/* no compiler can join a product with the sum that uses it: it doesn't know what these empty instructions do */
#if defined(__GNUC__) && defined(__SSE2_MATH__)
#define OPAQUE(x) __asm__("" : "+x"(x))
#elif defined(__GNUC__) && (defined(__aarch64__) || (defined(__arm__) && defined(__VFP_FP__) && !defined(__SOFTFP__)))
#define OPAQUE(x) __asm__("" : "+w"(x))
#elif defined(__GNUC__) && defined(__s390x__)
#define OPAQUE(x) __asm__("" : "+f"(x))
#else
#define OPAQUE(x) (void)0
#endif
/* the memory begins where the stack may end, not at address 0: what is below is outside, a null pointer too */
#define LOWEST (STACK_TOP - STACK_SIZE)
#define PLACE(m, a) ((u8 *)(m)->memory + ((a) - LOWEST))
#define UNREACHABLE (m->failed = 1)
#define DIV_U(x, y) ((y) ? (x) / (y) : (m->failed = 1, 0u))
#define I32_DIV_S(x, y) \
  ((y) && !((x) == 0x80000000u && (y) == 0xffffffffu) ? (u32)((s32)(x) / (s32)(y)) : (m->failed = 1, 0u))
#define I64_DIV_S(x, y) \
  ((y) && !((x) == (u64)1 << 63 && (y) == ~(u64)0) ? (u64)((s64)(x) / (s64)(y)) : (m->failed = 1, (u64)0))
#define I32_REM_S(x, y) ((y) ? ((y) == 0xffffffffu ? 0u : (u32)((s32)(x) % (s32)(y))) : (m->failed = 1, 0u))
#define I64_REM_S(x, y) ((y) ? ((y) == ~(u64)0 ? (u64)0 : (u64)((s64)(x) % (s64)(y))) : (m->failed = 1, (u64)0))
#define REM_U(x, y) ((y) ? (x) % (y) : (m->failed = 1, 0u))

#if defined(__GNUC__)
#define UNLIKELY(x) __builtin_expect(!!(x), 0)
#else
#define UNLIKELY(x) (x)
#endif
static u8 *outside(Unit *m) {
  m->failed = 1;
  return (u8 *)m->memory;
}
/* the first comparison is one of constants where the address is one */
#define AT(m, a, n) (UNLIKELY((a) - LOWEST > LEAST - (n) && (a) - LOWEST > (m)->size - (n)) ? outside(m) : PLACE(m, a))
/* the memory is little-endian on every processor */
#if (defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) || defined(_MSC_VER) || \
    defined(BRINELL_LITTLE_ENDIAN)
static inline u16 get16(const u8 *p) {
  u16 r;
  memcpy(&r, p, 2);
  return r;
}
static inline u32 get32(const u8 *p) {
  u32 r;
  memcpy(&r, p, 4);
  return r;
}
static inline u64 get64(const u8 *p) {
  u64 r;
  memcpy(&r, p, 8);
  return r;
}
static inline void put16(u8 *p, u16 v) { memcpy(p, &v, 2); }
static inline void put32(u8 *p, u32 v) { memcpy(p, &v, 4); }
static inline void put64(u8 *p, u64 v) { memcpy(p, &v, 8); }
#else
static inline u16 get16(const u8 *p) { return (u16)(p[0] | p[1] << 8); }
static inline u32 get32(const u8 *p) { return p[0] | (u32)p[1] << 8 | (u32)p[2] << 16 | (u32)p[3] << 24; }
static inline u64 get64(const u8 *p) {
  return p[0] | (u64)p[1] << 8 | (u64)p[2] << 16 | (u64)p[3] << 24 | (u64)p[4] << 32 | (u64)p[5] << 40 |
         (u64)p[6] << 48 | (u64)p[7] << 56;
}
static inline void put16(u8 *p, u16 v) {
  p[0] = (u8)v;
  p[1] = (u8)(v >> 8);
}
static inline void put32(u8 *p, u32 v) {
  p[0] = (u8)v;
  p[1] = (u8)(v >> 8);
  p[2] = (u8)(v >> 16);
  p[3] = (u8)(v >> 24);
}
static inline void put64(u8 *p, u64 v) {
  p[0] = (u8)v;
  p[1] = (u8)(v >> 8);
  p[2] = (u8)(v >> 16);
  p[3] = (u8)(v >> 24);
  p[4] = (u8)(v >> 32);
  p[5] = (u8)(v >> 40);
  p[6] = (u8)(v >> 48);
  p[7] = (u8)(v >> 56);
}
#endif
static inline f64 f64_reinterpret_i64(u64 x) {
  f64 r;
  memcpy(&r, &x, 8);
  return r;
}
static inline u64 i64_reinterpret_f64(f64 x) {
  u64 r;
  memcpy(&r, &x, 8);
  return r;
}
#define LOAD(name, result, n, expression)     \
  static inline result name(Unit *m, u64 a) { \
    const u8 *p = AT(m, a, n);                \
    return expression;                        \
  }
#define STORE(name, value, n, statement)             \
  static inline void name(Unit *m, u64 a, value v) { \
    u8 *p = AT(m, a, n);                             \
    statement;                                       \
  }
LOAD(i32_load, u32, 4, get32(p))
LOAD(i64_load, u64, 8, get64(p))
LOAD(f64_load, f64, 8, f64_reinterpret_i64(get64(p)))
LOAD(i32_load8_u, u32, 1, *p)
LOAD(i32_load8_s, u32, 1, (u32)(s32)(s8)*p)
LOAD(i64_load8_u, u64, 1, *p)
LOAD(i64_load8_s, u64, 1, (u64)(s64)(s8)*p)
LOAD(i32_load16_u, u32, 2, get16(p))
LOAD(i32_load16_s, u32, 2, (u32)(s32)(s16)get16(p))
LOAD(i64_load16_u, u64, 2, get16(p))
LOAD(i64_load32_u, u64, 4, get32(p))
LOAD(i64_load32_s, u64, 4, (u64)(s64)(s32)get32(p))
STORE(i32_store, u32, 4, put32(p, v))
STORE(i64_store, u64, 8, put64(p, v))
STORE(f64_store, f64, 8, put64(p, i64_reinterpret_f64(v)))
STORE(i32_store8, u32, 1, *p = (u8)v)
STORE(i32_store16, u32, 2, put16(p, (u16)v))
STORE(i64_store8, u64, 1, *p = (u8)v)
STORE(i64_store16, u64, 2, put16(p, (u16)v))
STORE(i64_store32, u64, 4, put32(p, (u32)v))
static inline int is_inside(Unit *m, u32 a, u32 n) {
  if (n <= m->size && a - LOWEST <= m->size - n) return 1;
  m->failed = 1;
  return 0;
}
static inline void memory_fill(Unit *m, u32 d, u32 value, u32 n) {
  if (is_inside(m, d, n)) memset(PLACE(m, d), (int)value, n);
}
static inline void memory_copy(Unit *m, Unit *same, u32 d, u32 s, u32 n) {
  (void)same;
  if (is_inside(m, d, n) && is_inside(m, s, n)) memmove(PLACE(m, d), PLACE(m, s), n);
}
static inline f32 f32_of(u32 x) {
  f32 r;
  memcpy(&r, &x, 4);
  return r;
}
static inline u32 of_f32(f32 x) {
  u32 r;
  memcpy(&r, &x, 4);
  return r;
}
LOAD(f32_load, f32, 4, f32_of(get32(p)))
STORE(f32_store, f32, 4, put32(p, of_f32(v)))
#define wasm_quiet(x) (x)
#define wasm_quietf(x) (x)
#define SIGN 0x8000000000000000u
#if defined(__GNUC__)
#define wasm_fabs __builtin_fabs
#define wasm_copysign __builtin_copysign
#else
static inline f64 wasm_fabs(f64 x) { return f64_reinterpret_i64(i64_reinterpret_f64(x) & ~(u64)SIGN); }
static inline f64 wasm_copysign(f64 x, f64 y) {
  return f64_reinterpret_i64((i64_reinterpret_f64(x) & ~(u64)SIGN) | (i64_reinterpret_f64(y) & SIGN));
}
#endif
#define copysign wasm_copysign
static inline u32 I32_TRUNC_SAT_U_F64(f64 x) { return !(x > -1.0) ? 0u : !(x < 4294967296.0) ? 0xffffffffu : (u32)x; }
static inline u32 I32_TRUNC_SAT_S_F64(f64 x) {
  return x != x ? 0u : !(x > -2147483649.0) ? 0x80000000u : !(x < 2147483648.0) ? 0x7fffffffu : (u32)(s32)x;
}
static inline u64 I64_TRUNC_SAT_U_F64(f64 x) {
  return !(x > -1.0) ? 0u : !(x < 18446744073709551616.0) ? ~(u64)0 : (u64)x;
}
static inline u64 I64_TRUNC_SAT_S_F64(f64 x) {
  return x != x                           ? 0u
         : !(x >= -9223372036854775808.0) ? (u64)1 << 63
         : !(x < 9223372036854775808.0)   ? ~(u64)0 >> 1
                                          : (u64)(s64)x;
}
static inline u32 I32_CLZ(u32 x) {
  u32 n = 32;
  while (x) {
    x >>= 1;
    n--;
  }
  return n;
}
static inline u32 I64_CLZ(u64 x) {
  u32 n = 64;
  while (x) {
    x >>= 1;
    n--;
  }
  return n;
}
static inline u32 I32_CTZ(u32 x) {
  u32 n = 0;
  if (!x) return 32;
  while (!(x & 1)) {
    x >>= 1;
    n++;
  }
  return n;
}
static inline u64 I64_CTZ(u64 x) {
  u32 n = 0;
  if (!x) return 64;
  while (!(x & 1)) {
    x >>= 1;
    n++;
  }
  return n;
}
static inline u64 I64_POPCNT(u64 x) {
  u64 n = 0;
  while (x) {
    x &= x - 1;
    n++;
  }
  return n;
}
static inline u32 I32_POPCNT(u32 x) { return (u32)I64_POPCNT(x); }
#define ROT(x, y, bits) (((x) << ((y) & (bits - 1))) | ((x) >> ((bits - ((y) & (bits - 1))) & (bits - 1))))
#define I32_ROTL(x, y) ROT(x, y, 32)
#define I64_ROTL(x, y) ROT(x, y, 64)
