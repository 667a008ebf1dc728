// Updates the nodes of held cells (dual identity): the owner of a node's particle sends its position and velocity to
// every rank that holds the cell. Planned when lists are built, used at every step.
#pragma once
#include <vector>

#include "coupling/cells.hpp"

namespace corpuscle::coupling {

class NodeExchange {
  public:
    // Plans the messages, after lists have been built: which node particles this rank owns, who holds their cells.
    // Collective.
    void plan(particles::ParticleSystem& system, Cells& cells);

    // Updates positions (unwrapped) and velocities of all nodes of held cells; velocities are extrapolated by
    // `extrapolation` seconds with the present acceleration. Collective.
    void gather(const particles::ParticleSystem& system, Cells& cells, double extrapolation);

    struct OwnedNode {
        int particle;  // its index in the store
        int cell;      // index of the cell among those that this rank holds
        int node;      // number of the node in the cell
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
