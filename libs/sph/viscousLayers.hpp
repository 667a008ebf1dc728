// A plane interface of two fluids on a lattice of particles: what the discrete viscosity makes of the exact flow.
//
// The flow is along the interface and varies across it, so that sums over particles are sums over layers of them, dx
// apart. A pair force with the viscosity outside, mu, and a stress by the gradient in layers of another viscosity
// (operators.hpp, excessStress.hpp):
//     sum_k a_k (u_i - u_i+k) + (G^T c G u)_i = f_i,   (G u)_i = 1/2 sum_k k a_k (u_i+k - u_i-k),   sum_k k^2 a_k = 1
// k: layers to the other one; a_k: sum of F over the particles of a layer at that distance; c: excess viscosity of a
// layer [mu]. Lengths in spacings, viscosities in that outside.
//
// The exact flow has straight lines that meet at the interface. filmCoefficient() is kappa of excessStress.hpp, by
// which the line far outside meets that far inside at the interface itself, in the mean over ten places of the
// interface between two layers. Ratios below 1 have none: a ball and a red cell of 0.2 are further from their limits
// with it (docs/theory/sph.md).
#pragma once
#include <Eigen/Core>

#include "sph/kernel.hpp"

namespace corpuscle::sph {

class ViscousLayers {
  public:
    using Vector = Eigen::VectorXd;
    static constexpr int half = 40;                             // layers on either side of z = 0
    static constexpr int count = 2 * half + 1;                  // layer i lies at z = i - half
    static constexpr int places = 10;                           // of an interface between two layers
    static double place(int k) { return (k + 1e-6) / places; }  // not on a layer

    ViscousLayers(const Kernel& kernel, double supportOverSpacing);

    // Excess viscosity of the layers, ratio inside (z < place) and 1 outside.
    Vector excess(double place, double ratio, double kappa) const;

    // Velocities in equilibrium with a force on each layer, those of the outermost layers being as in `ends`.
    Vector velocities(const Vector& excess, const Vector& force, const Vector& ends) const;
    // Force per area by which the outermost layers are held at z > 0.
    double stress(const Vector& excess, const Vector& velocities) const;

    // The exact flow: shear stress 1, u = 0 at the interface.
    static Vector shear(double place, double ratio);
    // Zero in it where the excess is exact: u outside less u inside at the interface [shear stress/viscosity].
    double film(double place, double ratio, double kappa) const;

    double filmCoefficient(double ratio) const;  // kappa; 0 for ratios below 1

    // Viscosity across layers of which the share p is inside [viscosity outside].
    static double laminate(double p, double ratio, double kappa);

    double support() const { return support_; }  // in spacings

  private:
    Eigen::MatrixXd matrix(const Vector& excess) const;

    double support_;
    int reach_, ends_;  // layers within the support; those that are held at either end
    Vector share_;      // of a layer in the kernel's mean, by its distance
    Vector gradient_;   // weights of the layers around one
    Eigen::MatrixXd pairs_;
};

}  // namespace corpuscle::sph
