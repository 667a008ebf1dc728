// Checks whether the state after a step is physically possible: cheap tests at every check, exact ones on suspicion.
//
// quantity                                | a state is rejected if
// places, velocities, densities           | one is not finite
// density                                 | it differs from the rest density by more than a fraction of 0.3
// speed                                   | it is above 10 times both the fastest at the previous check and the flow's
//                                         | own, and also half a spacing or more per step, or above the speed of sound
// number of particles                     | it differs from that at the start, or fluid is two spacings beyond a wall
// bonds                                   | one is longer or shorter by a factor exp(0.3) than at the previous check
// volume of a closed membrane             | it differs by a third from that at the start
// triangles of a closed membrane          | two intersect each other (geometry::selfIntersections); tested if
//                                         | neighbours fold by more than 120 degrees, and at longer intervals anyway
// surfaces of cells and bodies            | two touch or cross, including a surface and its own periodic image
//                                         | (geometry/crossings.hpp), or one reaches beyond a wall: nothing but fluid
//                                         | keeps them apart, so no shorter step cures it (isGeometric)
// Volume and intersections of a broken membrane are not checked: its surface is open.
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
    std::string text;  // empty: no fault
    Vec3 place = Vec3::Zero();
    bool isGeometric = false;  // caused by the positions of surfaces: a shorter step does not cure it
    explicit operator bool() const { return !text.empty(); }
};

class StateCheck {
  public:
    StateCheck(const Case& input, const coupling::Scene& scene);

    // The first fault found, the same on all ranks. A state without fault is what the next check compares with.
    // Collective.
    Fault find(const coupling::Scene& scene, const Time& time);
    // Takes this state, unchecked, as the one that the next check compares with: after a rollback.
    void take(const coupling::Scene& scene);
    // Throws Failure(numerics) on all ranks if the state has a non-finite value; the message names `what` was to be
    // written. Collective.
    static void requireFinite(const coupling::Scene& scene, const Time& time, const std::string& what);
    // Position of the fastest particle, or of one whose velocity is not finite: where to look after a step that could
    // not be made. Collective.
    static Vec3 suspect(const coupling::Scene& scene);

  private:
    // fastest2: raised to the largest squared speed of the particles checked before a fault is found [m^2/s^2].
    Fault ofParticles(const coupling::Scene& scene, const Time& time, double& fastest2) const;
    static const membrane::Bond* compareBonds(const membrane::Membrane& membrane, std::vector<double>& lengths);
    Fault ofCell(const coupling::Scene& scene, const coupling::Cell& cell, const Time& time);
    Fault ofSurfaces(const coupling::Scene& scene, const Time& time) const;
    bool isSuspicious(const membrane::Membrane& membrane) const;

    const Case& input_;
    long particles_ = 0;   // of all ranks
    double fastest2_ = 0;  // largest squared speed, of all ranks, at the last check [m^2/s^2]
    struct Watched {
        std::vector<double> lengths;  // of its bonds at the last check, by bond number [m]
        long exact = -1;              // number of the check with the last exact test; -1: none yet
    };
    std::map<int, Watched> watched_;  // the cells that this rank holds, by number
    long lookedAt_ = 0;               // number of checks so far
};

}  // namespace corpuscle::simulation
