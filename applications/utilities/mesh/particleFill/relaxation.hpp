// Makes the distribution of fluid particles around membranes more uniform after lattice points have been removed there.
//
//     x_i <- x_i + 0.02 H_s^2 C_i,   C_i = sum_j V_j F x_ij        at most 0.1 dx per sweep
//
// C points from dense to sparse regions and vanishes in a uniform distribution (sph/disorderPair.hpp). Only fluid
// particles nearer than 4 dx to a membrane move; nodes, walls and all other particles stay. Only particles within reach
// of the moving ones enter the sums, so the cost grows with the area of the membranes, not with the volume of the box.
//
// A measure of uniformity is sigma_i = sum_j V_j W_ij, which is 1 where particles fill space.
#pragma once
#include "geometry/triangleMesh.hpp"
#include "particles/particleSystem.hpp"
#include "simulation/case.hpp"

namespace corpuscle::utilities {

struct Spread {
    long count = 0;
    double mean = 0, deviation = 0;
};
struct Evenness {
    // Of sigma, over the fluid particles nearer than 4 dx to a membrane (near), and those up to H_s farther (beyond).
    Spread near, beyond;
};

class Relaxation {
  public:
    static constexpr double reachInSpacings = 4;

    // `fluid`, `walls`: wrapped positions of the fluid and wall particles.
    Relaxation(const simulation::Case& input, MPI_Comm comm, const std::vector<Vec3>& fluid,
               const std::vector<Vec3>& walls, const std::vector<geometry::TriangleMesh>& cells);

    Evenness evenness();
    void sweep();
    // Numbers of the fluid particles that may have moved, with their present positions.
    std::vector<std::pair<std::size_t, Vec3>> moved() const;

  private:
    enum class Zone : char { near, beyond, rim, fixed };  // rim: needed only for the sums of the others
    Zone zoneOf(std::size_t i) const { return zone_[static_cast<std::size_t>(system_.store().id[i])]; }
    void add(particles::Kind kind, Zone zone, const Vec3& x, double volume);
    void sums();

    const simulation::Case& input_;
    particles::ParticleSystem system_;
    std::vector<Zone> zone_;               // by id
    std::vector<std::size_t> fluidIndex_;  // by id, for the fluid particles, which come first
    particles::RealArray records_, sums_, disorder_[4];
};

}  // namespace corpuscle::utilities
