// Leakage guard: fluid particles that have crossed a closed membrane are counted, reported and moved back.
//
// The field `side` of a particle says on which side of the membrane it belongs. When lists are built, the fluid
// particles within reach of a membrane become candidates; every few steps each of them is compared with the nearest
// point p of the membrane. A particle on the wrong side is moved to 0.1 dx from p on its own side, and its velocity
// relative to the membrane loses the component towards it. Ruptured cells are left alone. A cell is checked once more
// in the step in which it ruptures, just before, so that fluid found outside later has passed through a hole.
#pragma once
#include <vector>

#include "coupling/surfaceTrees.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

struct GuardMove {
    std::int64_t particle;  // id
    int cell;
    double depth;  // distance from the membrane, on the wrong side [m]
    Vec3 place;    // where the particle was [m]
};

class LeakageGuard {
  public:
    static constexpr double reachInSpacings = 1.0;

    explicit LeakageGuard(double spacing) : spacing_(spacing), surfaces_(reachInSpacings * spacing) {}

    void findCandidates(const particles::ParticleSystem& system, const Cells& cells);
    void movedBack(particles::ParticleSystem& system, const Cells& cells);
    // index: of the held cell.
    void movedBack(particles::ParticleSystem& system, const Cell& cell, std::size_t index);

    // Particles that this rank has moved back since the start of the run, the largest depth [m], and the moves since
    // the last call of takeReport (1,000 at most).
    long moves() const { return moves_; }
    double deepest() const { return deepest_; }
    std::vector<GuardMove> takeReport() { return std::exchange(report_, {}); }
    void restore(long moves) { moves_ = moves; }

  private:
    double spacing_, deepest_ = 0;
    long moves_ = 0;
    SurfaceTrees surfaces_;
    std::vector<std::vector<int>> candidates_;  // particles near each held cell
    std::vector<GuardMove> report_;
};

}  // namespace corpuscle::coupling
