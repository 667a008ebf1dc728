// The one pair loop. Every law between particles goes through it, and every pair of owned particles is worked out once:
//
//     sum_i += p(i, j),   sum_j += (-p0, -p1, -p2, +p3)(i, j)            (Newton's third law)
//
// A law is a struct of constants with
//     static constexpr int fields, radials;   // numbers per record, functions of the distance
//     template <class V> void radial(const V& r2, V (&f)[radials]) const;   // of the squared distance
//     template <class V> void pair(const V (&i)[fields], const typename V::Real* j, const V (&d)[3], const V (&f)[radials], V (&p)[4]) const;
//     template <class V> void finish(const V (&i)[fields], V (&sum)[4]) const;   // common factors, once per particle
// with d = x_i - x_j; p0..p2 are odd under exchange of i and j, p3 is even. Fields 0..2 of a record are the position in units of the
// support radius from the middle of the box (recordPosition): small numbers near one, so that records, pair terms and the sums over
// one block may be float (Real) while state and sums stay double. Records (array of structures: one cache line for eight doubles)
// are packed by the integrator for owned particles and come over the halo for ghosts.
//
// A block of `lanes` particles i meets its list one j at a time: a row. Three stages, so that none waits for another: distances of
// some dozen rows, keeping those where a lane lies within the support; the functions of distance a few rows ahead of their use
// (a square root takes as long as half of the rest); the law. Own terms and lanes beyond the support vanish by arithmetic
// (max(0, 1 - q)): there are no masks.
#pragma once
#include "particles/simd.hpp"

namespace corpuscle::particles {

// What the loop needs of a PairList: plain pointers. Block b acts on j[first[2b]] .. j[first[2b + 1] - 1] and they on it; it alone
// gets the action of j[first[2b + 1]] .. j[first[2b + 2] - 1]: its own particles and ghosts.
struct PairView {
    int owned = 0;  // particles with results
    const int* first = nullptr;
    const int* j = nullptr;  // record numbers, owned before ghosts
};

// Sums stand particle by particle, four doubles each, until they are finished.
inline constexpr int pairSums = 4;

// A law as built for one instruction set, for tables of kernels: PairLoop::run and PairLoop::finish.
template <class Constants, class Real = double>
struct PairKernel {
    void (*run)(const Constants&, const PairView&, const int* blocks, int blockCount, const Real* records,
                double* sums);
    void (*finish)(const Constants&, int owned, const Real* records, const double* sums, double* const* results);
};

template <class Isa, class Law, class Real>
class PairLoop {
  public:
    // Adds the pairs of the named blocks to `sums` (pairSums numbers per owned particle).
    static void run(const Law& law, const PairView& list, const int* blocks, int blockCount, const Real* records,
                    double* sums) {
        Rows rows{};
        for (int k = 0; k < blockCount; ++k) {
            const int slot = blocks[k] * lanes;
            const int* first = list.first + 2 * blocks[k];
            V i[fields], sum[pairSums];
            load(records, slot, list.owned, i);
            for (V& s : sum) s = V(0.0);
            meet<true>(law, i, list.j + first[0], list.j + first[1], records, rows, sum, sums);
            meet<false>(law, i, list.j + first[1], list.j + first[2], records, rows, sum, sums);

            alignas(64) Real own[pairSums][lanes];
            for (int s = 0; s < pairSums; ++s) sum[s].store(own[s]);
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
            Wide i[fields], sum[pairSums];
            load(records, slot, owned, i);
            alignas(64) double own[pairSums][lanes] = {};
            for (int l = 0; l < used; ++l)
                for (int s = 0; s < pairSums; ++s) own[s][l] = sums[static_cast<long>(slot + l) * pairSums + s];
            for (int s = 0; s < pairSums; ++s) sum[s] = Wide::load(own[s]);
            sum[3] = Wide(0.0) - sum[3];
            law.template finish<Wide>(i, sum);
            for (int s = 0; s < pairSums; ++s) {
                sum[s].store(own[s]);
                for (int l = 0; l < used; ++l) results[s][slot + l] = own[s][l];
            }
        }
    }

  private:
    using V = Simd<Isa, Real>;
    using Wide = Simd<Isa, double>;
    static constexpr int lanes = V::width, fields = Law::fields, radials = Law::radials;
    static constexpr int ahead = 4, rowCount = 64;

    struct Rows {
        int j[rowCount + ahead];
        alignas(64) Real d[rowCount + ahead][4][lanes];  // x_i - x_j and the squared distance
        alignas(64) Real f[rowCount + ahead][radials][lanes];
    };

    static CORPUSCLE_INLINE int inBlock(int slot, int owned) { return owned - slot < lanes ? owned - slot : lanes; }

    // Records of a block, field by field; the last block repeats its last particle.
    template <class To>
    static CORPUSCLE_INLINE void load(const Real* records, int slot, int owned, To (&i)[fields]) {
        const int used = inBlock(slot, owned);
        alignas(64) typename To::Real transposed[fields][lanes];
        for (int l = 0; l < lanes; ++l) {
            const Real* record = records + static_cast<long>(slot + (l < used ? l : used - 1)) * fields;
            for (int f = 0; f < fields; ++f) transposed[f][l] = record[f];
        }
        for (int f = 0; f < fields; ++f) i[f] = To::load(transposed[f]);
    }

    static CORPUSCLE_INLINE void radial(const Law& law, Rows& rows, int k) {
        V f[radials];
        law.template radial<V>(V::load(rows.d[k][3]), f);
        for (int n = 0; n < radials; ++n) f[n].store(rows.f[k][n]);
    }

    // mutual: the particles j get the reaction. The even sum is carried with its sign turned, so that all four are odd.
    template <bool mutual>
    static CORPUSCLE_INLINE void meet(const Law& law, const V (&i)[fields], const int* j, const int* end,
                                      const Real* records, Rows& rows, V (&sum)[pairSums], double* sums) {
        while (j != end) {
            const int* stop = end - j > rowCount ? j + rowCount : end;
            int kept = 0;
            for (; j != stop; ++j) {
                const Real* record = records + static_cast<long>(*j) * fields;
                const V dx = i[0] - V(record[0]), dy = i[1] - V(record[1]), dz = i[2] - V(record[2]);
                const V r2 = dx * dx + dy * dy + dz * dz;
                dx.store(rows.d[kept][0]), dy.store(rows.d[kept][1]), dz.store(rows.d[kept][2]),
                    r2.store(rows.d[kept][3]);
                rows.j[kept] = *j;
                kept += anyBelow(r2, Real(1));
            }
            for (int k = 0; k < ahead; ++k) radial(law, rows, k);
            for (int k = 0; k < kept; ++k) {
                radial(law, rows, k + ahead);
                const V d[3] = {V::load(rows.d[k][0]), V::load(rows.d[k][1]), V::load(rows.d[k][2])};
                V f[radials], p[pairSums];
                for (int n = 0; n < radials; ++n) f[n] = V::load(rows.f[k][n]);
                const int other = rows.j[k];
                law.template pair<V>(i, records + static_cast<long>(other) * fields, d, f, p);
                for (int s = 0; s < 3; ++s) sum[s] += p[s];
                sum[3] -= p[3];
                if constexpr (mutual) subtractSums(sums + static_cast<long>(other) * pairSums, p[0], p[1], p[2], p[3]);
            }
        }
    }
};

}  // namespace corpuscle::particles
