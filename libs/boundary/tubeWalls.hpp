// `tube`: a round tube along x, whose axis passes through the middle of the box.
//     distance = R - sqrt(y^2 + z^2)
// Steady flow under a force f per mass (Poiseuille): u = f/(4 nu) (R^2 - r^2), flow rate pi f R^4/(8 nu). Its slowest
// mode decays by exp(-j^2 nu t/R^2), j = 2.405 the first zero of the Bessel function J0.
#pragma once
#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

class RoundTube : public Surface {
  public:
    RoundTube(double radius, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override;
    void takeLeast(const Points& points, double* least) const override;

  private:
    double radius_, length_;
    Vec3 middle_;
};

struct TubeWalls : WallShape {
    double diameter = 0;  // 2 R [m]
    static const Schema<TubeWalls>& schema();

    double radius() const { return 0.5 * diameter; }
    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override;
    bool isAcross(int axis) const override { return axis != 0; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override;
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;
};

}  // namespace corpuscle::boundary
