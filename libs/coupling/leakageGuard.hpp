// Nothing leaks silently: fluid particles that have crossed a closed membrane are counted, reported and moved back.
//
// A particle belongs to its `side`. When lists are built, the fluid particles within reach of a membrane are noted as
// candidates; every few steps each of them is held against the nearest point p of the membrane. One on the wrong side
// goes back to 0.1 dx on its own side of p, and loses what speed it had towards the membrane relative to it. A ruptured
// cell is left alone; at the step at which it is going to break it is looked at once more, so that what is outside
// later went through a hole.
#pragma once
#include <vector>

#include "coupling/surfaceTrees.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

struct GuardMove {
    std::int64_t particle;  // id
    int cell;
    double depth;  // how far on the wrong side [m]
    Vec3 place;
};

class LeakageGuard {
  public:
    static constexpr double reachInSpacings = 1.0;

    explicit LeakageGuard(double spacing) : spacing_(spacing), surfaces_(reachInSpacings * spacing) {}

    void findCandidates(const particles::ParticleSystem& system, const Cells& cells);
    void movedBack(particles::ParticleSystem& system, const Cells& cells);
    void movedBack(particles::ParticleSystem& system, const Cell& cell,
                   std::size_t index);  // of one held cell, by its index

    // This rank's moves since the start of the run, and the last of them since the last call.
    long moves() const { return moves_; }
    double deepest() const { return deepest_; }
    std::vector<GuardMove> takeReport() { return std::exchange(report_, {}); }
    void restore(long moves) { moves_ = moves; }

  private:
    double spacing_, deepest_ = 0;
    long moves_ = 0;
    SurfaceTrees surfaces_;
    std::vector<std::vector<int>> candidates_;  // particles, of each held cell
    std::vector<GuardMove> report_;
};

}  // namespace corpuscle::coupling
