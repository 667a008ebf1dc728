// Evens out the fluid particles around membranes after the lattice has been carved.
//
//     x_i <- x_i + 0.02 H_s^2 C_i,   C_i = sum_j V_j F x_ij        at most 0.1 dx per sweep
//
// C points from where particles are dense to where they are sparse and vanishes where they lie evenly
// (sph/disorderPair.hpp). Only fluid particles nearer than 4 dx to a membrane move; nodes, walls and all others stay.
// Only what lies within their reach enters the sums, so the cost goes with the membranes' area, not with the box.
//
// How even it is can be read off sigma_i = sum_j V_j W_ij, which is 1 where particles fill space.
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
    Spread near, beyond;  // of sigma: fluid particles nearer than 4 dx to a membrane, and up to H_s farther
};

class Relaxation {
  public:
    static constexpr double reachInSpacings = 4;

    // Wrapped positions of the fluid and wall particles.
    Relaxation(const simulation::Case& input, MPI_Comm comm, const std::vector<Vec3>& fluid,
               const std::vector<Vec3>& walls, const std::vector<geometry::TriangleMesh>& cells);

    Evenness evenness();
    void sweep();
    // Numbers of the fluid particles that may have moved, and where they are now.
    std::vector<std::pair<std::size_t, Vec3>> moved() const;

  private:
    enum class Zone : char { near, beyond, rim, fixed };  // the rim only completes the sums of the others
    Zone zoneOf(std::size_t i) const { return zone_[static_cast<std::size_t>(system_.store().id[i])]; }
    void add(particles::Kind kind, Zone zone, const Vec3& x, double volume);
    void sums();

    const simulation::Case& input_;
    particles::ParticleSystem system_;
    std::vector<Zone> zone_;               // by id
    std::vector<std::size_t> fluidIndex_;  // by id, of the fluid particles, which come first
    particles::RealArray records_, sums_, disorder_[4];
};

}  // namespace corpuscle::utilities
