#include "particles/listKernel.hpp"
#include "particles/simd.hpp"

namespace corpuscle::particles::CORPUSCLE_ISA_NAMESPACE {

namespace {

// append: writes first + l to `out` for every lane l set in the mask, without a branch, and returns how many there are.
#if defined(__AVX512F__)
typedef float Lanes __attribute__((vector_size(64)));
CORPUSCLE_INLINE Lanes least(Lanes a, Lanes b) { return Lanes(_mm512_min_ps(__m512(a), __m512(b))); }
CORPUSCLE_INLINE unsigned below(Lanes a, float bound) {
    return _mm512_cmp_ps_mask(__m512(a), _mm512_set1_ps(bound), _CMP_LT_OQ);
}
CORPUSCLE_INLINE int append(unsigned mask, int first, int* out) {
    const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i number = _mm512_add_epi32(lane, _mm512_set1_epi32(first));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask), number));
    return __builtin_popcount(mask);
}
#elif defined(__AVX2__)
// For each mask of eight lanes: the numbers of the lanes that are set, in ascending order.
struct Compression {
    unsigned char lane[256][8];
    constexpr Compression() : lane{} {
        for (int mask = 0; mask < 256; ++mask)
            for (int l = 0, k = 0; l < 8; ++l)
                if (mask >> l & 1) lane[mask][k++] = static_cast<unsigned char>(l);
    }
};
alignas(64) constexpr Compression compression;

typedef float Lanes __attribute__((vector_size(32)));
CORPUSCLE_INLINE Lanes least(Lanes a, Lanes b) { return Lanes(_mm256_min_ps(__m256(a), __m256(b))); }
CORPUSCLE_INLINE unsigned below(Lanes a, float bound) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(__m256(a), _mm256_set1_ps(bound), _CMP_LT_OQ)));
}
CORPUSCLE_INLINE int append(unsigned mask, int first, int* out) {
    const __m256i lane =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(compression.lane[mask])));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_add_epi32(lane, _mm256_set1_epi32(first)));
    return __builtin_popcount(mask);
}
#else
typedef float Lanes __attribute__((vector_size(16)));
CORPUSCLE_INLINE Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
CORPUSCLE_INLINE unsigned below(Lanes a, float bound) {
    unsigned mask = 0;
    for (unsigned l = 0; l < 4; ++l) mask |= static_cast<unsigned>(a[l] < bound) << l;
    return mask;
}
CORPUSCLE_INLINE int append(unsigned mask, int first, int* out) {
    int count = 0;
    for (int l = 0; l < 4; ++l) {
        out[count] = first + l;
        count += static_cast<int>(mask >> l & 1);
    }
    return count;
}
#endif

template <int blocks>
void gather(const float* point, const float* x, const float* y, const float* z, int begin, int end, int offset,
            float near2, float reach2, int* out[]) {
    constexpr int points = ListKernel::points, lanes = points / blocks, width = sizeof(Lanes) / sizeof(float);
    int* to[2 * blocks];
    for (int k = 0; k < 2 * blocks; ++k) to[k] = out[k];
    for (int c = begin; c < end; c += width) {
        Lanes px, py, pz;
        __builtin_memcpy(&px, x + c, sizeof(Lanes));
        __builtin_memcpy(&py, y + c, sizeof(Lanes));
        __builtin_memcpy(&pz, z + c, sizeof(Lanes));
        const unsigned valid = end - c < width ? (1u << (end - c)) - 1 : ~0u;
        for (int h = 0; h < blocks; ++h) {
            Lanes nearest;
            for (int l = h * lanes; l < (h + 1) * lanes; ++l) {
                const Lanes dx = px - point[l], dy = py - point[points + l], dz = pz - point[2 * points + l];
                const Lanes r2 = dx * dx + dy * dy + dz * dz;
                nearest = l == h * lanes ? r2 : least(nearest, r2);
            }
            const unsigned near = below(nearest, near2) & valid, far = below(nearest, reach2) & valid & ~near;
            to[2 * h] += append(near, c + offset, to[2 * h]);
            to[2 * h + 1] += append(far, c + offset, to[2 * h + 1]);
        }
    }
    for (int k = 0; k < 2 * blocks; ++k) out[k] = to[k];
}

}  // namespace

extern const ListKernel kernel;
const ListKernel kernel{&gather<2>, &gather<1>};

}  // namespace corpuscle::particles::CORPUSCLE_ISA_NAMESPACE
