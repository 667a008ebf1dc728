// The one pair loop. Every law between particles goes through it, and every pair of owned particles is computed once:
//
//     sum_j += p(i, j),   sum_i += (-p0, -p1, -p2, +p3)(i, j)            (Newton's third law)
//
// A law is a struct of constants with
//     static constexpr int fields;   // numbers per record
//     template <class V, class J> void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4])
//         const;
//     template <class V> void finish(const V (&i)[fields], V (&sum)[4]) const;   // common factors, once per particle
// with d = x_j - x_i and q = |d|; p is what i does to j; p0..p2 are odd under exchange of i and j, p3 is even. J is V
// or a number, the same for all lanes. A law of more sums says `static constexpr int sums` (a multiple of four; the
// first three odd, the others even). One whose p3 differs for i and j says `static constexpr bool distinct = true` and
// gives what i gets in p[sums].
// What a particle does to itself is left to finish. Fields 0..2 of a record are the position in
// units of the support radius from the middle of the box (RecordFrame): small numbers near one, so that records, pair
// terms and the sums over one block may be float (Real) while state and sums stay double. Records (array of structures:
// one cache line for eight doubles) are packed by the integrator for owned particles and come over the halo for ghosts.
//
// A block of `lanes` particles i meets its list one j at a time: a row. The square root takes as long as half of the
// rest: that of the next row is computed while this row's law is. Within the block every particle meets those r lanes
// on, r = 1 .. lanes/2. Lanes beyond the support vanish by arithmetic (max(0, 1 - q)): there are no masks.
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::particles {

// What the loop needs of a PairList: plain pointers. The list of block b is j[begin(b)] .. j[end(b) - 1]. Until
// alone(b) the particles j get the reaction; from there on the block alone gets the action: images of its own
// particles. Ghosts gather what acts on them in sums of their own: those of images belong to the owned particles, those
// of other ranks' particles are what this rank does to them (sharedParticles.hpp). A block's own particles are not
// listed. Either half has particles within the support at the time of the build first, then those of the skin: four
// parts, where part k is j[first[4b + k]] .. j[first[4b + k + 1] - 1].
struct PairView {
    static constexpr int parts = 4;
    int owned = 0;  // particles with results
    const int* first = nullptr;
    const int* j = nullptr;  // record numbers, owned before ghosts; one valid number behind the last

    int begin(int block) const { return first[parts * block]; }
    int alone(int block) const { return first[parts * block + 2]; }
    int end(int block) const { return first[parts * block + parts]; }
};

// Sums stand particle by particle, ghosts behind the owned, four doubles each unless the law has more, until they are
// finished.
template <class Law>
constexpr int sumsOf() {
    if constexpr (requires { Law::sums; })
        return Law::sums;
    else
        return 4;
}
template <class Law>
constexpr bool isDistinct() {
    if constexpr (requires { Law::distinct; })
        return Law::distinct;
    else
        return false;
}

// A law as built for one instruction set, for tables of kernels: PairLoop::run and PairLoop::finish.
template <class Constants, class Real = double>
struct PairKernel {
    void (*run)(const Constants&, const PairView&, const int* blocks, int blockCount, const Real* records,
                double* sums);
    void (*finish)(const Constants&, int owned, const Real* records, const double* sums, double* const* results);
};

template <class Isa, class Law, class Real, int lanes>
class PairLoop {
  public:
    // Adds the pairs of the named blocks to `sums`.
    static void run(const Law& law, const PairView& list, const int* blocks, int blockCount, const Real* records,
                    double* sums) {
        for (int k = 0; k < blockCount; ++k) {
            const int slot = blocks[k] * lanes;
            const int* first = list.first + PairView::parts * blocks[k];
            alignas(64) Real block[fields][2 * lanes];  // twice: lane l + r is found r numbers on
            load(records, slot, list.owned, block);
            V i[fields], sum[pairSums];
            for (int f = 0; f < fields; ++f) i[f] = V::load(block[f]), i[f].store(block[f] + lanes);
            alignas(64) Real own[pairSums][2 * lanes] = {};
            within(law, i, block, sum, own);
            meet<true>(law, i, list.j, first, records, sum, sums);
            meet<false>(law, i, list.j, first + 2, records, sum, sums);

            for (int s = 0; s < pairSums; ++s) (sum[s] + V::load(own[s]) + V::load(own[s] + lanes)).store(own[s]);
            const int used = inBlock(slot, list.owned);
            for (int l = 0; l < used; ++l)
                for (int s = 0; s < pairSums; ++s)
                    sums[static_cast<long>(slot + l) * pairSums + s] += static_cast<double>(own[s][l]);
        }
    }

    // The results of all owned particles from their sums.
    static void finish(const Law& law, int owned, const Real* records, const double* sums, double* const* results) {
        for (int slot = 0; slot < owned; slot += lanes) {
            const int used = inBlock(slot, owned);
            alignas(64) double block[fields][lanes];
            load(records, slot, owned, block);
            Wide i[fields], sum[pairSums];
            for (int f = 0; f < fields; ++f) i[f] = Wide::load(block[f]);
            alignas(64) double own[pairSums][lanes] = {};
            for (int l = 0; l < used; ++l)
                for (int s = 0; s < pairSums; ++s) own[s][l] = sums[static_cast<long>(slot + l) * pairSums + s];
            for (int s = 0; s < pairSums; ++s) sum[s] = Wide::load(own[s]);
            law.template finish<Wide>(i, sum);
            for (int s = 0; s < pairSums; ++s) {
                sum[s].store(own[s]);
                for (int l = 0; l < used; ++l) results[s][slot + l] = own[s][l];
            }
        }
    }

  private:
    using V = Simd<Isa, Real, lanes>;
    using Wide = Simd<Isa, double, lanes>;
    static constexpr int fields = Law::fields, pairSums = sumsOf<Law>(), terms = pairSums + (isDistinct<Law>() ? 1 : 0);
    static constexpr int arrivals = 63;
    static_assert(pairSums % 4 == 0);

    static CORPUSCLE_INLINE int inBlock(int slot, int owned) { return owned - slot < lanes ? owned - slot : lanes; }

    // What i gets of a pair.
    static CORPUSCLE_INLINE void take(const V (&p)[terms], V (&sum)[pairSums]) {
        for (int s = 0; s < 3; ++s) sum[s] -= p[s];
        sum[3] += p[isDistinct<Law>() ? pairSums : 3];
        for (int s = 4; s < pairSums; ++s) sum[s] += p[s];
    }

    // Records of a block, field by field. The last block is filled up with copies of its last particle, out of reach of
    // everything.
    template <class To, int room>
    static CORPUSCLE_INLINE void load(const Real* records, int slot, int owned, To (&block)[fields][room]) {
        const int used = inBlock(slot, owned);
        for (int l = 0; l < lanes; ++l) {
            const Real* record = records + static_cast<long>(slot + (l < used ? l : used - 1)) * fields;
            for (int f = 0; f < fields; ++f) block[f][l] = record[f];
            if (l >= used) block[0][l] = To(1e6) * To(l + 1);
        }
    }

    // Every pair within the block: lane l with lane l + r. The last r meets each pair from both ends; before it the
    // other lane gets the reaction, in `other` at l + r.
    static CORPUSCLE_INLINE void within(const Law& law, const V (&i)[fields], const Real (&block)[fields][2 * lanes],
                                        V (&sum)[pairSums], Real (&other)[pairSums][2 * lanes]) {
        for (V& s : sum) s = V(0.0);
        for (int r = 1; r <= lanes / 2; ++r) {
            V j[fields], d[3], p[terms];
            for (int f = 0; f < fields; ++f) j[f] = V::load(block[f] + r);
            for (int k = 0; k < 3; ++k) d[k] = j[k] - i[k];
            law.pair(i, j, d, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), p);
            take(p, sum);
            if (r == lanes / 2) return;
            for (int s = 0; s < pairSums; ++s) (V::load(other[s] + r) + p[s]).store(other[s] + r);
        }
    }

    // The first of two parts of the list as it is, the second after a look at the distance: few of them are within the
    // support. mutual: the particles j get the reaction.
    template <bool mutual>
    static CORPUSCLE_INLINE void meet(const Law& law, const V (&i)[fields], const int* list, const int* part,
                                      const Real* records, V (&sum)[pairSums], double* sums) {
        const int *j = list + part[0], *end = list + part[1], *far = end, *const last = list + part[2];
        int arrived[arrivals + 1];
        for (;;) {
            rows<mutual>(law, i, j, end, records, sum, sums);
            if (far == last) return;
            int count = 0;
            for (; far != last && count < arrivals; ++far) {
                const Real* record = records + static_cast<long>(*far) * fields;
                const V x = V(record[0]) - i[0], y = V(record[1]) - i[1], z = V(record[2]) - i[2];
                arrived[count] = *far;
                count += anyBelow(x * x + y * y + z * z, Real(1));
            }
            arrived[count] = 0;
            j = arrived, end = arrived + count;
        }
    }

    // One entry behind the last is read.
    template <bool mutual>
    static CORPUSCLE_INLINE void rows(const Law& law, const V (&i)[fields], const int* j, const int* end,
                                      const Real* records, V (&sum)[pairSums], double* sums) {
        if (j == end) return;
        const auto toward = [&](const Real* record, V(&d)[3]) CORPUSCLE_LAMBDA {
            for (int k = 0; k < 3; ++k) d[k] = V(record[k]) - i[k];
            return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        };
        const Real* record = records + static_cast<long>(*j) * fields;
        V d[3], q = toward(record, d);
        for (; j != end; ++j) {
            const Real* next = records + static_cast<long>(j[1]) * fields;
            V nextD[3];
            const V nextQ = toward(next, nextD);
            V p[terms];
            law.pair(i, record, d, q, p);
            take(p, sum);
            if constexpr (mutual)
                for (int s = 0; s < pairSums; s += 4)
                    addSums(sums + static_cast<long>(*j) * pairSums + s, p[s], p[s + 1], p[s + 2], p[s + 3]);
            record = next, q = nextQ;
            for (int k = 0; k < 3; ++k) d[k] = nextD[k];
        }
    }
};

}  // namespace corpuscle::particles
