// The one pair loop. Every law between particles goes through it.
//
//     for every block of particles i:   sum_i += law(i, j)  for every j in the block's list
//
// A law is a struct of constants with
//     static constexpr int fields, sums;          // doubles per record, results per particle
//     template <class V> void pair(const V (&i)[fields], const double* j, V (&sum)[sums]) const;
//     template <class V> void finish(V (&sum)[sums]) const;      // common factors, once per particle
// fields 0..2 of a record are the position. Records (array of structures: one cache line for eight fields) are packed by the
// integrator for owned particles and come over the halo for ghosts. The list holds every j within the support plus skin of
// any of the eight, the particle itself too: a law's own term and pairs beyond the support must vanish by arithmetic
// (max(0, 1 - q)), so there are no masks.
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::particles {

// What the loop needs of a PairList: plain pointers.
struct PairView {
    int owned = 0;               // particles with results
    const int* first = nullptr;  // list of block b: j[first[b]] .. j[first[b + 1] - 1]
    const int* j = nullptr;      // record numbers, owned before ghosts
};

template <class Isa, class Law>
inline void pairLoop(const Law& law, const PairView& list, const int* blocks, int blockCount, const double* records,
                     double* const* results) {
    using V = Simd<Isa>;
    constexpr int lanes = V::width, fields = Law::fields, sums = Law::sums;
    for (int k = 0; k < blockCount; ++k) {
        const int block = blocks[k], slot = block * lanes;
        const int used = list.owned - slot < lanes ? list.owned - slot : lanes;
        alignas(64) double transposed[fields][lanes];
        for (int l = 0; l < lanes; ++l) {
            const double* record = records + static_cast<long>(slot + (l < used ? l : used - 1)) * fields;
            for (int f = 0; f < fields; ++f) transposed[f][l] = record[f];
        }
        V i[fields], sum[sums];
        for (int f = 0; f < fields; ++f) i[f] = V::load(transposed[f]);
        for (int s = 0; s < sums; ++s) sum[s] = V(0.0);

        const int* end = list.j + list.first[block + 1];
        for (const int* j = list.j + list.first[block]; j != end; ++j)
            law.template pair<V>(i, records + static_cast<long>(*j) * fields, sum);
        law.template finish<V>(sum);

        if (used == lanes)
            for (int s = 0; s < sums; ++s) sum[s].store(results[s] + slot);
        else
            for (int s = 0; s < sums; ++s) {
                alignas(64) double last[lanes];
                sum[s].store(last);
                for (int l = 0; l < used; ++l) results[s][slot + l] = last[l];
            }
    }
}

}  // namespace corpuscle::particles
