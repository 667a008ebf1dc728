// The stress by which the fluid within membranes differs from that of a fluid as viscous as outside, mu.
//
// In an interface between two viscosities lies half a particle layer of either, and the strain rate along its normal n
// jumps there; a gradient over a kernel's reach sees both sides. So the stress is taken apart:
//     P e = n n.e + e.n n - 2 n (n.e.n) n     what shears along the interface: the stress is continuous, e is not
//     (1 - P) e                               what stretches in the plane: e is continuous, the stress is not
//     tau_i = 2 c_i P e_i + 2 f_i (mu_in - mu) (1 - P) e_i                    lambda = mu_in/mu > 1
//     tau_i = 2 c_i P e_i + 2 (mu_in - mu) (1 - P) [e_i - (1 - f_i) e_i']     lambda < 1
// symbol  | meaning
// f_i     | share of the particle's volume that lies within a membrane (Inside)
// p_i     | mean of f over the kernel
// c_i     | 1/(p/mu_in + (1 - p)/mu) - mu - kappa mu ((1 - 1/lambda)/(1 - p + p/lambda))^2 p (1 - p): the laminate's
//         | viscosity; kappa by the exact flow along a plane interface (viscousLayers.hpp)
// n n, n n n n | means over the kernel, along the gradient of p
// e_i     | with c_i, and where lambda < 1, by the gradient over all neighbours; with f_i and in e_i' over those in the
//         | more viscous fluid alone (neighbours weigh max(f, 0.02) or max(1 - f, 0.02), with moments of these), since
//         | the other fluid stretches otherwise already at a small distance from the interface
// A negative coefficient c comes with the bulk viscosity -c, the stress 2 c e - c tr(e) 1: its power, c (2 e:e -
// tr(e)^2), and that of the fluid's own viscosity, mu |grad u|^2, are in the mean over space (mu + c) |grad u|^2.
// Without it the power of a flow that is compressed is negative from c < -mu/2 on, and only the fluid's stiffness over
// long steps keeps it from growing. Of a flow without divergence the stress is the same.
// A gradient over few particles may take more power than the fluid's own viscosity gives; so it never has a negative
// coefficient. Where p = 0 or 1 this is 2 (mu_i - mu) e_i. Symmetric; no force and no torque is left over in the sum,
// and what turns rigidly has none.
#pragma once
#include <cstdint>
#include <map>
#include <span>

#include "particles/sharedParticles.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::sph {

// Of a particle: how much of its volume lies within a membrane, and how viscous the fluid there is [Pa s].
struct Inside {
    double share = 0, viscosity = 0;
};

// By the viscosity of each particle: all or nothing of it lies inside.
std::vector<Inside> insideByCentre(const particles::ParticleStore& store, double outside);

class ExcessStress {
  public:
    explicit ExcessStress(const FluidModel& model) : model_(model) {}

    // inside, volume [m^3]: of owned particles. Collective.
    void build(particles::ParticleSystem& system, const particles::SharedParticles& shared,
               const std::vector<double>& volume, const std::vector<Inside>& inside);

    // tau of what is found by the gradient over all neighbours [Pa].
    Mat3 stress(std::size_t i, const Mat3& gradient) const;
    // force += that of the rest [N], of `width` numbers an entry of `shared`. velocity(record): of an owned particle,
    // or of ghost record - owned.
    template <class Velocity>
    void addForces(const particles::SharedParticles& shared, Velocity&& velocity, std::size_t width,
                   particles::RealArray& force) const;
    bool hasStress(std::size_t i) const { return mean_[i] != 0 || mixed_[i] >= 0; }
    // By which (D u)_i^2 takes power in the mean over u along x, y and z [Pa s].
    double diagonal(std::size_t i) const { return (mean_[i] < 0 ? 3 : 4) * mean_[i]; }

  private:
    using Tensor = Eigen::Matrix<double, 6, 6>;  // on symmetric tensors: xx yy zz, sqrt(2) (xy xz yz)
    struct Neighbour {
        int record;
        Vec3 weight;  // gradient = sum weight (u_j - u_i)^T [1/m]
    };
    struct OneSided {
        std::size_t particle, first;  // in neighbours_, up to the first of the next
        double volume;
        Tensor viscosity;
    };
    struct Records;
    void findMixed(const Records& records, std::span<const int> near, std::size_t i, const Inside& inside);
    static Mat3 stressOf(const Tensor& viscosity, const Mat3& gradient);
    double filmCoefficient(double ratio, double supportOverSpacing);

    FluidModel model_;
    std::vector<double> mean_;
    std::vector<int> mixed_;  // of a particle, in viscosities_; -1: one fluid around it
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
