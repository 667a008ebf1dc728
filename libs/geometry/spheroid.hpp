// Sphere and spheroid.
//     F = rho^2/a^2 + z^2/c^2 - 1
//
// symbol | meaning                        | unit | default
// radius | radius of the sphere           | m    | required
// a      | equatorial half axis           | m    | required
// c      | polar half axis (oblate: c < a)| m    | required
#pragma once
#include "core/registry.hpp"
#include "geometry/shape.hpp"

namespace corpuscle::geometry {

struct Spheroid : AxisymmetricShape {
    double a = 0, c = 0;  // m

    Spheroid() = default;
    Spheroid(double equatorial, double polar) : a(equatorial), c(polar) {}

    static const Schema<Spheroid>& schema();
    void prepare(const std::filesystem::path& caseDirectory) const override;
    double implicit(const Vec3& x) const override;
    Vec3 gradient(const Vec3& x) const override;
    Eigen::AlignedBox3d box() const override;
    double radius() const override { return a; }
    ProfilePoint profile(double t) const override;
};

struct Sphere : Shape {
    double r = 0;  // m

    Sphere() = default;
    explicit Sphere(double radius) : r(radius) {}

    static const Schema<Sphere>& schema();
    void prepare(const std::filesystem::path& caseDirectory) const override;
    double implicit(const Vec3& x) const override;
    Vec3 gradient(const Vec3& x) const override;
    Vec3 project(const Vec3& x) const override;
    Eigen::AlignedBox3d box() const override;
    double radius() const override { return r; }
    double area() const override;
    double volume() const override;
};

}  // namespace corpuscle::geometry
