// Keeps the nodes of held cells up to date: owners of node particles send position and velocity to every rank that
// holds the cell. Planned when lists are built, used at every step.
#pragma once
#include <vector>

#include "coupling/cell.hpp"
#include "particles/particleSystem.hpp"

namespace corpuscle::coupling {

class NodeExchange {
  public:
    // Who holds which cell now, who owns which node. Hands the state of a cell to ranks that newly hold it. Collective.
    void plan(particles::ParticleSystem& system, std::vector<Cell>& cells, double margin);

    // Positions (unwrapped) and velocities, `extrapolation` seconds on by the present acceleration, of all nodes of
    // held cells. Collective.
    void gather(const particles::ParticleSystem& system, std::vector<Cell>& cells, double extrapolation);

    struct OwnedNode {
        int particle;  // in the store
        int cell, node;
    };
    const std::vector<OwnedNode>& owned() const { return owned_; }

  private:
    void findHolders(const particles::ParticleSystem& system, std::vector<Cell>& cells, double margin);
    void handOver(const particles::ParticleSystem& system, std::vector<Cell>& cells,
                  const std::vector<std::vector<char>>& before);
    static void place(const Periodicity& periodicity, Cell& cell, int node, const Vec3& position, const Vec3& velocity);

    std::vector<OwnedNode> owned_;
    std::vector<std::vector<char>> holds_;  // [cell][rank]
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
