// SPDX-License-Identifier: BSD-3-Clause
// Vectors of ICPSCAPE_SIMD_WIDTH floats, which the including file defines, written with the
// compiler's vector extensions. For the files that CMakeLists.txt compiles once per SIMD level, and
// only for those: everything here has internal linkage, because the linker must never take one
// level's copy of an inline function for another's. For the same reason such a file uses no inline
// function that is not a template over these types.
#ifndef ICPSCAPE_SRC_SIMD_VECTORS_H_
#define ICPSCAPE_SRC_SIMD_VECTORS_H_

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include <cstdint>

namespace icpscape {
namespace {

constexpr int kWidth = ICPSCAPE_SIMD_WIDTH;        // Floats or ints in a vector.
constexpr int kDoubles = ICPSCAPE_SIMD_WIDTH / 2;  // Doubles in a vector.
typedef float FloatV __attribute__((vector_size(4 * ICPSCAPE_SIMD_WIDTH)));
typedef std::int32_t IntV __attribute__((vector_size(4 * ICPSCAPE_SIMD_WIDTH)));
typedef double DoubleV __attribute__((vector_size(4 * ICPSCAPE_SIMD_WIDTH)));
typedef std::int64_t LongV __attribute__((vector_size(4 * ICPSCAPE_SIMD_WIDTH)));

// Masks are IntV or LongV with all bits set where true: what comparisons of vectors give.

inline FloatV Splat(float value) { return value - FloatV{}; }
inline IntV Splat(std::int32_t value) { return value - IntV{}; }
inline DoubleV Splat(double value) { return value - DoubleV{}; }

// As the instructions do, both take the second operand where one is NaN.
inline FloatV Min(FloatV a, FloatV b) { return a < b ? a : b; }
inline FloatV Max(FloatV a, FloatV b) { return a > b ? a : b; }

inline FloatV LoadFloats(const float* from) {
  FloatV v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
inline DoubleV LoadDoubles(const double* from) {
  DoubleV v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class T, class V>
inline void Store(V v, T* to) {
  __builtin_memcpy(to, &v, sizeof v);
}

// One bit per lane.
inline unsigned Bits(IntV mask) {
#if ICPSCAPE_SIMD_WIDTH == 16
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
#elif ICPSCAPE_SIMD_WIDTH == 8
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  unsigned bits = 0;
  for (int i = 0; i < kWidth; ++i) {
    bits |= (mask[i] != 0 ? 1U : 0U) << i;
  }
  return bits;
#endif
}
inline bool AnyTrue(IntV mask) { return Bits(mask) != 0; }
inline bool AnyLessEqual(FloatV a, FloatV b) {
#if ICPSCAPE_SIMD_WIDTH == 16
  return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ) != 0;  // Without a detour through a vector.
#else
  return AnyTrue(a <= b);
#endif
}
inline bool AnyTrue(LongV mask) { return Bits(reinterpret_cast<IntV>(mask)) != 0; }

inline DoubleV Sqrt(DoubleV v) {
#if ICPSCAPE_SIMD_WIDTH == 16
  return _mm512_maskz_sqrt_pd(0xFF, v);  // The plain one trips -Wmaybe-uninitialized.
#elif ICPSCAPE_SIMD_WIDTH == 8
  return _mm256_sqrt_pd(v);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(v);
#else
  for (int i = 0; i < kDoubles; ++i) {
    v[i] = __builtin_sqrt(v[i]);
  }
  return v;
#endif
}

// The lower (half = 0) or upper (half = 1) lanes as doubles, and a mask's as one for them.
inline DoubleV ToDoubles(FloatV v, int half) {
  typedef float HalfV __attribute__((vector_size(2 * ICPSCAPE_SIMD_WIDTH)));
  HalfV part;
  __builtin_memcpy(&part, reinterpret_cast<const char*>(&v) + half * sizeof part, sizeof part);
  return __builtin_convertvector(part, DoubleV);
}
inline void SetHalf(DoubleV from, int half, FloatV* to) {
  typedef float HalfV __attribute__((vector_size(2 * ICPSCAPE_SIMD_WIDTH)));
  const HalfV part = __builtin_convertvector(from, HalfV);
  __builtin_memcpy(reinterpret_cast<char*>(to) + half * sizeof part, &part, sizeof part);
}
inline LongV ToLongs(IntV v, int half) {
  typedef std::int32_t HalfV __attribute__((vector_size(2 * ICPSCAPE_SIMD_WIDTH)));
  HalfV part;
  __builtin_memcpy(&part, reinterpret_cast<const char*>(&v) + half * sizeof part, sizeof part);
  return __builtin_convertvector(part, LongV);
}

}  // namespace
}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMD_VECTORS_H_
