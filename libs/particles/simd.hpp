// Several numbers at once, double or float. A pair law is written as plain expressions on this type; no law needs an
// intrinsic.
//
// The type carries the instruction set as a tag, so that the baseline, AVX2 and AVX-512 builds of one law are different
// types with different symbols: the linker can never mix them. The type has as many lanes as a block has particles
// (lanes.hpp), in one register or more.
#pragma once
#include <cmath>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "particles/lanes.hpp"

#define CORPUSCLE_INLINE __attribute__((always_inline)) inline
#define CORPUSCLE_LAMBDA __attribute__((always_inline))

namespace corpuscle::particles {

namespace isa {
struct Baseline {
    static constexpr InstructionSet set = InstructionSet::baseline;
    static constexpr int registerBytes = 16;
};
struct Avx2 {
    static constexpr InstructionSet set = InstructionSet::avx2;
    static constexpr int registerBytes = 32;
};
struct Avx512 {
    static constexpr InstructionSet set = InstructionSet::avx512;
    static constexpr int registerBytes = 64;
};
}  // namespace isa

// Operations on one register.
namespace native {
template <class Real, int width>
using Register __attribute__((vector_size(sizeof(Real) * width))) = Real;

template <class R, class Real>
CORPUSCLE_INLINE R broadcast(Real s) {
    constexpr int width = sizeof(R) / sizeof(Real);
    if constexpr (width == 8)
        return R{s, s, s, s, s, s, s, s};
    else if constexpr (width == 4)
        return R{s, s, s, s};
    else
        return R{s, s};
}

#if defined(__SSE2__)
typedef Register<double, 2> D2;
typedef Register<float, 4> F4;
CORPUSCLE_INLINE D2 max(D2 a, D2 b) { return D2(_mm_max_pd(__m128d(a), __m128d(b))); }
CORPUSCLE_INLINE D2 min(D2 a, D2 b) { return D2(_mm_min_pd(__m128d(a), __m128d(b))); }
CORPUSCLE_INLINE D2 sqrt(D2 a) { return D2(_mm_sqrt_pd(__m128d(a))); }
CORPUSCLE_INLINE int below(D2 a, D2 s) { return _mm_movemask_pd(_mm_cmplt_pd(__m128d(a), __m128d(s))); }
CORPUSCLE_INLINE F4 max(F4 a, F4 b) { return F4(_mm_max_ps(__m128(a), __m128(b))); }
CORPUSCLE_INLINE F4 min(F4 a, F4 b) { return F4(_mm_min_ps(__m128(a), __m128(b))); }
CORPUSCLE_INLINE F4 sqrt(F4 a) { return F4(_mm_sqrt_ps(__m128(a))); }
CORPUSCLE_INLINE int below(F4 a, F4 s) { return _mm_movemask_ps(_mm_cmplt_ps(__m128(a), __m128(s))); }
#else
template <class R, class F>
CORPUSCLE_INLINE R each(R a, F&& f) {
    for (unsigned k = 0; k < sizeof(R) / sizeof(a[0]); ++k) a[k] = f(a[k]);
    return a;
}
template <class R>
CORPUSCLE_INLINE R max(R a, R b) {
    return a > b ? a : b;
}
template <class R>
CORPUSCLE_INLINE R min(R a, R b) {
    return a < b ? a : b;
}
template <class R>
CORPUSCLE_INLINE R sqrt(R a) {
    return each(a, [](auto x) { return std::sqrt(x); });
}
template <class R>
CORPUSCLE_INLINE int below(R a, R s) {
    int any = 0;
    for (unsigned k = 0; k < sizeof(R) / sizeof(a[0]); ++k) any |= a[k] < s[k];
    return any;
}
#endif
#if defined(__AVX__)
typedef Register<double, 4> D4;
typedef Register<float, 8> F8;
CORPUSCLE_INLINE D4 max(D4 a, D4 b) { return D4(_mm256_max_pd(__m256d(a), __m256d(b))); }
CORPUSCLE_INLINE D4 min(D4 a, D4 b) { return D4(_mm256_min_pd(__m256d(a), __m256d(b))); }
CORPUSCLE_INLINE D4 sqrt(D4 a) { return D4(_mm256_sqrt_pd(__m256d(a))); }
CORPUSCLE_INLINE int below(D4 a, D4 s) { return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(a), __m256d(s), _CMP_LT_OQ)); }
CORPUSCLE_INLINE F8 max(F8 a, F8 b) { return F8(_mm256_max_ps(__m256(a), __m256(b))); }
CORPUSCLE_INLINE F8 min(F8 a, F8 b) { return F8(_mm256_min_ps(__m256(a), __m256(b))); }
CORPUSCLE_INLINE F8 sqrt(F8 a) { return F8(_mm256_sqrt_ps(__m256(a))); }
CORPUSCLE_INLINE int below(F8 a, F8 s) { return _mm256_movemask_ps(_mm256_cmp_ps(__m256(a), __m256(s), _CMP_LT_OQ)); }
#endif
#if defined(__AVX512F__)
typedef Register<double, 8> D8;
CORPUSCLE_INLINE D8 max(D8 a, D8 b) { return D8(_mm512_max_pd(__m512d(a), __m512d(b))); }
CORPUSCLE_INLINE D8 min(D8 a, D8 b) { return D8(_mm512_min_pd(__m512d(a), __m512d(b))); }
CORPUSCLE_INLINE D8 sqrt(D8 a) { return D8(_mm512_sqrt_pd(__m512d(a))); }
CORPUSCLE_INLINE int below(D8 a, D8 s) { return _mm512_cmp_pd_mask(__m512d(a), __m512d(s), _CMP_LT_OQ); }
#endif

// to[0..3] += sums over the lanes of a, b, c and d.
#if defined(__AVX__)
CORPUSCLE_INLINE __m256d interleavedSums(D4 a, D4 b) {  // partial sums of (a, b, a, b)
    return _mm256_add_pd(_mm256_unpacklo_pd(__m256d(a), __m256d(b)), _mm256_unpackhi_pd(__m256d(a), __m256d(b)));
}
CORPUSCLE_INLINE void addSums(double* to, __m256d ab, __m256d cd) {
    const __m256d sums = _mm256_add_pd(_mm256_permute2f128_pd(ab, cd, 0x21), _mm256_blend_pd(ab, cd, 0xC));
    _mm256_storeu_pd(to, _mm256_add_pd(_mm256_loadu_pd(to), sums));
}
CORPUSCLE_INLINE void addSums(double* to, D4 a, D4 b, D4 c, D4 d) {
    addSums(to, interleavedSums(a, b), interleavedSums(c, d));
}
CORPUSCLE_INLINE __m256 interleavedSums(F8 a, F8 b) {
    return _mm256_add_ps(_mm256_unpacklo_ps(__m256(a), __m256(b)), _mm256_unpackhi_ps(__m256(a), __m256(b)));
}
CORPUSCLE_INLINE void addSums(double* to, F8 a, F8 b, F8 c, F8 d) {
    const __m256d ab = _mm256_castps_pd(interleavedSums(a, b)), cd = _mm256_castps_pd(interleavedSums(c, d));
    const __m256 abcd =
        _mm256_add_ps(_mm256_castpd_ps(_mm256_unpacklo_pd(ab, cd)), _mm256_castpd_ps(_mm256_unpackhi_pd(ab, cd)));
    const __m128 sums = _mm_add_ps(_mm256_castps256_ps128(abcd), _mm256_extractf128_ps(abcd, 1));
    _mm256_storeu_pd(to, _mm256_add_pd(_mm256_loadu_pd(to), _mm256_cvtps_pd(sums)));
}
#endif
#if defined(__AVX512F__)
CORPUSCLE_INLINE __m256d interleavedSums(D8 a, D8 b) {
    const __m512d s =
        _mm512_add_pd(_mm512_unpacklo_pd(__m512d(a), __m512d(b)), _mm512_unpackhi_pd(__m512d(a), __m512d(b)));
    return _mm256_add_pd(_mm512_castpd512_pd256(s), _mm512_extractf64x4_pd(s, 1));
}
CORPUSCLE_INLINE void addSums(double* to, D8 a, D8 b, D8 c, D8 d) {
    addSums(to, interleavedSums(a, b), interleavedSums(c, d));
}
#endif
#if !defined(__AVX__)
template <class R>
CORPUSCLE_INLINE void addSums(double* to, R a, R b, R c, R d) {
    for (unsigned k = 0; k < sizeof(R) / sizeof(a[0]); ++k) to[0] += a[k], to[1] += b[k], to[2] += c[k], to[3] += d[k];
}
#endif
}  // namespace native

template <class Isa, class RealType, int lanes>
struct Simd {
    using Real = RealType;
    static constexpr int width = lanes;
    static constexpr int perRegister = Isa::registerBytes / static_cast<int>(sizeof(Real)) < width
                                           ? Isa::registerBytes / static_cast<int>(sizeof(Real))
                                           : width;
    static constexpr int registers = width / perRegister;
    typedef native::Register<Real, perRegister> Native;
    Native part[registers];

    Simd() = default;
    CORPUSCLE_INLINE Simd(int s) : Simd(static_cast<Real>(s)) {}
    CORPUSCLE_INLINE Simd(double s) {
        for (auto& p : part) p = native::broadcast<Native>(static_cast<Real>(s));
    }
    CORPUSCLE_INLINE Simd(float s) {
        for (auto& p : part) p = native::broadcast<Native>(static_cast<Real>(s));
    }
    CORPUSCLE_INLINE static Simd load(const Real* p) {
        Simd r;
        for (int k = 0; k < registers; ++k) __builtin_memcpy(&r.part[k], p + k * perRegister, sizeof(Native));
        return r;
    }
    CORPUSCLE_INLINE void store(Real* p) const {
        for (int k = 0; k < registers; ++k) __builtin_memcpy(p + k * perRegister, &part[k], sizeof(Native));
    }
    // f applied register by register.
    template <class F>
    static CORPUSCLE_INLINE Simd map(F&& f, const Simd& a) {
        Simd r;
        for (int k = 0; k < registers; ++k) r.part[k] = f(a.part[k]);
        return r;
    }
    template <class F>
    static CORPUSCLE_INLINE Simd map(F&& f, const Simd& a, const Simd& b) {
        Simd r;
        for (int k = 0; k < registers; ++k) r.part[k] = f(a.part[k], b.part[k]);
        return r;
    }
    // Sum of the registers.
    CORPUSCLE_INLINE Native folded() const {
        Native sum = part[0];
        for (int k = 1; k < registers; ++k) sum += part[k];
        return sum;
    }

    friend CORPUSCLE_INLINE Simd operator+(const Simd& a, const Simd& b) {
        return map([](Native x, Native y) CORPUSCLE_LAMBDA { return x + y; }, a, b);
    }
    friend CORPUSCLE_INLINE Simd operator-(const Simd& a, const Simd& b) {
        return map([](Native x, Native y) CORPUSCLE_LAMBDA { return x - y; }, a, b);
    }
    friend CORPUSCLE_INLINE Simd operator*(const Simd& a, const Simd& b) {
        return map([](Native x, Native y) CORPUSCLE_LAMBDA { return x * y; }, a, b);
    }
    friend CORPUSCLE_INLINE Simd operator/(const Simd& a, const Simd& b) {
        return map([](Native x, Native y) CORPUSCLE_LAMBDA { return x / y; }, a, b);
    }
    CORPUSCLE_INLINE Simd& operator+=(const Simd& b) { return *this = *this + b; }
    CORPUSCLE_INLINE Simd& operator-=(const Simd& b) { return *this = *this - b; }
};

template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE Simd<Isa, Real, lanes> max(const Simd<Isa, Real, lanes>& a, const Simd<Isa, Real, lanes>& b) {
    return Simd<Isa, Real, lanes>::map([](auto x, auto y) CORPUSCLE_LAMBDA { return native::max(x, y); }, a, b);
}
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE Simd<Isa, Real, lanes> min(const Simd<Isa, Real, lanes>& a, const Simd<Isa, Real, lanes>& b) {
    return Simd<Isa, Real, lanes>::map([](auto x, auto y) CORPUSCLE_LAMBDA { return native::min(x, y); }, a, b);
}
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE Simd<Isa, Real, lanes> sqrt(const Simd<Isa, Real, lanes>& a) {
    return Simd<Isa, Real, lanes>::map([](auto x) CORPUSCLE_LAMBDA { return native::sqrt(x); }, a);
}
// a where the sign is negative, b elsewhere.
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE Simd<Isa, Real, lanes> whereNegative(const Simd<Isa, Real, lanes>& sign,
                                                      const Simd<Isa, Real, lanes>& a,
                                                      const Simd<Isa, Real, lanes>& b) {
    using V = Simd<Isa, Real, lanes>;
    V r;
    for (int k = 0; k < V::registers; ++k) r.part[k] = sign.part[k] < typename V::Native{} ? a.part[k] : b.part[k];
    return r;
}
// Whether any lane of a is below s.
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE bool anyBelow(const Simd<Isa, Real, lanes>& a, Real s) {
    using V = Simd<Isa, Real, lanes>;
    int any = 0;
    for (const auto& part : a.part) any |= native::below(part, native::broadcast<typename V::Native>(s));
    return any != 0;
}
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE bool anyNegative(const Simd<Isa, Real, lanes>& a) {
    return anyBelow(a, Real(0));
}

// The same for a scalar that is the same for all lanes.
CORPUSCLE_INLINE double max(double a, double b) { return a > b ? a : b; }
CORPUSCLE_INLINE float max(float a, float b) { return a > b ? a : b; }
CORPUSCLE_INLINE bool anyNegative(double a) { return a < 0; }
CORPUSCLE_INLINE bool anyNegative(float a) { return a < 0; }

// to[0..3] += sums over the lanes of a, b, c and d.
template <class Isa, class Real, int lanes>
CORPUSCLE_INLINE void addSums(double* to, const Simd<Isa, Real, lanes>& a, const Simd<Isa, Real, lanes>& b,
                              const Simd<Isa, Real, lanes>& c, const Simd<Isa, Real, lanes>& d) {
    native::addSums(to, a.folded(), b.folded(), c.folded(), d.folded());
}

}  // namespace corpuscle::particles
