#include "geometry/spheroid.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace corpuscle::geometry {

CORPUSCLE_REGISTER(Shape, Spheroid, "spheroid", "ellipsoid of revolution about z");
CORPUSCLE_REGISTER(Shape, Sphere, "sphere", "sphere");

const Schema<Spheroid>& Spheroid::schema() {
    static const Schema<Spheroid> s =
        Schema<Spheroid>("spheroid", "ellipsoid of revolution about z")
            .quantity("a", &Spheroid::a, unit::metre, "equatorial half axis", {.range = positive})
            .quantity("c", &Spheroid::c, unit::metre, "polar half axis", {.range = positive});
    return s;
}

const Schema<Sphere>& Sphere::schema() {
    static const Schema<Sphere> s =
        Schema<Sphere>("sphere", "sphere").quantity("radius", &Sphere::r, unit::metre, "radius", {.range = positive});
    return s;
}

void Spheroid::prepare(const std::filesystem::path&) const {
    if (!(a > 0 && c > 0))
        throw Failure(ExitCode::invalidCase, "spheroid: the half axes a and c must be greater than 0");
}

double Spheroid::implicit(const Vec3& x) const {
    return (x.x() * x.x() + x.y() * x.y()) / (a * a) + x.z() * x.z() / (c * c) - 1;
}

Vec3 Spheroid::gradient(const Vec3& x) const { return {2 * x.x() / (a * a), 2 * x.y() / (a * a), 2 * x.z() / (c * c)}; }

Eigen::AlignedBox3d Spheroid::box() const { return {-Vec3(a, a, c), Vec3(a, a, c)}; }

AxisymmetricShape::ProfilePoint Spheroid::profile(double t) const {
    return {a * std::sin(t), c * std::cos(t), a * std::cos(t), -c * std::sin(t)};
}

void Sphere::prepare(const std::filesystem::path&) const {
    if (!(r > 0)) throw Failure(ExitCode::invalidCase, "sphere: the radius must be greater than 0");
}

double Sphere::implicit(const Vec3& x) const { return x.squaredNorm() / (r * r) - 1; }
Vec3 Sphere::gradient(const Vec3& x) const { return 2 / (r * r) * x; }
Vec3 Sphere::project(const Vec3& x) const { return x.squaredNorm() > 0 ? Vec3(r * x.normalized()) : Vec3(0, 0, r); }
Eigen::AlignedBox3d Sphere::box() const { return {Vec3::Constant(-r), Vec3::Constant(r)}; }
double Sphere::area() const { return 4 * std::numbers::pi * r * r; }
double Sphere::volume() const { return 4 * std::numbers::pi / 3 * r * r * r; }

}  // namespace corpuscle::geometry
