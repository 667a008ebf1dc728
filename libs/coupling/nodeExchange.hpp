// Keeps the nodes of held cells up to date: owners of node particles send position and velocity to every rank that
// holds the cell. Planned when lists are built, used at every step.
#pragma once
#include <vector>

#include "coupling/cells.hpp"

namespace corpuscle::coupling {

class NodeExchange {
  public:
    // Who owns which node, and who holds its cell, now that lists have been built. Collective.
    void plan(particles::ParticleSystem& system, Cells& cells);

    // Positions (unwrapped) and velocities, `extrapolation` seconds on by the present acceleration, of all nodes of
    // held cells. Collective.
    void gather(const particles::ParticleSystem& system, Cells& cells, double extrapolation);

    struct OwnedNode {
        int particle;  // in the store
        int cell;      // index among those that this rank holds
        int node;
    };
    const std::vector<OwnedNode>& owned() const { return owned_; }

  private:
    static void place(const Periodicity& periodicity, Cell& cell, int node, const Vec3& position, const Vec3& velocity);

    std::vector<OwnedNode> owned_;
    struct Channel {
        int rank;
        std::vector<int> send;                     // entries of owned_
        std::vector<std::pair<int, int>> receive;  // (cell, node)
        std::vector<double> sendBuffer, receiveBuffer;
    };
    std::vector<Channel> channels_;
    std::vector<MPI_Request> requests_;
};

}  // namespace corpuscle::coupling
