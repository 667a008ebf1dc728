#include "coupling/nodeExchange.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "core/communicator.hpp"
#include "core/together.hpp"

namespace corpuscle::coupling {

using particles::ParticleStore;
using particles::ParticleSystem;

namespace {

constexpr int nodeFields = 6;
constexpr int nodeTag = 11;

}  // namespace

void NodeExchange::plan(ParticleSystem& system, Cells& cells) {
    cells.follow(system);
    const int size = system.decomposition().size(), self = system.decomposition().rank();
    owned_.clear();
    const ParticleStore& store = system.store();
    std::string lost;
    // Each owner of node particles tells each holder which nodes it will send.
    std::vector<std::vector<int>> lists(static_cast<std::size_t>(size)), entries(static_cast<std::size_t>(size));
    for (int i = 0; i < system.owned(); ++i) {
        const std::int64_t number = store.node[static_cast<std::size_t>(i)];
        if (number < 0) continue;
        const auto [cell, node] = cells.cellOfNode(number);
        const std::size_t index = cells.indexOf(cell);
        if (index == Cells::notHeld) {
            lost = fmt::format("node {} of the membrane '{}' is at ({:.4g}, {:.4g}, {:.4g}) m, far from its cell", node,
                               cells.nameOf(cell), store.x[static_cast<std::size_t>(i)],
                               store.y[static_cast<std::size_t>(i)], store.z[static_cast<std::size_t>(i)]);
            continue;
        }
        for (const int r : cells[index].holders) {
            if (r == self) continue;
            entries[static_cast<std::size_t>(r)].push_back(static_cast<int>(owned_.size()));
            lists[static_cast<std::size_t>(r)].push_back(static_cast<int>(number));
        }
        owned_.push_back({i, static_cast<int>(index), node});
    }
    throwTogether(system.comm(), !lost.empty(), lost, ExitCode::numerics);
    channels_.clear();
    const std::vector<std::vector<int>> received = Communicator(system.comm()).exchange(lists);
    for (int r = 0; r < size; ++r) {
        const auto k = static_cast<std::size_t>(r);
        if (lists[k].empty() && received[k].empty()) continue;
        Channel channel{r, entries[k], {}, {}, {}};
        for (const int number : received[k]) {
            const auto [cell, node] = cells.cellOfNode(number);
            channel.receive.emplace_back(static_cast<int>(cells.indexOf(cell)), node);
        }
        channel.sendBuffer.resize(nodeFields * channel.send.size());
        channel.receiveBuffer.resize(nodeFields * channel.receive.size());
        channels_.push_back(std::move(channel));
    }
}

void NodeExchange::place(const Periodicity& periodicity, Cell& cell, int node, const Vec3& position,
                         const Vec3& velocity) {
    // The image of the particle nearest to the previous position of the node. Where no box length is added, position
    // and particle have the same bits.
    Vec3& x = cell.membrane.position[static_cast<std::size_t>(node)];
    x = periodicity.nearest(position, x);
    cell.membrane.velocity[static_cast<std::size_t>(node)] = velocity;
}

void NodeExchange::gather(const ParticleSystem& system, Cells& cells, double extrapolation) {
    const ParticleStore& store = system.store();
    const auto velocity = [&](int i) -> Vec3 {
        return store.velocity(i) + extrapolation * Vec3(store.fx[i], store.fy[i], store.fz[i]);
    };
    requests_.clear();
    for (Channel& channel : channels_) {
        if (!channel.receive.empty()) {
            requests_.emplace_back();
            MPI_Irecv(channel.receiveBuffer.data(), static_cast<int>(channel.receiveBuffer.size()), MPI_DOUBLE,
                      channel.rank, nodeTag, system.comm(), &requests_.back());
        }
        double* out = channel.sendBuffer.data();
        for (const int k : channel.send) {
            const int i = owned_[static_cast<std::size_t>(k)].particle;
            for (const Vec3& vector : {store.position(i), velocity(i)}) out = std::copy_n(vector.data(), 3, out);
        }
        if (!channel.send.empty()) {
            requests_.emplace_back();
            MPI_Isend(channel.sendBuffer.data(), static_cast<int>(channel.sendBuffer.size()), MPI_DOUBLE, channel.rank,
                      nodeTag, system.comm(), &requests_.back());
        }
    }
    for (const OwnedNode& n : owned_)
        place(system.periodicity(), cells[static_cast<std::size_t>(n.cell)], n.node, store.position(n.particle),
              velocity(n.particle));
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    for (Channel& channel : channels_) {
        const double* in = channel.receiveBuffer.data();
        for (const auto& [c, node] : channel.receive) {
            place(system.periodicity(), cells[static_cast<std::size_t>(c)], node, Vec3(in), Vec3(in + 3));
            in += nodeFields;
        }
    }
}

}  // namespace corpuscle::coupling
