// Several doubles at once. A pair law is written as plain expressions on this type; no law needs an intrinsic.
//
// The type carries the instruction set as a tag, so that the baseline, AVX2 and AVX-512 builds of one law are different types
// with different symbols: the linker can never mix them. Eight lanes with AVX-512, four otherwise: with sixteen registers a
// law's fields and sums for eight lanes do not fit, and the spilled loop takes twice the time per lane.
#pragma once
#include <cmath>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#define CORPUSCLE_INLINE __attribute__((always_inline)) inline
#define CORPUSCLE_LAMBDA __attribute__((always_inline))

namespace corpuscle::particles {

namespace isa {
struct Baseline {
    static constexpr int lanes = 4, registerWidth = 2;
};
struct Avx2 {
    static constexpr int lanes = 4, registerWidth = 4;
};
struct Avx512 {
    static constexpr int lanes = 8, registerWidth = 8;
};
}  // namespace isa

// Operations on one register.
namespace native {
template <int width>
using Register __attribute__((vector_size(8 * width))) = double;

template <class R>
CORPUSCLE_INLINE R broadcast(double s) {
    if constexpr (sizeof(R) == 64)
        return R{s, s, s, s, s, s, s, s};
    else if constexpr (sizeof(R) == 32)
        return R{s, s, s, s};
    else
        return R{s, s};
}
#if defined(__AVX512F__)
typedef Register<8> R8;
CORPUSCLE_INLINE R8 max(R8 a, R8 b) { return R8(_mm512_max_pd(__m512d(a), __m512d(b))); }
CORPUSCLE_INLINE R8 min(R8 a, R8 b) { return R8(_mm512_min_pd(__m512d(a), __m512d(b))); }
CORPUSCLE_INLINE R8 sqrt(R8 a) { return R8(_mm512_sqrt_pd(__m512d(a))); }
CORPUSCLE_INLINE bool anyBelow(R8 a, R8 s) { return _mm512_cmp_pd_mask(__m512d(a), __m512d(s), _CMP_LT_OQ) != 0; }
#elif defined(__AVX__)
typedef Register<4> R4;
CORPUSCLE_INLINE R4 max(R4 a, R4 b) { return R4(_mm256_max_pd(__m256d(a), __m256d(b))); }
CORPUSCLE_INLINE R4 min(R4 a, R4 b) { return R4(_mm256_min_pd(__m256d(a), __m256d(b))); }
CORPUSCLE_INLINE R4 sqrt(R4 a) { return R4(_mm256_sqrt_pd(__m256d(a))); }
CORPUSCLE_INLINE bool anyBelow(R4 a, R4 s) { return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(a), __m256d(s), _CMP_LT_OQ)) != 0; }
#elif defined(__SSE2__)
typedef Register<2> R2;
CORPUSCLE_INLINE R2 max(R2 a, R2 b) { return R2(_mm_max_pd(__m128d(a), __m128d(b))); }
CORPUSCLE_INLINE R2 min(R2 a, R2 b) { return R2(_mm_min_pd(__m128d(a), __m128d(b))); }
CORPUSCLE_INLINE R2 sqrt(R2 a) { return R2(_mm_sqrt_pd(__m128d(a))); }
CORPUSCLE_INLINE bool anyBelow(R2 a, R2 s) { return _mm_movemask_pd(_mm_cmplt_pd(__m128d(a), __m128d(s))) != 0; }
#else
typedef Register<2> R2;
CORPUSCLE_INLINE R2 max(R2 a, R2 b) { return a > b ? a : b; }
CORPUSCLE_INLINE R2 min(R2 a, R2 b) { return a < b ? a : b; }
CORPUSCLE_INLINE R2 sqrt(R2 a) { return R2{std::sqrt(a[0]), std::sqrt(a[1])}; }
CORPUSCLE_INLINE bool anyBelow(R2 a, R2 s) { return a[0] < s[0] || a[1] < s[1]; }
#endif
}  // namespace native

template <class Isa>
struct Simd {
    static constexpr int width = Isa::lanes, perRegister = Isa::registerWidth, registers = width / perRegister;
    typedef native::Register<perRegister> Native;
    Native part[registers];

    Simd() = default;
    CORPUSCLE_INLINE Simd(double s) {
        for (auto& p : part) p = native::broadcast<Native>(s);
    }
    CORPUSCLE_INLINE static Simd load(const double* p) {
        Simd r;
        for (int k = 0; k < registers; ++k) __builtin_memcpy(&r.part[k], p + k * perRegister, sizeof(Native));
        return r;
    }
    CORPUSCLE_INLINE void store(double* p) const {
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

template <class Isa>
CORPUSCLE_INLINE Simd<Isa> max(const Simd<Isa>& a, const Simd<Isa>& b) {
    return Simd<Isa>::map([](auto x, auto y) CORPUSCLE_LAMBDA { return native::max(x, y); }, a, b);
}
template <class Isa>
CORPUSCLE_INLINE Simd<Isa> min(const Simd<Isa>& a, const Simd<Isa>& b) {
    return Simd<Isa>::map([](auto x, auto y) CORPUSCLE_LAMBDA { return native::min(x, y); }, a, b);
}
template <class Isa>
CORPUSCLE_INLINE Simd<Isa> sqrt(const Simd<Isa>& a) {
    return Simd<Isa>::map([](auto x) CORPUSCLE_LAMBDA { return native::sqrt(x); }, a);
}
// a where the sign is negative, b elsewhere.
template <class Isa>
CORPUSCLE_INLINE Simd<Isa> whereNegative(const Simd<Isa>& sign, const Simd<Isa>& a, const Simd<Isa>& b) {
    Simd<Isa> r;
    for (int k = 0; k < Simd<Isa>::registers; ++k) r.part[k] = sign.part[k] < typename Simd<Isa>::Native{} ? a.part[k] : b.part[k];
    return r;
}
// Whether any lane of a is below s.
template <class Isa>
CORPUSCLE_INLINE bool anyBelow(const Simd<Isa>& a, double s) {
    bool any = false;
    for (const auto& part : a.part) any |= native::anyBelow(part, native::broadcast<typename Simd<Isa>::Native>(s));
    return any;
}

}  // namespace corpuscle::particles
