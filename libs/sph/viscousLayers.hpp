// A plane interface of two fluids on a lattice of particles: how far the discrete viscosity reproduces the exact flow.
//
// The flow is along the interface and varies across it, so that sums over particles are sums over layers of particles,
// dx apart. The forces are pair forces with the viscosity outside, mu, and, in layers of another viscosity, those of a
// stress from the gradient (operators.hpp, excessStress.hpp):
//     sum_k a_k (u_i - u_i+k) + (G^T c G u)_i = f_i,   (G u)_i = 1/2 sum_k k a_k (u_i+k - u_i-k),   sum_k k^2 a_k = 1
// k: distance between two layers, in layers; a_k: sum of F over the particles of a layer at that distance; c: excess
// viscosity of a layer [mu]. Lengths are in spacings, viscosities in units of that outside.
//
// The exact velocity profile consists of two straight lines that meet at the interface. filmCoefficient() is the kappa
// of excessStress.hpp with which the discrete profiles far outside and far inside, extrapolated, meet at the interface,
// on average over ten positions of the interface between two layers. For ratios below 1 kappa is 0: with that of the
// plane interface, a ball and a red cell of ratio 0.2 are further from their limits (docs/theory/sph.md).
#pragma once
#include <Eigen/Core>

#include "sph/kernel.hpp"

namespace corpuscle::sph {

class ViscousLayers {
  public:
    using Vector = Eigen::VectorXd;
    static constexpr int half = 40;                             // layers on either side of z = 0
    static constexpr int count = 2 * half + 1;                  // layer i lies at z = i - half
    static constexpr int places = 10;                           // positions of the interface between two layers
    static double place(int k) { return (k + 1e-6) / places; }  // never exactly on a layer

    ViscousLayers(const Kernel& kernel, double supportOverSpacing);

    // Excess viscosity of the layers if the viscosity is `ratio` inside (z < place) and 1 outside.
    Vector excess(double place, double ratio, double kappa) const;

    // Velocities in equilibrium with a force on each layer; the outermost layers have the velocities in `ends`.
    Vector velocities(const Vector& excess, const Vector& force, const Vector& ends) const;
    // Force per area that holds the outermost layers at z > 0.
    double stress(const Vector& excess, const Vector& velocities) const;

    // Velocities of the exact flow: shear stress 1, u = 0 at the interface.
    static Vector shear(double place, double ratio);
    // Jump at the interface, u outside less u inside, of the extrapolated discrete profiles at this shear stress; 0 if
    // the excess is exact [shear stress/viscosity].
    double film(double place, double ratio, double kappa) const;

    double filmCoefficient(double ratio) const;  // kappa; 0 for ratios below 1

    // Viscosity for shear across a laminate of which the share p is inside [viscosity outside].
    static double laminate(double p, double ratio, double kappa);

    double support() const { return support_; }  // in spacings

  private:
    Eigen::MatrixXd matrix(const Vector& excess) const;

    double support_;
    int reach_, ends_;  // numbers of layers within the support, and of layers that are held at either end
    Vector share_;      // weight of a layer in the kernel's mean, by its distance
    Vector gradient_;   // weights of the surrounding layers in the gradient at a layer
    Eigen::MatrixXd pairs_;
};

}  // namespace corpuscle::sph
