// `network`: a network of straight round tubes, with branches: bifurcations, loops, networks.
//
// The fluid is the union of the tubes, each of them all points within R of its axis, the segment from a to b; ends are
// hemispheres, which lie within other tubes where tubes join. With d_i the distance from axis i, and g_i = R_i - d_i:
//
//     behind the walls   distance = max_i g_i
//     in the fluid       distance to the nearest of
//                            the foot on each tube,   c_i + R_i n_i   with c_i the nearest point of the axis and n_i
//                                                     the direction from there to the point, and
//                            the curves where two tubes meet, and the points where three meet,
//                            by Newton's method,
//                        of those that do not lie within another tube, deeper than 1e-3 of the least radius: walls that
//                        meet at less than 2.5 degrees count as smooth
//
// The steady creeping flow is estimated by Poiseuille's law for each tube and the balance of flow rates at the joints,
// at a force f per mass along x: with p the pressure over the density, l the length of a tube and e its direction
//
//     Q = pi R^4/(8 nu l) (p_a - p_b + f l e_x)
#pragma once
#include <optional>
#include <vector>

#include "boundary/wallShape.hpp"

namespace corpuscle::boundary {

struct Tube {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // ends of the axis, from the middle of the box [m]
    double diameter = 0;                          // [m]
    double radius() const { return 0.5 * diameter; }
    double length() const { return (to - from).norm(); }
    static const Schema<Tube>& schema();
};

class TubeNetwork : public Surface {
  public:
    TubeNetwork(const std::vector<Tube>& tubes, const particles::Box& fluid);
    double distance(const Vec3& x) const override { return nearest(x).distance; }
    Vec3 normal(const Vec3& x) const override { return nearest(x).normal; }
    double area() const override { return area_; }
    // Of all points within this distance of the fluid [m^3]. By cubes halved down to a 16th of the least radius where
    // the walls pass; error: of second order in their size.
    double volumeWithin(double distance) const;

  private:
    struct Axis {
        Vec3 from, along;  // along: to - from [m]
        double radius, square;
    };
    struct Found {
        double distance;
        Vec3 normal;
    };
    struct Foot {
        Vec3 centre;  // nearest point of the axis
        double gap;   // g_i [m]
    };
    Foot foot(const Axis& axis, const Vec3& x) const;
    double largestGap(const Vec3& x, std::size_t* which = nullptr) const;
    Found nearest(const Vec3& x) const;
    // A curve where the walls of two tubes meet: points of it on the wall of the whole, about `spacing` apart.
    struct Ridge {
        std::size_t one, other;
        double spacing;
        std::vector<Vec3> points;
    };
    struct OnCurve {
        Vec3 place, tangent;
    };
    void findRidges();
    // From a place near it onto the curve where the walls of two tubes meet; the point of the curve that is nearest to
    // x; the point where three walls meet. Empty if Newton's method does not find it.
    std::optional<OnCurve> ontoCurve(std::size_t i, std::size_t j, Vec3 start) const;
    std::optional<Vec3> meeting(std::size_t i, std::size_t j, const Vec3& x, const Vec3& start) const;
    std::optional<Vec3> corner(std::size_t i, std::size_t j, std::size_t k, const Vec3& start) const;
    bool isOnWall(const Vec3& x) const;
    double volumeOf(const Vec3& low, double size, double distance) const;

    particles::Box box_;
    std::vector<Axis> axes_;  // with the images along x that reach into the box
    std::vector<Ridge> ridges_;
    std::vector<Vec3> corners_;  // where three walls meet
    double least_ = 0, largest_ = 0, area_ = 0;
};

// The flow in each tube, in units of f/nu [m^4], from `from` to `to`; all are 0 where no tube leads along the box.
std::vector<double> networkFlows(const std::vector<Tube>& tubes, double boxLength);

struct NetworkWalls : WallShape {
    std::vector<Tube> tubes;
    static const Schema<NetworkWalls>& schema();

    void check(const particles::Box& fluid, const Mark& mark, Problems& problems) const override;
    bool isAcross(int axis) const override { return axis != 0; }
    bool isStraight() const override { return false; }
    Walls place(const particles::Box& fluid) const override;
    double volume(const particles::Box& fluid) const override;
    double volumeBehind(const particles::Box& fluid, const Vec3& depth) const override;
    Hydraulics hydraulics(const particles::Box& fluid) const override;

  private:
    // Whether it found nothing.
    bool checkJoints(double boxLength, const Mark& mark, Problems& problems) const;
    const TubeNetwork& network(const particles::Box& fluid) const;
    mutable std::shared_ptr<const TubeNetwork> network_;  // in the box last asked for
    mutable particles::Box box_;
};

}  // namespace corpuscle::boundary
