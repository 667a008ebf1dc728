// A surface with fluid on one side of it: plane, tube, triangles from a file.
//
// Distances have a sign: above 0 in the fluid, below 0 behind the surface. In a periodic box the surface is periodic
// too: all images of a point are at the same distance.
#pragma once
#include <cstddef>

#include "particles/particleStore.hpp"

namespace corpuscle::boundary {

// Points as the particle store has them: n coordinates along each axis.
struct Points {
    const double* coordinate[3];
    std::size_t count;
    Vec3 operator[](std::size_t i) const { return {coordinate[0][i], coordinate[1][i], coordinate[2][i]}; }
};
inline Points pointsOf(const particles::ParticleStore& store) {
    return {{store.x.data(), store.y.data(), store.z.data()}, store.size()};
}

class Surface {
  public:
    virtual ~Surface() = default;
    virtual double distance(const Vec3& x) const = 0;  // [m]
    // Unit vector into the fluid, at the point of the surface that is nearest to x.
    virtual Vec3 normal(const Vec3& x) const = 0;
    virtual double area() const = 0;  // in one period of the box [m^2]

    // least[i] = min(least[i], distance of point i). It is called for all particles at each step: surfaces with a
    // closed form of the distance override it with a loop of their own.
    virtual void takeLeast(const Points& points, double* least) const;
};

}  // namespace corpuscle::boundary
