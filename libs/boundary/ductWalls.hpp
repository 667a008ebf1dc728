// `duct`: a duct of rectangular cross-section along x, whose axis passes through the middle of the box.
//     distance = min(w/2 - |y|, h/2 - |z|)  in the duct;  behind it minus the distance from the rectangle
// Steady flow under a force f per mass in a duct of width w and height h, both from the middle (series of the product
// of sines; White, Viscous Fluid Flow, section 3-3.3):
//     flow rate = f w^3 h/(12 nu) (1 - 192 w/(pi^5 h) sum_{i odd} tanh(i pi h/(2 w))/i^5),
//     largest velocity = 4 f w^2/(pi^3 nu) sum_{i odd} (-1)^((i-1)/2)/i^3 (1 - 1/cosh(i pi h/(2 w)))
#pragma once
#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

class RectangularDuct : public Surface {
  public:
    RectangularDuct(double width, double height, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override;
    void takeLeast(const Points& points, double* least) const override;

  private:
    double fromAxis(double y, double z) const;
    double halfWidth_, halfHeight_, length_;
    Vec3 middle_;
};

struct DuctWalls : WallShape {
    double width = 0, height = 0;  // along y, along z [m]
    static const Schema<DuctWalls>& schema();

    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override;
    bool isAcross(int axis) const override { return axis != 0; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override { return width * height * fluid.size()[0]; }
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;
};

}  // namespace corpuscle::boundary
