// A round tube along x whose axis passes through the middle of the box:
//     distance = R - sqrt(y^2 + z^2)
#pragma once
#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

class ModelNameSurface : public Surface {
  public:
    ModelNameSurface(double radius, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override;

  private:
    Vec3 fromAxis(const Vec3& x) const;
    double radius_, length_;
    Vec3 middle_;
};

struct ModelNameWalls : WallShape {
    double radius = 0;  // R [m]
    static const Schema<ModelNameWalls>& schema();

    bool isAcross(int axis) const override { return axis != 0; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override;
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;
};

}  // namespace corpuscle::boundary
