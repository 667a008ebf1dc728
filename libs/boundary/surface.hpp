// A surface with fluid on one side of it: plane, tube, the triangles of a file.
//
// Distances have a sign: above 0 in the fluid, below 0 behind the surface. In a periodic box a surface has the period
// of the box: every image of a point is at the same distance.
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
    // Of unit length, into the fluid, at the point of the surface that is nearest to x.
    virtual Vec3 normal(const Vec3& x) const = 0;
    virtual double area() const = 0;  // in one period of the box [m^2]

    // least[i] = min(least[i], distance of point i). Every particle comes by at each step: a surface with a closed form
    // has its own loop.
    virtual void takeLeast(const Points& points, double* least) const;
};

}  // namespace corpuscle::boundary
