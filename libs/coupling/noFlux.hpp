// Fluid does not cross a membrane: when a particle near one is moved, the normal component of its velocity
// relative to the membrane, an error of the discrete velocity, is removed in part (chi).
//
//     x_i += dt [u_i - chi ((u_i - u_m).n) n],    chi = (1 - (phi/dx)^2)^2  for |phi| < dx
// phi: signed distance from the membrane; n, u_m: normal and velocity of the membrane at the nearest point
// (transport.hpp has the equation with shifting). After the move, a particle that is beyond the membrane, or on its own
// side but nearer than 0.05 dx, is placed at that distance on its own side; those that were beyond it are counted. In a
// gap between two parts of the membrane that is narrower than 0.1 dx, it is placed in the middle. (If the other part
// were ignored, the particle would be thrown from one part to the other in each step, by lengths that do not decrease
// with the step.) Particles further than dx from a membrane are left alone.
//
// Of a torn cell (membrane::Network::isTorn), only whole triangles act. A particle whose nearest point of these lies on
// their border is within a hole, and left alone. Through holes, particles change sides: their own side is not that
// where they started, but that where they are at the beginning of the step. Cells that have a border from the start are
// left alone.
#pragma once
#include <utility>
#include <vector>

#include "coupling/immersed.hpp"
#include "coupling/surfaceTrees.hpp"
#include "geometry/periodicSurface.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class NoFlux {
  public:
    // Least distance between a cell and its image that a case must leave: twice the reach.
    static constexpr double imageMarginInSpacings = 2;
    static constexpr double leastDistanceInSpacings = 0.05, reachInSpacings = 1;

    NoFlux(Cells& cells, double spacing) : cells_(cells), spacing_(spacing), surfaces_(reachInSpacings * spacing) {}

    // Finds the particles of this rank that are near a membrane now, or more exactly near its nearest image.
    // candidates(cell): particles that may be near a held cell, given by its index. moved: time for which particles and
    // nodes have moved with their present velocities since the beginning of the step [s].
    template <class Candidates>
    void findAmong(const particles::ParticleSystem& system, double moved, Candidates&& candidates) {
        forgetOthers();
        for (std::size_t c = 0; c < cells_.heldCount(); ++c)
            if (actsBeside(cells_[c])) find(system, c, moved, candidates(c));
    }
    void find(const particles::ParticleSystem& system, const Immersed& immersed, double moved) {
        findAmong(system, moved, [&](std::size_t cell) -> const std::vector<int>& { return immersed.touchedBy(cell); });
    }
    // f(particle, side, chi, normal, velocity) for the particles found. side: 1 outside, -1 inside; normal: outward;
    // velocity: of the membrane relative to the slide of the particle's image, by the present velocities of the nodes.
    template <class F>
    void forNear(F&& f) const {
        for (const Near& near : near_) f(near.particle, near.side, near.chi, near.normal, velocity(near));
    }
    // f(particle, index of the cell, nearest point of its membrane) for the particles found, ordered by cells.
    template <class F>
    void forNearest(F&& f) const {
        for (const Near& near : near_) f(near.particle, near.cell, near.at);
    }
    // Places particles on their own side, after particles and nodes have moved.
    void keepSides(particles::ParticleSystem& system);

    long crossings() const { return crossings_; }  // counted by this rank since the start
    double deepest() const { return deepest_; }    // [m]
    void restore(long crossings) { crossings_ = crossings; }

  private:
    struct Near {
        int particle;
        std::size_t cell;
        geometry::SurfacePoint at;
        double side, chi;
        Vec3 normal;
        Vec3 slide;  // velocity of the particle's image beside the membrane less that of the particle [m/s]
    };
    static bool actsBeside(const Cell& cell) {
        const membrane::Network& network = cell.membrane.network();
        return !network.isOpen() || (network.isTorn() && !network.wholeTriangles().empty());
    }
    void forgetOthers();  // clears what was found, and the trees of cells that are no longer held
    void find(const particles::ParticleSystem& system, std::size_t cell, double moved,
              const std::vector<int>& candidates);
    // The nearest point of the whole triangles beside a particle, and the particle's image there.
    geometry::NearestImages::Found beside(const geometry::TriangleTree& tree, const geometry::NearestImages& images,
                                          const Cell& cell, const Vec3& x) const;
    // Displacement that brings a particle at x, with this nearest point, to its place on its own side.
    Vec3 toOwnSide(const geometry::TriangleTree& tree, const geometry::NearestImages& images, const Cell& cell,
                   const geometry::SurfacePoint& at, const Vec3& x, double own) const;
    Vec3 velocity(const Near& near) const;
    Vec3 normal(const Cell& cell, const geometry::SurfacePoint& at, const Vec3& x) const;

    Cells& cells_;
    double spacing_, deepest_ = 0;
    long crossings_ = 0;
    SurfaceTrees surfaces_;
    std::vector<Near> near_;
};

}  // namespace corpuscle::coupling
