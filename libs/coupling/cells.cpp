#include "coupling/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/communicator.hpp"

namespace corpuscle::coupling {

using geometry::Bounds;
using geometry::boundsOf;
using particles::Box;
using particles::ParticleSystem;

namespace {

// Whether a periodic image of [low, high] intersects the brick. sliding: axis whose images slide, which is left out
// here; -1: none.
bool touchesPlainly(const Box& box, const Vec3& low, const Vec3& high, const particles::Brick& brick, int sliding) {
    const Vec3 size = box.size();
    for (int k = 0; k < 3; ++k) {
        if (k == sliding) continue;
        if (!box.periodic[static_cast<std::size_t>(k)]) {
            // The outermost bricks extend beyond the walls.
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

bool touches(const ParticleSystem& system, const Vec3& low, const Vec3& high, const particles::Brick& brick) {
    const Periodicity& period = system.periodicity();
    const int k = period.slidingAxis();
    if (k < 0) return touchesPlainly(system.box(), low, high, brick, k);
    const double length = period.lengths()[k];
    const double last = std::floor((brick.high[k] - low[k]) / length);
    for (double n = std::ceil((brick.low[k] - high[k]) / length); n <= last; ++n) {
        const Vec3 by = n * period.offset();
        if (touchesPlainly(system.box(), low + by, high + by, brick, k)) return true;
    }
    return false;
}

}  // namespace

Cells::Cells(std::vector<CellType> types, double margin) : types_(std::move(types)), margin_(margin) {
    for (CellType& type : types_) {
        type.firstCell = static_cast<int>(count_) + 1;
        type.firstNode = static_cast<int>(nodes_);
        type.membrane = std::make_shared<membrane::MembraneType>(type.stressFree.empty() ? type.nodes : type.stressFree,
                                                                 type.triangles, type.settings, type.radius);
        count_ += type.places.size();
        nodes_ += type.places.size() * type.nodes.size();
    }
}

std::size_t Cells::typeOf(int number) const {
    const auto next = std::upper_bound(types_.begin(), types_.end(), number,
                                       [](int n, const CellType& type) { return n < type.firstCell; });
    return static_cast<std::size_t>(next - types_.begin()) - 1;
}

std::string Cells::nameOf(int number) const {
    const CellType& type = types_[typeOf(number)];
    return nameOfCell(type.name, type.places.size(), number);
}

std::pair<int, int> Cells::cellOfNode(std::int64_t node) const {
    const auto next = std::upper_bound(types_.begin(), types_.end(), node,
                                       [](std::int64_t n, const CellType& type) { return n < type.firstNode; });
    const CellType& type = *std::prev(next);
    const auto below = static_cast<int>(node) - type.firstNode, nodes = static_cast<int>(type.nodes.size());
    return {type.firstCell + below / nodes, below % nodes};
}

double Cells::meanBondLength() const {
    double largest = 0;
    for (const CellType& type : types_) largest = std::max(largest, type.membrane->network().meanBondLength());
    return largest;
}

bool Cells::canRupture() const {
    return std::any_of(types_.begin(), types_.end(), [](const CellType& type) { return bool(type.settings.rupture); });
}

bool Cells::havePores() const {
    return std::any_of(types_.begin(), types_.end(), [](const CellType& type) { return !!type.settings.pores; });
}

std::size_t Cells::indexOf(int number) const {
    const auto at = std::lower_bound(held_.begin(), held_.end(), number,
                                     [](const Cell& cell, int n) { return cell.membrane.cell < n; });
    return at != held_.end() && at->membrane.cell == number ? static_cast<std::size_t>(at - held_.begin()) : notHeld;
}

Cell* Cells::find(int number) {
    const std::size_t index = indexOf(number);
    return index == notHeld ? nullptr : &held_[index];
}
const Cell* Cells::find(int number) const {
    const std::size_t index = indexOf(number);
    return index == notHeld ? nullptr : &held_[index];
}

double Cells::solidVolume(int number) const {
    const auto at = solidVolume_.find(number);
    return at == solidVolume_.end() ? 0 : at->second;
}

std::vector<Vec3> Cells::startingNodes(int number) const {
    const CellType& type = types_[typeOf(number)];
    return type.places[static_cast<std::size_t>(number - type.firstCell)].of(type.nodes);
}

// A cell of another scale has another stress-free shape, and so needs a MembraneType of its own.
Cell Cells::make(int number) const {
    const std::size_t index = typeOf(number);
    const CellType& type = types_[index];
    const double scale = type.places[static_cast<std::size_t>(number - type.firstCell)].scale;
    const double radius = scale * type.radius;
    std::shared_ptr<membrane::MembraneType> common = type.membrane;
    if (scale != 1) {
        std::vector<Vec3> rest = type.stressFree.empty() ? type.nodes : type.stressFree;
        for (Vec3& x : rest) x *= scale;
        common = std::make_shared<membrane::MembraneType>(std::move(rest), type.triangles, type.settings, radius);
    }
    Cell cell{.membrane = membrane::Membrane(nameOf(number), number, startingNodes(number), std::move(common)),
              .type = index,
              .radius = radius,
              .firstNode = type.firstNode + (number - type.firstCell) * static_cast<int>(type.nodes.size()),
              .nodeMass = type.nodeMass,
              .solidVolume = solidVolume(number)};
    for (double& mass : cell.nodeMass) mass *= scale * scale;
    cell.initialArea = cell.membrane.area();
    cell.initialVolume = cell.membrane.volume();
    return cell;
}

void Cells::placeAtStart(const ParticleSystem& system) {
    settledAt_ = system.builds();
    held_.clear();
    const int self = system.decomposition().rank();
    for (const CellType& type : types_) {
        const double extent = type.extent();
        for (std::size_t k = 0; k < type.places.size(); ++k) {
            const geometry::Place& place = type.places[k];
            const Vec3 around = Vec3::Constant(place.scale * extent + margin_);
            if (!touches(system, place.centre - around, place.centre + around, system.decomposition().own())) continue;
            const int number = type.firstCell + static_cast<int>(k);
            const Bounds reach = boundsOf(place.of(type.nodes));
            std::vector<int> holders = holdersOf(reach, system);
            if (!std::binary_search(holders.begin(), holders.end(), self)) continue;
            Cell cell = make(number);
            cell.reach = reach, cell.holders = std::move(holders);
            held_.push_back(std::move(cell));
        }
    }
}

void Cells::take(std::vector<Cell> cells, int rank) {
    held_ = std::move(cells);
    for (Cell& cell : held_) cell.holders = {rank};
}

std::vector<int> Cells::holdersOf(const Bounds& reach, const ParticleSystem& system) const {
    const Vec3 margin = Vec3::Constant(margin_);
    std::vector<int> holders;
    for (int r = 0; r < system.decomposition().size(); ++r)
        if (touches(system, reach.min() - margin, reach.max() + margin, system.decomposition().brick(r)))
            holders.push_back(r);
    return holders;
}

void Cells::settle(const ParticleSystem& system) {
    for (Cell& cell : held_) {
        const Bounds now = boundsOf(cell.membrane.position);
        if (!now.isEmpty()) cell.reach = now;  // empty with non-finite positions: a rollback will follow
    }
    resettle(system);
}

void Cells::resettle(const ParticleSystem& system) {
    settledAt_ = system.builds();
    const int self = system.decomposition().rank(), size = system.decomposition().size();
    if (!exist() || size == 1) return;
    std::vector<std::vector<double>> messages(static_cast<std::size_t>(size));
    for (Cell& cell : held_) {
        std::vector<int> next = holdersOf(cell.reach, system);
        if (cell.isOwnedBy(self))
            for (const int r : next) {
                if (std::binary_search(cell.holders.begin(), cell.holders.end(), r)) continue;
                const std::vector<double> state = packed(cell);
                auto& message = messages[static_cast<std::size_t>(r)];
                message.insert(message.end(), state.begin(), state.end());
            }
        cell.holders = std::move(next);
    }
    std::erase_if(
        held_, [&](const Cell& cell) { return !std::binary_search(cell.holders.begin(), cell.holders.end(), self); });
    for (const std::vector<double>& message : Communicator(system.comm()).exchange(messages))
        for (std::size_t at = 0; at < message.size();) {
            held_.push_back(unpacked(message, at));
            held_.back().holders = holdersOf(held_.back().reach, system);
        }
    std::sort(held_.begin(), held_.end(),
              [](const Cell& a, const Cell& b) { return a.membrane.cell < b.membrane.cell; });
}

// Number, reach, arc, positions and velocities of the nodes, which bonds are unbroken, damage, pores.
std::vector<double> Cells::packed(const Cell& cell) const {
    const membrane::Membrane& m = cell.membrane;
    std::vector<double> message{static_cast<double>(m.cell)};
    const auto add = [&](const Vec3& v) { message.insert(message.end(), v.data(), v.data() + 3); };
    add(cell.reach.min()), add(cell.reach.max());
    add(cell.arc.centre), add(cell.arc.turn);
    for (const Vec3& x : m.position) add(x);
    for (const Vec3& u : m.velocity) add(u);
    const std::vector<char>& alive = m.network().aliveBonds();
    message.insert(message.end(), alive.begin(), alive.end());
    message.insert(message.end(), m.damage().begin(), m.damage().end());
    message.insert(message.end(), m.pores().begin(), m.pores().end());
    return message;
}

Cell Cells::unpacked(const std::vector<double>& message, std::size_t& at) const {
    const auto number = [&] { return message[at++]; };
    const auto vector = [&] {
        Vec3 v(message.data() + at);
        at += 3;
        return v;
    };
    Cell cell = make(static_cast<int>(number()));
    membrane::Membrane& m = cell.membrane;
    const Vec3 low = vector(), high = vector();
    cell.reach = {low, high};
    cell.arc.centre = vector(), cell.arc.turn = vector();
    for (Vec3& x : m.position) x = vector();
    for (Vec3& u : m.velocity) u = vector();
    std::vector<char> alive(m.network().allBonds().size());
    for (char& bond : alive) bond = static_cast<char>(number());
    std::vector<double> damage(m.damage().size());
    for (double& d : damage) d = number();
    std::vector<double> pores(m.pores().size());
    for (double& share : pores) share = number();
    m.restore(std::move(alive), std::move(damage), std::move(pores));
    return cell;
}

void Cells::add(Cell cell) {
    CellType& type = types_.emplace_back();
    type.name = cell.membrane.name;
    type.nodes = cell.membrane.initialPosition();
    type.triangles = cell.membrane.network().triangles();
    type.stressFree = cell.membrane.network().stressFree();
    type.settings = cell.membrane.laws();
    type.radius = cell.radius;
    type.nodeMass = cell.nodeMass;
    type.places.emplace_back();
    type.firstCell = static_cast<int>(++count_);
    type.firstNode = static_cast<int>(nodes_);
    nodes_ += type.nodes.size();
    type.membrane =
        std::make_shared<membrane::MembraneType>(type.stressFree, type.triangles, type.settings, type.radius);
    cell.type = types_.size() - 1;
    cell.holders.resize(static_cast<std::size_t>(Communicator().size()));
    std::iota(cell.holders.begin(), cell.holders.end(), 0);
    held_.push_back(std::move(cell));
}

}  // namespace corpuscle::coupling
