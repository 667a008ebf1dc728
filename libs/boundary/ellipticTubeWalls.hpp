// `ellipticTube`: a tube of elliptic cross-section along x, whose axis passes through the middle of the box.
//
// The nearest point of the ellipse with semi-axes a >= b to a point (p, q), p, q >= 0, is (a^2 p/(t + a^2),
// b^2 q/(t + b^2)), where t > -b^2 is the root of the convex, decreasing function
//     (a p/(t + a^2))^2 + (b q/(t + b^2))^2 - 1
// (Eberly, Distance from a Point to an Ellipse, 2013). Newton's method from t = b q - b^2, where the function is at
// least 0, approaches it from one side. Steady flow under a force f per mass:
//     u = f a^2 b^2/(2 nu (a^2 + b^2)) (1 - y^2/a^2 - z^2/b^2),   flow rate pi f a^3 b^3/(4 nu (a^2 + b^2))
#pragma once
#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

class EllipticTube : public Surface {
  public:
    EllipticTube(double width, double height, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override;

  private:
    Vec3 nearest(const Vec3& fromMiddle) const;  // in the plane x = 0
    bool isInside(const Vec3& fromMiddle) const;
    double halfWidth_, halfHeight_, length_;
    Vec3 middle_;
};

struct EllipticTubeWalls : WallShape {
    double width = 0, height = 0;  // along y, along z [m]
    static const Schema<EllipticTubeWalls>& schema();

    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override;
    bool isAcross(int axis) const override { return axis != 0; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override;
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;
};

}  // namespace corpuscle::boundary
