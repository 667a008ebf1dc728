// Excess stress: the stress of the fluid within membranes less that of a fluid with the outer viscosity mu.
//
// At an interface between two fluids half of a particle layer may lie on either side, the strain rate along the normal
// n jumps, and a gradient over the kernel's support includes particles of both sides. The stress is therefore split
// into two parts:
//     P e = n n.e + e.n n - 2 n (n.e.n) n     shear along the interface: the stress is continuous, e is not
//     (1 - P) e                               stretch in the plane: e is continuous, the stress is not
//     tau_i = 2 c_i P e_i + 2 f_i (mu_in - mu) (1 - P) e_i                    lambda = mu_in/mu > 1
//     tau_i = 2 c_i P e_i + 2 (mu_in - mu) (1 - P) [e_i - (1 - f_i) e_i']     lambda < 1
// symbol  | meaning
// f_i     | share of the particle's volume that lies within a membrane (Inside)
// p_i     | mean of f over the kernel
// c_i     | 1/(p/mu_in + (1 - p)/mu) - mu - kappa mu ((1 - 1/lambda)/(1 - p + p/lambda))^2 p (1 - p): excess viscosity
//         | of the laminate; kappa from the exact flow along a plane interface (viscousLayers.hpp)
// n n, n n n n | means over the kernel of products of unit vectors n along the gradient of p
// e_i     | from the gradient over all neighbours in the term with c_i and, if lambda < 1, in that without f_i
// e_i with f_i, e_i' | from the gradient over neighbours in the more viscous fluid alone (neighbours have the weight
//         | max(f, 0.02) or max(1 - f, 0.02), and the moments are those of these weights), since in the other fluid the
//         | stretch is different already at a small distance from the interface
// A negative coefficient c comes with the bulk viscosity -c, so that the stress is 2 c e - c tr(e) 1. Its power,
// c (2 e:e - tr(e)^2), and that of the fluid's own viscosity, mu |grad u|^2, add up to (mu + c) |grad u|^2 on average
// over space. Without the bulk viscosity, the power in a compressed flow is negative for c < -mu/2, and only the
// fluid's stiffness over long steps keeps such a flow from growing. In a flow without divergence the stress does not
// change. With a negative coefficient, the gradient over the few particles of one fluid could feed in more power than
// the fluid's own viscosity dissipates; it therefore never has one. Where p = 0 or 1 the stress is 2 (mu_i - mu) e_i.
// The stress is symmetric; its forces and their torques sum to zero, and it vanishes in a rigid rotation.
#pragma once
#include <cstdint>
#include <map>
#include <span>

#include "particles/sharedParticles.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::sph {

// Share of a particle's volume that lies within a membrane, and viscosity of the fluid there [Pa s].
struct Inside {
    double share = 0, viscosity = 0;
};

// Inside by the particles' own viscosities: share 1 where the viscosity is not `outside`, else 0.
std::vector<Inside> insideByCentre(const particles::ParticleStore& store, double outside);

class ExcessStress {
  public:
    explicit ExcessStress(const FluidModel& model) : model_(model) {}

    // volume [m^3] and inside: of the owned particles. Collective.
    void build(particles::ParticleSystem& system, const particles::SharedParticles& shared,
               const std::vector<double>& volume, const std::vector<Inside>& inside);

    // The part of tau that follows from the gradient over all neighbours [Pa].
    Mat3 stress(std::size_t i, const Mat3& gradient) const;
    // Adds to `force` the forces of the other part, which follows from one-sided gradients [N]; `force` has `width`
    // numbers per entry of `shared`. velocity(record): that of an owned particle, or of the ghost number
    // record - owned.
    template <class Velocity>
    void addForces(const particles::SharedParticles& shared, Velocity&& velocity, std::size_t width,
                   particles::RealArray& force) const;
    bool hasStress(std::size_t i) const { return mean_[i] != 0 || mixed_[i] >= 0; }
    // Coefficient of (D u)_i^2 in the power that the stress dissipates, averaged over u along x, y and z [Pa s].
    double diagonal(std::size_t i) const { return (mean_[i] < 0 ? 3 : 4) * mean_[i]; }

  private:
    using Tensor = Eigen::Matrix<double, 6, 6>;  // acts on symmetric tensors as vectors: xx yy zz, sqrt(2) (xy xz yz)
    struct Neighbour {
        int record;
        Vec3 weight;  // gradient = sum weight (u_j - u_i)^T [1/m]
    };
    struct OneSided {
        std::size_t particle, first;  // the particle's neighbours in neighbours_: from first to that of the next entry
        double volume;
        Tensor viscosity;
    };
    struct Records;
    void findMixed(const Records& records, std::span<const int> near, std::size_t i, const Inside& inside);
    static Mat3 stressOf(const Tensor& viscosity, const Mat3& gradient);
    double filmCoefficient(double ratio, double supportOverSpacing);

    FluidModel model_;
    std::vector<double> mean_;
    std::vector<int> mixed_;  // index of each particle in viscosities_; -1: only one fluid around the particle
    std::vector<Tensor> viscosities_;
    std::vector<OneSided> oneSided_;
    std::vector<Neighbour> neighbours_;
    std::map<double, double> film_;  // kappa by lambda
};

template <class Velocity>
void ExcessStress::addForces(const particles::SharedParticles& shared, Velocity&& velocity, std::size_t width,
                             particles::RealArray& force) const {
    const std::size_t n = shared.owned();
    for (std::size_t k = 0; k < oneSided_.size(); ++k) {
        const OneSided& one = oneSided_[k];
        const std::size_t last = k + 1 < oneSided_.size() ? oneSided_[k + 1].first : neighbours_.size();
        const Vec3 own = velocity(one.particle);
        Mat3 gradient = Mat3::Zero();
        for (std::size_t m = one.first; m < last; ++m)
            gradient +=
                neighbours_[m].weight * (velocity(static_cast<std::size_t>(neighbours_[m].record)) - own).transpose();
        const Mat3 tau = one.volume * stressOf(one.viscosity, gradient);
        Vec3 sum = Vec3::Zero();
        for (std::size_t m = one.first; m < last; ++m) {
            const auto record = static_cast<std::size_t>(neighbours_[m].record);
            const Vec3 f = tau * neighbours_[m].weight;
            Eigen::Map<Vec3>(force.data() +
                             width * (record < n ? record : shared.entry(static_cast<int>(record - n)))) -= f;
            sum += f;
        }
        Eigen::Map<Vec3>(force.data() + width * one.particle) += sum;
    }
}

}  // namespace corpuscle::sph
