// The fluid beside the surfaces of rigid bodies: what the viscosity of pairs (sph/operators.hpp) lacks there.
//
// symbol    | meaning                                                                               | unit
// w_i       | u_i - U - Omega x r_i: velocity of fluid particle i in the frame of a body            | m/s
// s_i, n    | distance of i from the body's surface, at least 0.05 dx, and the direction away from it | m
// q         | mean curvature at i of the surface of equal distance, positive for a convex body      | 1/m
// z_ij      | depth of the body's particle j below the surface as i sees it                         | m
// l_ij      | coefficient of the pair in L                                                          | N s/m
//
// Continuation. Beyond the surface the velocity is taken as -w_i z_ij/(s_i g_ij), so that it vanishes on it. i takes
// the surface for the plane or the sphere that has its curvature there: with d = x_j - x_i
//     g_ij = sqrt(1 + 2 q n.d + q^2 d^2),   z_ij = -s_i - (2 n.d + q d^2)/(1 + g_ij), at least 0
// g is the ratio of the distances of j and i from the sphere's centre. The flow about a turning sphere is continued
// exactly. A particle within a thin body lies as deep as it is from that side, however near the other side is. The
// energy is
//     1/2 kappa_i |w_i|^2,   kappa_i = sum_j l_ij z_ij/(s_i g_ij)          over the body's particles
// which makes Morris' factor 1 + z/s of the pairs.
//
// Means and values. Of a velocity that is a parabola across the layer, w = G s + w'' s^2/2, a linear continuation
// misses a force: that on i is too small by the part
//     T_i = sum_j l_ij z_ij (s_i + z_ij)/(2 mu V_i),   with z_ij/g_ij for z_ij where the surface is curved,
// of mu w'' V_i, and the fluid slips by 0.09 dx^2 w''. Taking this part off what drives the particle, pressure
// included, is to conserve the flux of (1 - T_i) w_i in place of that of w_i (divergence and pressure force are
// adjoint), which is an error of the same size and the opposite sign. Half of it makes flux and force in a gap right
// (docs/theory/bodies.md), whatever the direction of the lattice. So a fluid particle's velocity stands for a mean, and
//     v_i = u_i + gamma_i w_i,   1 + gamma_i = 1/(1 - T_i/2)
// takes its place in the energy of viscosity, of the pairs as of the continuation. Near several bodies each has its
// kappa, its T and its share of gamma. All of it is symmetric and positive semi-definite, gives to the bodies what it
// takes from the fluid, and vanishes where everything moves as one piece.
#pragma once
#include <memory>

#include "coupling/scene.hpp"
#include "geometry/triangleTree.hpp"
#include "particles/vectorField.hpp"
#include "sph/operators.hpp"

namespace corpuscle::implicit {

template <class Real>
class SurfaceLayer {
  public:
    using Field = particles::AlignedVector<Real>;  // four numbers an entry of the shared particles
    using Forces = particles::RealArray;           // the same [N]

    SurfaceLayer(coupling::Scene& scene, sph::Operators<Real>& operators);

    // At x*, with operators built and bodies' particles found there. Collective.
    void prepare();

    // forces -= A u of own particles, A what this adds to L; the opposite to `reaction` of the bodies, or to their
    // particles. u: of all entries; motion(b): velocity of body b.
    template <class Motion>
    void addProduct(const Field& u, sph::FieldOf of, Motion&& motion, Forces& forces,
                    std::vector<sph::Wrench>& reaction) {
        const Vec3 slide = of == sph::FieldOf::velocities ? scene_.system->periodicity().slide() : Vec3(0, 0, 0);
        const bool slides = of == sph::FieldOf::velocities && !periods_.empty();
        findExcess(u, slide, motion);
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const std::size_t i = rows_[row];
            const Vec3 own = particles::vectorAt(u, i), excess = excessAt(i);
            Vec3 onVelocity = Vec3::Zero(), onExcess = Vec3::Zero();  // what goes with u_i, and with gamma_i w_i
            for (std::size_t k = firstPair_[row]; k < firstPair_[row + 1]; ++k) {
                const Vec3 change = excess - excessAt(pairs_[k].entry);
                onVelocity -= pairs_[k].coefficient * change;
                onExcess -= pairs_[k].coefficient * (own - particles::vectorAt(u, pairs_[k].entry) + change);
                if (slides) onExcess += pairs_[k].coefficient * periods_[k] * slide;
            }
            for (std::size_t k = firstShare_[row]; k < firstShare_[row + 1]; ++k) {
                const Share& share = shares_[k];
                const Vec3 f =
                    -share.resistance * (own + share.periods * slide + excess - motion(share.body).at(share.arm));
                onVelocity += f, onExcess += f;
                give(reaction[share.body], share.arm, f);
            }
            for (std::size_t k = firstShare_[row]; k < firstShare_[row + 1]; ++k) {
                const Vec3 f = shares_[k].stretch * onExcess;
                onVelocity += f;
                give(reaction[shares_[k].body], shares_[k].arm, f);
            }
            for (std::size_t c = 0; c < 3; ++c) forces[width * i + c] += onVelocity[static_cast<int>(c)];
        }
    }
    double diagonal(std::size_t i) const { return diagonal_[i]; }  // of A [N s/m]
    // f(body, arm, resistance [N s/m]) of all that own particles have to do with bodies.
    template <class F>
    void forEachResistance(F&& f) const {
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            double stretch = 1;
            for (std::size_t k = firstShare_[row]; k < firstShare_[row + 1]; ++k) stretch += shares_[k].stretch;
            for (std::size_t k = firstShare_[row]; k < firstShare_[row + 1]; ++k)
                f(shares_[k].body, shares_[k].arm, stretch * stretch * shares_[k].resistance);
        }
    }

  private:
    static constexpr std::size_t width = 4;
    struct Share {  // of a body, in what a fluid particle beside it feels
        std::size_t body = 0;
        double stretch = 0, resistance = 0;  // gamma; kappa [N s/m]
        Vec3 arm = Vec3::Zero();             // from the body's centre to the image of the particle that is there
        double periods = 0;                  // of that image, across faces whose images slide
    };
    struct Pair {
        std::size_t entry;
        double coefficient;
    };
    struct Records;
    struct Side;
    Side sideOf(std::size_t body, const Vec3& arm) const;
    std::vector<std::vector<Share>> sharesOfAll(const Records& records) const;
    void findStretches(std::vector<std::vector<Share>>& shares);
    void findRows(const Records& records, const std::vector<std::vector<Share>>& shares);

    static void give(sph::Wrench& reaction, const Vec3& arm, const Vec3& onFluid) {
        reaction.force -= onFluid;
        reaction.torque -= arm.cross(onFluid);
    }
    Vec3 excessAt(std::size_t entry) const { return Vec3::Map(excess_.data() + width * entry); }
    template <class Motion>
    void findExcess(const Field& u, const Vec3& slide, Motion&& motion) {
        for (const auto& [entry, share] : stretches_) Vec3::Map(excess_.data() + width * entry).setZero();
        for (const auto& [entry, share] : stretches_)
            Vec3::Map(excess_.data() + width * entry) +=
                share.stretch *
                (particles::vectorAt(u, entry) + share.periods * slide - motion(share.body).at(share.arm));
    }

    coupling::Scene& scene_;
    sph::Operators<Real>& operators_;
    std::vector<std::unique_ptr<geometry::TriangleTree>> surfaces_;  // of the bodies, in their frames
    std::vector<std::pair<std::size_t, Share>> stretches_;           // gamma, of all entries that have one
    particles::RealArray excess_;                                    // gamma w of all entries
    // Rows of A: own particles, fluid and bodies', each with its pairs and the bodies beside it.
    std::vector<std::size_t> rows_, firstPair_, firstShare_;
    std::vector<Pair> pairs_;  // in which one of the two has a gamma
    // Of the image of each pair's entry, across faces whose images slide; empty where none does.
    std::vector<double> periods_;
    std::vector<Share> shares_;
    std::vector<double> diagonal_;
};

extern template class SurfaceLayer<double>;
extern template class SurfaceLayer<float>;

}  // namespace corpuscle::implicit
