// Whether the state after a step can be that of a flow. Cheap at every step; exact where that raises suspicion.
//
// what                                    | where a state is refused
// places, velocities, densities           | not finite
// density                                 | more than 0.3 from that at rest
// speed                                   | above 10 times both the fastest at the look before and the flow's own,
//                                         | while a step is half a spacing or more, or above the speed of sound
// number of particles                     | another than at the start, or fluid two spacings beyond a wall
// bonds                                   | longer or shorter by a factor exp(0.3) than at the look before
// volume of a closed membrane             | a third from that at the start
// triangles of a closed membrane          | two that cut each other (geometry::selfIntersections), asked where
//                                         | neighbours fold by more than 120 degrees, and from time to time
// surfaces of cells and bodies            | two that touch or cross, a surface and its own periodic image among them
//                                         | (geometry/crossings.hpp), or one beyond a wall: nothing but fluid keeps
//                                             them apart, so no shorter step cures it (isGeometric)
// A membrane that has broken is not asked for its volume and its cuts: its surface is open.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "coupling/scene.hpp"
#include "simulation/case.hpp"

namespace corpuscle::simulation {

struct Fault {
    std::string text;  // empty: none
    Vec3 place = Vec3::Zero();
    bool isGeometric = false;  // of how things lie: a shorter step does not cure it
    explicit operator bool() const { return !text.empty(); }
};

class StateCheck {
  public:
    StateCheck(const Case& input, const coupling::Scene& scene);

    // The first fault that there is, the same on all ranks. What is sound is what the next look compares with.
    // Collective.
    Fault find(const coupling::Scene& scene, const Time& time);
    // Compare with this state next, unseen: after going back.
    void take(const coupling::Scene& scene);
    // Throws Failure(numerics) on all ranks, naming `what` that is to be written, where a number of the state is not
    // finite. Collective.
    static void requireFinite(const coupling::Scene& scene, const Time& time, const std::string& what);
    // The particle that is fastest, or first of those not finite: where to look after a step that could not be made.
    // Collective.
    static Vec3 suspect(const coupling::Scene& scene);

  private:
    // fastest2: raised to the largest square of a speed seen until the fault [m^2/s^2].
    Fault ofParticles(const coupling::Scene& scene, const Time& time, double& fastest2) const;
    static const membrane::Bond* compareBonds(const membrane::Membrane& membrane, std::vector<double>& lengths);
    Fault ofCell(const coupling::Scene& scene, const coupling::Cell& cell, const Time& time);
    Fault ofSurfaces(const coupling::Scene& scene, const Time& time) const;
    bool isSuspicious(const membrane::Membrane& membrane) const;

    const Case& input_;
    long particles_ = 0;   // of all ranks
    double fastest2_ = 0;  // of all ranks, at the last look [m^2/s^2]
    struct Watched {
        std::vector<double> lengths;  // of its bonds at the last look, by their numbers [m]
        long exact = -1;              // look of the last exact test; none
    };
    std::map<int, Watched> watched_;  // the cells that this rank holds, by their numbers
    long lookedAt_ = 0;               // how often
};

}  // namespace corpuscle::simulation
