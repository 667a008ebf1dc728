// The one pair loop. Every law between particles goes through it, and every pair of owned particles is computed once (a
// few within a block twice):
//
//     sum_j += p(i, j),   sum_i += (-p0, -p1, -p2, +p3)(i, j)            (Newton's third law)
//
// A law is a struct of constants with
//     static constexpr int fields;   // numbers per record
//     template <class V, class J> void pair(const V (&i)[fields], const J* j, const V (&d)[3], const V& q, V (&p)[4])
//         const;
//     template <class V> void finish(const V (&i)[fields], V (&sum)[4]) const;   // common factors, once per particle
// with d = x_j - x_i and q = |d|. p is the contribution of i to the sums of j; p0..p2 are odd under exchange of i and
// j, p3 is even. J is V, or a scalar that is the same for all lanes. A law with more than four sums declares
// `static constexpr int sums` (a multiple of four; the first three odd, the others even). A law whose p3 differs for i
// and j declares `static constexpr bool distinct = true` and returns the contribution to sum 3 of i in p[sums]. The
// contribution of a particle to its own sums is added in `finish`.
//
// Fields 0..2 of a record are the position in units of the support radius from the middle of the box (RecordFrame):
// small numbers near one, so that records, pair terms and the sums over one block may be float (Real) while state and
// sums stay double. Records (array of structures: one cache line for eight doubles) are packed by the integrator for
// owned particles and received through the halo for ghosts.
//
// A block of `lanes` particles i is paired with one particle j of its list at a time: a row. The square root takes as
// long as half of the rest, so that of the next row is computed during the law of this row. Within the block, each
// particle is paired with the one r lanes further on, r = 1 .. lanes/2. The contribution of lanes beyond the support
// vanishes by arithmetic (max(0, 1 - q)): there are no masks.
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::particles {

// What the loop needs of a PairList, as plain pointers. The list of block b is j[begin(b)] .. j[end(b) - 1], without
// the block's own particles. Entries before alone(b) also get the reaction; entries from alone(b) on are images of the
// block's own particles, and for these only the block itself gets a contribution. Ghosts have sums of their own: those
// of images are added to the owned particles (Halo::foldImages), those of particles owned by other ranks are this
// rank's contribution to these particles (sharedParticles.hpp). In each half of the list, particles within the support
// at the time of the build come first, then those within the skin: four parts, where part k is j[first[4b + k]] ..
// j[first[4b + k + 1] - 1].
struct PairView {
    static constexpr int parts = 4;
    int owned = 0;  // particles with results
    const int* first = nullptr;
    const int* j = nullptr;  // record numbers, owned before ghosts; the list is followed by one more valid number

    int begin(int block) const { return first[parts * block]; }
    int alone(int block) const { return first[parts * block + 2]; }
    int end(int block) const { return first[parts * block + parts]; }
};

// Number of sums of a law. Until `finish`, sums are stored particle by particle, ghosts after the owned particles, four
// doubles each unless the law has more.
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
            alignas(64) Real block[fields][2 * lanes];  // stored twice: a load from r on has lane (l + r) % lanes at l
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

    // Adds the contribution of a pair to the sums of i.
    static CORPUSCLE_INLINE void take(const V (&p)[terms], V (&sum)[pairSums]) {
        for (int s = 0; s < 3; ++s) sum[s] -= p[s];
        sum[3] += p[isDistinct<Law>() ? pairSums : 3];
        for (int s = 4; s < pairSums; ++s) sum[s] += p[s];
    }

    // Records of a block, field by field. The last block is filled up with copies of its last particle, placed out of
    // reach of everything.
    template <class To, int room>
    static CORPUSCLE_INLINE void load(const Real* records, int slot, int owned, To (&block)[fields][room]) {
        const int used = inBlock(slot, owned);
        for (int l = 0; l < lanes; ++l) {
            const Real* record = records + static_cast<long>(slot + (l < used ? l : used - 1)) * fields;
            for (int f = 0; f < fields; ++f) block[f][l] = record[f];
            if (l >= used) block[0][l] = To(1e6) * To(l + 1);
        }
    }

    // Every pair within the block: lane l with lane l + r. At the last r each pair is computed twice, once from either
    // particle; at smaller r the other lane gets the reaction, in `other` at l + r.
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

    // Two parts of the list: the first without a test of distances, the second with one, as few of its particles are
    // within the support. mutual: the particles j get the reaction.
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

    // Pairs of the block with the particles j to end - 1; the entry at `end` is read too, for the square root ahead.
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
