#pragma once

// Eight floats at a time, as plain as they come: AVX where the file is compiled for it, pairs of
// SSE2 registers on any other x86-64, and the compilers' vector extensions elsewhere
// (WebAssembly, ARM). Everything has internal linkage, so that the same source compiled for
// different instruction sets never mixes in one program.

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace nade::detail {
namespace {  // NOLINT(cert-dcl59-cpp): see above

#if defined(__SSE2__)
inline float lowest4(__m128 four) {
  const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
}
#endif

#if defined(__AVX2__) && defined(__FMA__)

struct Float8 {
  __m256 v;
};
inline Float8 load8(const float* p) { return {_mm256_loadu_ps(p)}; }
inline Float8 all8(float x) { return {_mm256_set1_ps(x)}; }
inline void store8(float* p, Float8 a) { _mm256_storeu_ps(p, a.v); }
inline Float8 operator+(Float8 a, Float8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Float8 operator-(Float8 a, Float8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Float8 operator*(Float8 a, Float8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Float8 operator/(Float8 a, Float8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Float8 min8(Float8 a, Float8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Float8 max8(Float8 a, Float8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Float8 sqrt8(Float8 a) { return {_mm256_sqrt_ps(a.v)}; }
/// a * b + c
inline Float8 fma8(Float8 a, Float8 b, Float8 c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
/// a * b - c
inline Float8 fms8(Float8 a, Float8 b, Float8 c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline Float8 less8(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline Float8 less_equal8(Float8 a, Float8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
inline Float8 and8(Float8 a, Float8 b) { return {_mm256_and_ps(a.v, b.v)}; }
inline Float8 or8(Float8 a, Float8 b) { return {_mm256_or_ps(a.v, b.v)}; }
inline Float8 xor8(Float8 a, Float8 b) { return {_mm256_xor_ps(a.v, b.v)}; }
/// mask ? a : b
inline Float8 select8(Float8 mask, Float8 a, Float8 b) {
  return {_mm256_blendv_ps(b.v, a.v, mask.v)};
}
/// Bit i is the sign bit of lane i.
inline unsigned bits8(Float8 mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask.v)); }
inline float lowest8(Float8 a) {
  return lowest4(_mm_min_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1)));
}

#elif defined(__SSE2__)

struct Float8 {
  __m128 lo;
  __m128 hi;
};
inline Float8 load8(const float* p) { return {_mm_loadu_ps(p), _mm_loadu_ps(p + 4)}; }
inline Float8 all8(float x) { return {_mm_set1_ps(x), _mm_set1_ps(x)}; }
inline void store8(float* p, Float8 a) {
  _mm_storeu_ps(p, a.lo);
  _mm_storeu_ps(p + 4, a.hi);
}
inline Float8 operator+(Float8 a, Float8 b) {
  return {_mm_add_ps(a.lo, b.lo), _mm_add_ps(a.hi, b.hi)};
}
inline Float8 operator-(Float8 a, Float8 b) {
  return {_mm_sub_ps(a.lo, b.lo), _mm_sub_ps(a.hi, b.hi)};
}
inline Float8 operator*(Float8 a, Float8 b) {
  return {_mm_mul_ps(a.lo, b.lo), _mm_mul_ps(a.hi, b.hi)};
}
inline Float8 operator/(Float8 a, Float8 b) {
  return {_mm_div_ps(a.lo, b.lo), _mm_div_ps(a.hi, b.hi)};
}
inline Float8 min8(Float8 a, Float8 b) { return {_mm_min_ps(a.lo, b.lo), _mm_min_ps(a.hi, b.hi)}; }
inline Float8 max8(Float8 a, Float8 b) { return {_mm_max_ps(a.lo, b.lo), _mm_max_ps(a.hi, b.hi)}; }
inline Float8 sqrt8(Float8 a) { return {_mm_sqrt_ps(a.lo), _mm_sqrt_ps(a.hi)}; }
inline Float8 fma8(Float8 a, Float8 b, Float8 c) { return a * b + c; }
inline Float8 fms8(Float8 a, Float8 b, Float8 c) { return a * b - c; }
inline Float8 less8(Float8 a, Float8 b) {
  return {_mm_cmplt_ps(a.lo, b.lo), _mm_cmplt_ps(a.hi, b.hi)};
}
inline Float8 less_equal8(Float8 a, Float8 b) {
  return {_mm_cmple_ps(a.lo, b.lo), _mm_cmple_ps(a.hi, b.hi)};
}
inline Float8 and8(Float8 a, Float8 b) { return {_mm_and_ps(a.lo, b.lo), _mm_and_ps(a.hi, b.hi)}; }
inline Float8 or8(Float8 a, Float8 b) { return {_mm_or_ps(a.lo, b.lo), _mm_or_ps(a.hi, b.hi)}; }
inline Float8 xor8(Float8 a, Float8 b) { return {_mm_xor_ps(a.lo, b.lo), _mm_xor_ps(a.hi, b.hi)}; }
inline Float8 select8(Float8 mask, Float8 a, Float8 b) {
  return {_mm_or_ps(_mm_and_ps(mask.lo, a.lo), _mm_andnot_ps(mask.lo, b.lo)),
          _mm_or_ps(_mm_and_ps(mask.hi, a.hi), _mm_andnot_ps(mask.hi, b.hi))};
}
inline unsigned bits8(Float8 mask) {
  return static_cast<unsigned>(_mm_movemask_ps(mask.lo)) |
         static_cast<unsigned>(_mm_movemask_ps(mask.hi)) << 4;
}
inline float lowest8(Float8 a) { return lowest4(_mm_min_ps(a.lo, a.hi)); }

#else

using Lanes4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));
struct Float8 {
  Lanes4 lo;
  Lanes4 hi;
};
inline Lanes4 blend4(Mask4 mask, Lanes4 a, Lanes4 b) {
  return (Lanes4)((mask & (Mask4)a) | (~mask & (Mask4)b));
}
inline Float8 load8(const float* p) {
  Float8 a;
  __builtin_memcpy(&a, p, sizeof a);
  return a;
}
inline Float8 all8(float x) { return {Lanes4{x, x, x, x}, Lanes4{x, x, x, x}}; }
inline void store8(float* p, Float8 a) { __builtin_memcpy(p, &a, sizeof a); }
inline Float8 operator+(Float8 a, Float8 b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline Float8 operator-(Float8 a, Float8 b) { return {a.lo - b.lo, a.hi - b.hi}; }
inline Float8 operator*(Float8 a, Float8 b) { return {a.lo * b.lo, a.hi * b.hi}; }
inline Float8 operator/(Float8 a, Float8 b) { return {a.lo / b.lo, a.hi / b.hi}; }
inline Float8 min8(Float8 a, Float8 b) {
  return {blend4(a.lo < b.lo, a.lo, b.lo), blend4(a.hi < b.hi, a.hi, b.hi)};
}
inline Float8 max8(Float8 a, Float8 b) {
  return {blend4(a.lo > b.lo, a.lo, b.lo), blend4(a.hi > b.hi, a.hi, b.hi)};
}
inline Float8 sqrt8(Float8 a) {
  for (int i = 0; i < 4; ++i) {
    a.lo[i] = __builtin_sqrtf(a.lo[i]);
    a.hi[i] = __builtin_sqrtf(a.hi[i]);
  }
  return a;
}
inline Float8 fma8(Float8 a, Float8 b, Float8 c) { return a * b + c; }
inline Float8 fms8(Float8 a, Float8 b, Float8 c) { return a * b - c; }
inline Float8 less8(Float8 a, Float8 b) { return {(Lanes4)(a.lo < b.lo), (Lanes4)(a.hi < b.hi)}; }
inline Float8 less_equal8(Float8 a, Float8 b) {
  return {(Lanes4)(a.lo <= b.lo), (Lanes4)(a.hi <= b.hi)};
}
inline Float8 and8(Float8 a, Float8 b) {
  return {(Lanes4)((Mask4)a.lo & (Mask4)b.lo), (Lanes4)((Mask4)a.hi & (Mask4)b.hi)};
}
inline Float8 or8(Float8 a, Float8 b) {
  return {(Lanes4)((Mask4)a.lo | (Mask4)b.lo), (Lanes4)((Mask4)a.hi | (Mask4)b.hi)};
}
inline Float8 xor8(Float8 a, Float8 b) {
  return {(Lanes4)((Mask4)a.lo ^ (Mask4)b.lo), (Lanes4)((Mask4)a.hi ^ (Mask4)b.hi)};
}
inline Float8 select8(Float8 mask, Float8 a, Float8 b) {
  return {blend4((Mask4)mask.lo, a.lo, b.lo), blend4((Mask4)mask.hi, a.hi, b.hi)};
}
inline unsigned bits8(Float8 mask) {
  unsigned bits = 0;
  for (int i = 0; i < 4; ++i) {
    bits |= (static_cast<unsigned>(((Mask4)mask.lo)[i]) >> 31) << i;
    bits |= (static_cast<unsigned>(((Mask4)mask.hi)[i]) >> 31) << (i + 4);
  }
  return bits;
}
inline float lowest8(Float8 a) {
  const Lanes4 four = blend4(a.lo < a.hi, a.lo, a.hi);
  const float even = four[0] < four[2] ? four[0] : four[2];
  const float odd = four[1] < four[3] ? four[1] : four[3];
  return even < odd ? even : odd;
}

#endif

inline Float8 abs8(Float8 a) { return max8(a, all8(0.0F) - a); }

struct Vec8 {
  Float8 x, y, z;
};
inline Vec8 operator+(const Vec8& a, const Vec8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec8 operator-(const Vec8& a, const Vec8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float8 dot8(const Vec8& a, const Vec8& b) {
  return fma8(a.x, b.x, fma8(a.y, b.y, a.z * b.z));
}
inline Vec8 cross8(const Vec8& a, const Vec8& b) {
  return {fms8(a.y, b.z, a.z * b.y), fms8(a.z, b.x, a.x * b.z), fms8(a.x, b.y, a.y * b.x)};
}
inline Vec8 load_vec8(const float (&p)[3][8]) { return {load8(p[0]), load8(p[1]), load8(p[2])}; }
inline Vec8 all_vec8(const float (&p)[3]) { return {all8(p[0]), all8(p[1]), all8(p[2])}; }

}  // namespace
}  // namespace nade::detail
