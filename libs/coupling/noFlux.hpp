// Fluid does not cross a closed membrane: what the discrete velocity of a particle near one has too much along the
// normal is left out when it is moved.
//
//     x_i += dt [u_i - chi ((u_i - u_m).n) n],    chi = (1 - (phi/dx)^2)^2  for |phi| < dx
// phi: signed distance from the membrane; n, u_m: normal and membrane's velocity at the nearest point (transport.hpp
// has it with shifting). After the move a particle that is nearer than 0.05 dx to its own side of the membrane, or
// beyond it, goes to that distance; those that were beyond it are counted. In the interior of the fluid nothing is
// done, and an opened cell is left alone.
#pragma once
#include <utility>
#include <vector>

#include "coupling/immersed.hpp"
#include "coupling/surfaceTrees.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class NoFlux {
  public:
    static constexpr double imageMarginInSpacings =
        2;  // that a case must leave between a cell and its image: twice the reach
    static constexpr double leastDistanceInSpacings = 0.05, reachInSpacings = 1;

    NoFlux(Cells& cells, double spacing) : cells_(cells), spacing_(spacing), surfaces_(reachInSpacings * spacing) {}

    // Which particles of this rank are near a membrane now: near the image of it that is nearest to them.
    // candidates(cell): those that may be, of a held cell by its index.
    template <class Candidates>
    void findAmong(const particles::ParticleSystem& system, Candidates&& candidates) {
        forgetOthers();
        for (std::size_t c = 0; c < cells_.heldCount(); ++c)
            if (!cells_[c].membrane.network().isOpen()) find(system, c, candidates(c));
    }
    void find(const particles::ParticleSystem& system, const Immersed& immersed) {
        findAmong(system, [&](std::size_t cell) -> const std::vector<int>& { return immersed.touchedBy(cell); });
    }
    // Those that were found, with the velocity that nodes have now, as the particle sees it.
    template <class F>
    void forNear(F&& f) const {  // f(particle, 1 outside and -1 inside, chi, outer normal, velocity of the membrane)
        for (const Near& near : near_) f(near.particle, near.side, near.chi, near.normal, velocity(near));
    }
    // f(particle, cell, the point of the membrane nearest to it), ordered by cells
    template <class F>
    void forNearest(F&& f) const {
        for (const Near& near : near_) f(near.particle, std::as_const(cells_)[near.cell], near.at);
    }
    // After particles and nodes have moved.
    void keepSides(particles::ParticleSystem& system);

    long crossings() const { return crossings_; }  // of this rank since the start
    double deepest() const { return deepest_; }    // [m]
    void restore(long crossings) { crossings_ = crossings; }

  private:
    struct Near {
        int particle;
        std::size_t cell;
        geometry::SurfacePoint at;
        double side, chi;
        Vec3 normal;
        Vec3 slide;  // by which the particle's image beside the membrane is faster than the particle
    };
    void forgetOthers();  // than the cells that are held, and what was found
    void find(const particles::ParticleSystem& system, std::size_t cell, const std::vector<int>& candidates);
    Vec3 velocity(const Near& near) const;
    Vec3 normal(const Cell& cell, const geometry::SurfacePoint& at, const Vec3& x) const;

    Cells& cells_;
    double spacing_, deepest_ = 0;
    long crossings_ = 0;
    SurfaceTrees surfaces_;
    std::vector<Near> near_;
};

}  // namespace corpuscle::coupling
