// The fluid between its particles, for slices and streamlines.
//
// At a point x, field and gradient follow from a linear least-squares fit to the particles around x:
//     minimise over (f, g)   sum_i W(|x - x_i|/h) (f + g.(x_i - x) - f_i)^2,   h = 2.2 dx, W Wendland C2,
// which is exact for linear fields, also at walls. Where the particles do not determine a gradient, Shepard's mean is
// used. A point farther than 1.3 dx from all particles is outside the fluid. Arrays of integers take the value of the
// nearest particle.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/polyData.hpp"
#include "particles/box.hpp"

namespace corpuscle {

// Periodic images of the box, sliding as recorded in the field data of the results.
Periodicity periodicityOf(const io::PolyData& data, const particles::Box& box);

// The box; without one, the extent of the fluid, periodic along no axis.
particles::Box extentOf(const io::PolyData& fluid, const std::optional<particles::Box>& box);

class Interpolation {
  public:
    // NaN outside the fluid; the velocity also where the particles have none.
    struct Values {
        double field = std::numeric_limits<double>::quiet_NaN();
        Vec3 velocity = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    };

    // `field`: u, v, w or speed, from the velocity of the particles, or the name of one of their arrays. Throws
    // Failure(usage) for an unknown field; the message names the existing ones. Values are for points in the cuboid
    // [low, high], a part of `extent`. The fluid must have particles.
    Interpolation(const io::PolyData& fluid, const particles::Box& extent, const std::string& field, const Vec3& low,
                  const Vec3& high);

    Values at(const Vec3& x) const;
    bool hasVelocity() const { return source_.velocities != nullptr; }
    double spacing() const { return spacing_; }  // of the particles [m]

  private:
    // The values shown for a particle or for a periodic image of it, whose velocity is greater by `slide`.
    struct Source {
        std::vector<double> values;                     // empty: the values are velocities
        const std::vector<Vec3>* velocities = nullptr;  // if the particles have velocities
        int component = -1;                             // component of the velocity; -1: its magnitude
        bool nearest = false;
        // Cell of each particle, if values jump at membranes: only those on the side of the nearest particle count.
        const std::vector<std::int64_t>* sides = nullptr;

        bool isBeside(std::size_t i, std::size_t closest) const { return !sides || (*sides)[i] == (*sides)[closest]; }
        Vec3 velocity(std::size_t i, const Vec3& slide) const { return (*velocities)[i] + slide; }
        double value(std::size_t i, const Vec3& slide) const {
            if (!values.empty()) return values[i];
            return component < 0 ? velocity(i, slide).norm() : velocity(i, slide)[component];
        }
    };
    struct Particle {
        Vec3 x;
        std::size_t source;
        Vec3 slide;  // of the image relative to the particle
    };
    static Source sourceOf(const io::PolyData& fluid, const std::string& field);
    Index3 cubeOf(const Vec3& x) const;
    std::vector<Particle>& cube(int i, int j, int k);
    template <class Visit>
    void around(const Vec3& x, Visit&& visit) const;

    Source source_;
    double spacing_, h_;
    Vec3 origin_;  // of the cubes, whose edge is h_
    Index3 count_{};
    std::vector<std::vector<Particle>> cubes_;
};

}  // namespace corpuscle
