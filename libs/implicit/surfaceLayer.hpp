// The fluid beside the surfaces of rigid bodies: the force that the viscosity of pairs (sph/operators.hpp) lacks there.
//
// symbol    | meaning                                                                               | unit
// w_i       | u_i - U - Omega x r_i: velocity of fluid particle i in the frame of a body            | m/s
// s_i, n    | distance of i from the body's surface, at least 0.05 dx, and the direction away from it | m
// q         | mean curvature at i of the surface of equal distance, positive for a convex body      | 1/m
// z_ij      | depth of the body's particle j below the surface, as seen from i                      | m
// l_ij      | coefficient of the pair in L                                                          | N s/m
//
// Continuation. Below the surface the velocity is continued as -w_i z_ij/(s_i g_ij), so that it vanishes on the
// surface. Particle i takes the surface as the plane or the sphere that has its curvature there: with d = x_j - x_i
//     g_ij = sqrt(1 + 2 q n.d + q^2 d^2),   z_ij = -s_i - (2 n.d + q d^2)/(1 + g_ij), at least 0
// g is the ratio of the distances of j and i from the centre of the sphere. The flow about a turning sphere is
// continued exactly. In a thin body the depth of a particle is that below the side that faces i, however near the other
// side is. The energy is
//     1/2 kappa_i |w_i|^2,   kappa_i = sum_j l_ij z_ij/(s_i g_ij)          over the body's particles
// which gives the pairs Morris's factor 1 + z/s.
//
// Means and values. If the velocity is a parabola across the layer, w = G s + w'' s^2/2, a linear continuation misses a
// force: that on i is too small by the fraction
//     T_i = sum_j l_ij z_ij (s_i + z_ij)/(2 mu V_i),   with z_ij/g_ij for z_ij where the surface is curved,
// of mu w'' V_i, and the fluid slips by 0.09 dx^2 w''. To subtract this fraction from all that drives the particle,
// pressure included, would mean to conserve the flux of (1 - T_i) w_i instead of that of w_i (divergence and pressure
// force are adjoint), an error of the same size and the opposite sign. Half of it gives the right flux and force in a
// gap (docs/theory/bodies.md), whatever the direction of the lattice. The velocity of a fluid particle is thus taken as
// a mean, and
//     v_i = u_i + gamma_i w_i,   1 + gamma_i = 1/(1 - T_i/2)
// takes its place in the viscous energy, of the pairs as of the continuation. Near several bodies each has its own
// kappa, T and share of gamma. The whole is symmetric and positive semi-definite, gives to the bodies the momentum that
// it takes from the fluid, and vanishes where everything moves as one rigid body.
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
    using Field = particles::AlignedVector<Real>;  // four numbers per entry of the shared particles
    using Forces = particles::RealArray;           // the same [N]

    SurfaceLayer(coupling::Scene& scene, sph::Operators<Real>& operators);

    // At x*, with operators built and the particles of bodies found there. Collective.
    void prepare();

    // forces -= A u of own particles, where A is what the layer adds to L. The opposite force goes to `reaction` of the
    // bodies, or to their particles. u: velocities of all entries; motion(b): velocity of body b.
    template <class Motion>
    void addProduct(const Field& u, sph::FieldOf of, Motion&& motion, Forces& forces,
                    std::vector<sph::Wrench>& reaction) {
        const Vec3 slide = of == sph::FieldOf::velocities ? scene_.system->periodicity().slide() : Vec3(0, 0, 0);
        const bool slides = of == sph::FieldOf::velocities && !periods_.empty();
        findExcess(u, slide, motion);
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const std::size_t i = rows_[row];
            const Vec3 own = particles::vectorAt(u, i), excess = excessAt(i);
            Vec3 onVelocity = Vec3::Zero(), onExcess = Vec3::Zero();  // forces that do work on u_i, and on gamma_i w_i
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
    // Calls f(body, arm, resistance [N s/m]) for each body beside each own particle.
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
    struct Share {  // of one body, in the force on a fluid particle beside it
        std::size_t body = 0;
        double stretch = 0, resistance = 0;  // gamma; kappa [N s/m]
        Vec3 arm = Vec3::Zero();             // from the body's centre to the image of the particle beside it
        double periods = 0;                  // periods to that image, across faces whose images slide
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
    // Rows of A: own particles, of the fluid and of bodies, each with its pairs and the bodies beside it.
    std::vector<std::size_t> rows_, firstPair_, firstShare_;
    std::vector<Pair> pairs_;  // pairs of which at least one particle has a gamma
    // Periods to the image in each pair, across faces whose images slide; empty where none does.
    std::vector<double> periods_;
    std::vector<Share> shares_;
    std::vector<double> diagonal_;
};

extern template class SurfaceLayer<double>;
extern template class SurfaceLayer<float>;

}  // namespace corpuscle::implicit
