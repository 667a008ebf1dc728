// A round tube along x whose radius R(x) varies, with the period of the box: sinusoidalTube, constriction.
//
// The nearest point (s, R(s)) of the wall to a point (x, r), r its distance from the axis, minimises
//     (s - x)^2 + (R(s) - r)^2
// and lies within |s - x| <= |R(x) - r|. The least of a table of R in this range is refined by Newton's method. Error:
// rounding, as long as R is smooth on the scale of the table, R_min/64 or a 16,384th of the period.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

// R as a function of the distance from the middle of the box along x; it has the period of the box.
class RadiusProfile {
  public:
    virtual ~RadiusProfile() = default;
    struct Value {
        double radius, slope, curvature;  // R [m], R', R'' [1/m]
    };
    virtual Value at(double x) const = 0;
};

class RevolvedTube : public Surface {
  public:
    RevolvedTube(std::shared_ptr<const RadiusProfile> profile, const particles::Box& fluid);
    double distance(const Vec3& x) const override;
    Vec3 normal(const Vec3& x) const override;
    double area() const override { return area_; }

    double volume() const { return volume_; }
    double leastRadius() const { return least_; }
    double largestRadius() const { return largest_; }
    double meanCurvature() const { return turn_; }  // its integral over the surface [m]
    // Integral of R^-4 over a period: the resistance of a slender tube is 8 mu/pi times this.
    double slenderResistance() const { return resistance_; }

  private:
    struct Foot {
        double x, radius, slope;  // of the nearest point, relative to the middle
    };
    Foot foot(double x, double r) const;

    std::shared_ptr<const RadiusProfile> profile_;
    Vec3 middle_;
    double length_, step_ = 0;
    std::vector<double> table_;  // R at the multiples of step_, over one period
    double area_ = 0, volume_ = 0, least_ = 0, largest_ = 0, turn_ = 0, resistance_ = 0;
};

// What the walls of such tubes have in common.
struct RevolvedWalls : WallShape {
    bool isAcross(int axis) const override { return axis != 0; }
    bool isStraight() const override { return false; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override;
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    // By the theory of slender tubes, in which each cross-section has the flow of a straight tube.
    Hydraulics hydraulics(const particles::Box& fluid) const override;

  protected:
    // For a box of this length [m].
    virtual std::shared_ptr<const RadiusProfile> profile(double length) const = 0;

  private:
    RevolvedTube tube(const particles::Box& fluid) const { return {profile(fluid.size()[0]), fluid}; }
};

}  // namespace corpuscle::boundary
