// Rest shape of a cell: a closed surface around the origin with its symmetry axis along z. In metres.
//
// A shape is the zero set of a function F that is negative inside and positive outside, with a gradient that does not
// vanish on the surface. Models are chosen by name in a case (`shape: {type: kuchelFackerell, d: 8 um, ...}`).
#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/triangleMesh.hpp"

namespace corpuscle::geometry {

class Shape {
  public:
    static constexpr const char* familyName = "cell shape";
    virtual ~Shape() = default;

    // To be called once before use. Checks the parameters and reads what the shape needs (paths relative to the case).
    // Throws Failure(invalidCase) that says which value is wrong and which would be valid.
    virtual void prepare(const std::filesystem::path& caseDirectory) const = 0;

    virtual double implicit(const Vec3& x) const = 0;
    virtual Vec3 gradient(const Vec3& x) const = 0;

    // A point of the surface near x, by Newton's method along the gradient, converged to rounding. x has to lie within
    // a fraction of radius() of the surface. Throws Failure(numerics) if the method does not converge.
    virtual Vec3 project(const Vec3& x) const;

    virtual Eigen::AlignedBox3d box() const = 0;
    virtual double radius() const = 0;  // a: half the greatest width across the axis
    virtual double area() const = 0;    // of the exact surface
    virtual double volume() const = 0;

    // A triangulation that the mesher must start from, for shapes that are themselves triangulations; null otherwise.
    virtual const TriangleMesh* triangulation() const { return nullptr; }

    // What prepare() changed in what it read, in whole sentences.
    virtual std::vector<std::string> remarks() const { return {}; }

    // Advice for an implausible size: which setting would give a longest side between `least` and `most` [m], and how
    // long it would be then. Empty if there is no such setting.
    virtual std::string cureForSize(double /*least*/, double /*most*/) const { return {}; }
};

// Surface of revolution that is even in z, given by its upper half profile (rho, z)(t), t = 0 at the pole, pi/2 at the
// rim.
//     A = 4 pi int rho sqrt(rho'^2 + z'^2) dt          V = 4 pi int rho z rho' dt
// by adaptive Gauss-Kronrod quadrature to a relative error of 1e-12.
class AxisymmetricShape : public Shape {
  public:
    struct ProfilePoint {
        double rho, z;    // m
        double drho, dz;  // derivatives with respect to t, m
    };
    virtual ProfilePoint profile(double t) const = 0;
    double area() const override;
    double volume() const override;
};

}  // namespace corpuscle::geometry
