// Two parallel planes at the ends of the box, "lower" (number 0) and "upper" (number 1).
#pragma once
#include <string>

#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

// The fluid is where side (x_axis - position) > 0.
class Plane : public Surface {
  public:
    // side: 1 or -1.
    Plane(int axis, double position, double side, double area);
    double distance(const Vec3& x) const override { return side_ * (x[axis_] - position_); }
    Vec3 normal(const Vec3& x) const override;
    double area() const override { return area_; }
    void takeLeast(const Points& points, double* least) const override;

  private:
    int axis_;
    double position_, side_, area_;
};

struct PlaneWalls : WallShape {
    std::string axis = "z";  // axis that the planes are normal to
    static const Schema<PlaneWalls>& schema();

    int normal() const { return axis[0] - 'x'; }
    bool isAcross(int k) const override { return k == normal(); }
    std::optional<int> planesAcross() const override { return normal(); }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override { return fluid.volume(); }
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;
};

}  // namespace corpuscle::boundary
