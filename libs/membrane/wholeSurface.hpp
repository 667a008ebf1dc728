// A term that holds one scalar q of the whole surface, such as its area or volume, near a target
//     E = modulus/2 (q - rest)^2/rest,     F = -slope dq/dx,     slope = modulus (q/rest - 1)
//     d2E/dx2 = modulus/rest (dq/dx)(dq/dx)^T + slope d2q/dx2
// Open cells: the term is switched off permanently when the first triangle of the membrane breaks.
#pragma once
#include "membrane/network.hpp"
#include "membrane/term.hpp"

namespace corpuscle::membrane {

class WholeSurfaceTerm : public Term {
  public:
    WholeSurfaceTerm(const Network& network, double modulus, double rest)
        : network_(network), modulus_(modulus), rest_(rest) {}
    void addForces(std::span<const Vec3> x, std::span<Vec3> f) const final;
    double energy(std::span<const Vec3> x) const final;
    void addStiffness(std::span<const Vec3> x, Definiteness definiteness, Stiffness& stiffness) const final;
    double maxStiffness(std::span<const Vec3> x) const final;  // modulus/rest |dq/dx|^2

  protected:
    virtual double value(std::span<const Vec3> x) const = 0;                // q
    virtual std::vector<Vec3> gradient(std::span<const Vec3> x) const = 0;  // dq/dx
    // slope d2q/dx2
    virtual void addCurvature(std::span<const Vec3> x, double slope, Definiteness definiteness,
                              Stiffness& stiffness) const = 0;
    const Network& network_;

  private:
    bool letGo() const { return network_.wasOpen(); }
    double slope(std::span<const Vec3> x) const { return modulus_ * (value(x) / rest_ - 1); }
    double modulus_, rest_;
};

}  // namespace corpuscle::membrane
