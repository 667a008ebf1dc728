#include "coupling/nodeExchange.hpp"

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"

namespace corpuscle::coupling {

using particles::Box;
using particles::ParticleStore;
using particles::ParticleSystem;

namespace {

constexpr int nodeFields = 6;
enum Tag { nodeTag = 11, stateTag };

// Whether some periodic image of [low, high] meets the brick.
bool touches(const Box& box, const Vec3& low, const Vec3& high, const particles::Brick& brick) {
    const Vec3 size = box.size();
    for (int k = 0; k < 3; ++k) {
        if (!box.periodic[k]) {
            // Beyond the walls the outermost bricks reach on.
            const bool below = high[k] < brick.low[k] && brick.low[k] > box.low[k];
            const bool above = low[k] > brick.high[k] && brick.high[k] < box.high[k];
            if (below || above) return false;
            continue;
        }
        if (high[k] - low[k] >= size[k]) continue;
        bool meets = false;
        const int nearest = static_cast<int>(
            std::floor((0.5 * (brick.low[k] + brick.high[k]) - 0.5 * (low[k] + high[k])) / size[k] + 0.5));
        for (int image = nearest - 1; image <= nearest + 1 && !meets; ++image)
            meets = low[k] + image * size[k] <= brick.high[k] && high[k] + image * size[k] >= brick.low[k];
        if (!meets) return false;
    }
    return true;
}

}  // namespace

void NodeExchange::findHolders(const ParticleSystem& system, std::vector<Cell>& cells, double margin) {
    const auto& decomposition = system.decomposition();
    // Holders know a cell's unwrapped bounds; one of them tells everybody.
    std::vector<double> bounds(6 * cells.size(), -INFINITY);
    for (std::size_t c = 0; c < cells.size(); ++c)
        if (cells[c].held)
            for (const Vec3& p : cells[c].membrane.position)
                for (std::size_t k = 0; k < 3; ++k) {
                    bounds[6 * c + k] = std::max(bounds[6 * c + k], -p[static_cast<int>(k)]);
                    bounds[6 * c + 3 + k] = std::max(bounds[6 * c + 3 + k], p[static_cast<int>(k)]);
                }
    MPI_Allreduce(MPI_IN_PLACE, bounds.data(), static_cast<int>(bounds.size()), MPI_DOUBLE, MPI_MAX, system.comm());
    holds_.assign(cells.size(), std::vector<char>(static_cast<std::size_t>(decomposition.size()), 0));
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Vec3 low = -Vec3(bounds[6 * c], bounds[6 * c + 1], bounds[6 * c + 2]) - Vec3::Constant(margin);
        const Vec3 high = Vec3(bounds[6 * c + 3], bounds[6 * c + 4], bounds[6 * c + 5]) + Vec3::Constant(margin);
        for (int r = 0; r < decomposition.size(); ++r)
            holds_[c][static_cast<std::size_t>(r)] = touches(system.box(), low, high, decomposition.brick(r));
    }
}

void NodeExchange::handOver(const ParticleSystem& system, std::vector<Cell>& cells,
                            const std::vector<std::vector<char>>& before) {
    const int self = system.decomposition().rank(), size = system.decomposition().size();
    const auto me = static_cast<std::size_t>(self);
    std::vector<MPI_Request> requests;
    std::vector<std::vector<double>> messages;
    messages.reserve(cells.size() * static_cast<std::size_t>(size));
    for (std::size_t c = 0; c < cells.size(); ++c) {
        int source = -1;  // the first of the old holders
        for (int r = 0; r < size && source < 0; ++r)
            if (before[c][static_cast<std::size_t>(r)]) source = r;
        membrane::Membrane& m = cells[c].membrane;
        const std::vector<char>& alive = m.network().aliveBonds();
        const std::vector<double>& damage = m.damage();
        const std::size_t length = nodeFields * m.position.size() + alive.size() + damage.size();
        if (self == source)
            for (int r = 0; r < size; ++r) {
                if (!holds_[c][static_cast<std::size_t>(r)] || before[c][static_cast<std::size_t>(r)]) continue;
                std::vector<double>& message = messages.emplace_back();
                for (std::size_t k = 0; k < m.position.size(); ++k) {
                    message.insert(message.end(), m.position[k].data(), m.position[k].data() + 3);
                    message.insert(message.end(), m.velocity[k].data(), m.velocity[k].data() + 3);
                }
                message.insert(message.end(), alive.begin(), alive.end());
                message.insert(message.end(), damage.begin(), damage.end());
                requests.emplace_back();
                MPI_Isend(message.data(), static_cast<int>(length), MPI_DOUBLE, r, stateTag, system.comm(),
                          &requests.back());
            }
        if (holds_[c][me] && !before[c][me]) {
            std::vector<double> message(length);
            MPI_Recv(message.data(), static_cast<int>(length), MPI_DOUBLE, source, stateTag, system.comm(),
                     MPI_STATUS_IGNORE);
            for (std::size_t k = 0; k < m.position.size(); ++k) {
                m.position[k] = Vec3(message.data() + nodeFields * k);
                m.velocity[k] = Vec3(message.data() + nodeFields * k + 3);
            }
            const auto firstDamage = message.end() - static_cast<std::ptrdiff_t>(damage.size());
            m.restore({firstDamage - static_cast<std::ptrdiff_t>(alive.size()), firstDamage},
                      {firstDamage, message.end()});
        }
        cells[c].held = holds_[c][me];
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

void NodeExchange::plan(ParticleSystem& system, std::vector<Cell>& cells, double margin) {
    const int size = system.decomposition().size(), self = system.decomposition().rank();
    // Who held before: at first everybody does.
    std::vector<std::vector<char>> before = holds_;
    if (before.empty()) before.assign(cells.size(), std::vector<char>(static_cast<std::size_t>(size), 1));
    findHolders(system, cells, margin);
    handOver(system, cells, before);

    owned_.clear();
    const ParticleStore& store = system.store();
    std::vector<int> cellOfNode;
    for (std::size_t c = 0; c < cells.size(); ++c)
        cellOfNode.insert(cellOfNode.end(), static_cast<std::size_t>(cells[c].nodeCount()), static_cast<int>(c));
    for (int i = 0; i < system.owned(); ++i)
        if (const auto node = store.node[i]; node >= 0) {
            const int c = cellOfNode[static_cast<std::size_t>(node)];
            owned_.push_back({i, c, static_cast<int>(node) - cells[static_cast<std::size_t>(c)].firstNode});
        }

    // Each owner tells each holder which nodes it will send.
    std::vector<std::vector<int>> lists(static_cast<std::size_t>(size));
    channels_.clear();
    std::vector<std::vector<int>> entries(static_cast<std::size_t>(size));
    for (std::size_t k = 0; k < owned_.size(); ++k)
        for (int r = 0; r < size; ++r)
            if (r != self && holds_[static_cast<std::size_t>(owned_[k].cell)][static_cast<std::size_t>(r)]) {
                entries[static_cast<std::size_t>(r)].push_back(static_cast<int>(k));
                lists[static_cast<std::size_t>(r)].push_back(cells[static_cast<std::size_t>(owned_[k].cell)].firstNode +
                                                             owned_[k].node);
            }
    const std::vector<std::vector<int>> received = Communicator(system.comm()).exchange(lists);
    for (int r = 0; r < size; ++r) {
        const auto k = static_cast<std::size_t>(r);
        if (lists[k].empty() && received[k].empty()) continue;
        Channel channel{r, entries[k], {}, {}, {}};
        for (const int node : received[k]) {
            const int c = cellOfNode[static_cast<std::size_t>(node)];
            channel.receive.emplace_back(c, node - cells[static_cast<std::size_t>(c)].firstNode);
        }
        channel.sendBuffer.resize(nodeFields * channel.send.size());
        channel.receiveBuffer.resize(nodeFields * channel.receive.size());
        channels_.push_back(std::move(channel));
    }
}

void NodeExchange::place(const Periodicity& periodicity, Cell& cell, int node, const Vec3& position,
                         const Vec3& velocity) {
    // The image nearest to where the node was: whole box lengths are added, so that without them the bits are the
    // particle's.
    Vec3& x = cell.membrane.position[static_cast<std::size_t>(node)];
    x = periodicity.nearest(position, x);
    cell.membrane.velocity[static_cast<std::size_t>(node)] = velocity;
}

void NodeExchange::gather(const ParticleSystem& system, std::vector<Cell>& cells, double extrapolation) {
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
