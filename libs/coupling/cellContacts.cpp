#include "coupling/cellContacts.hpp"

#include <algorithm>

#include "core/communicator.hpp"

namespace corpuscle::coupling {

using particles::ParticleSystem;

namespace {

constexpr double keptShare = 0.1;  // fraction of each gap that a free motion leaves

std::shared_ptr<const contact::Surface> surfaceOf(const membrane::Network& network) {
    std::vector<Index3> whole;
    for (const int t : network.wholeTriangles()) whole.push_back(network.triangles()[static_cast<std::size_t>(t)]);
    return std::make_shared<const contact::Surface>(network.stressFree(), whole);
}

}  // namespace

CellContacts::CellContacts(const contact::ContactSettings& settings, const boundary::Walls& walls)
    : settings_(settings), walls_(walls), contacts_(settings.law.model) {}

CellContacts::Surfaces CellContacts::surfacesOf(const Cells& cells,
                                                std::map<const membrane::Network*, Known>& known) const {
    std::map<const membrane::Network*, Known> now;
    Surfaces surfaces;
    for (const Cell& cell : cells) {
        const membrane::Network& network = cell.membrane.network();
        auto [at, isNew] = now.try_emplace(&network);
        if (isNew) {
            const auto before = known.find(&network);
            const bool holds = before != known.end() && before->second.changes == network.changes() &&
                               before->second.surface->nodes() == network.nodeCount();
            at->second = holds ? before->second : Known{network.changes(), surfaceOf(network)};
        }
        surfaces.push_back(at->second.surface);
    }
    known.swap(now);
    return surfaces;
}

void CellContacts::list(contact::Contacts& contacts, const Cells& cells, const NodeVectors& x,
                        const ParticleSystem& system, const Way& way, const Surfaces& surfaces) const {
    const int rank = system.decomposition().rank();
    std::vector<const contact::Surface*> pieces;
    std::vector<geometry::Bounds> bounds;
    for (std::size_t c = 0, first = 0; c < cells.heldCount(); first += surfaces[c]->nodes(), ++c) {
        pieces.push_back(surfaces[c].get());
        geometry::Bounds box;
        for (std::size_t n = first; n < first + surfaces[c]->nodes(); ++n) box.extend(x[n]);
        bounds.push_back(box);
    }
    const double spare = spareOfReach * settings_.law->reach();
    const Periodicity period = system.imagesAgo(way.ago);
    const contact::Sliding sliding{way.seconds, period.slideOf(Vec3::Zero(), period.lengths()).norm()};
    std::vector<geometry::ImagePair> pairs;
    for (const geometry::ImagePair& pair :
         geometry::neighbours(bounds, period, contacts.pairMargin(spare, way.displacement, sliding)))
        if (lowestCommonHolder(cells[pair.first].holders, cells[pair.second].holders) == rank) pairs.push_back(pair);
    if (settings_.self)
        for (std::size_t c = 0; c < cells.heldCount(); ++c)
            if (cells[c].isOwnedBy(rank)) pairs.push_back({c, c, Vec3::Zero()});
    contacts.find(pieces, x, pairs, spare, way.displacement, sliding);
}

void CellContacts::place(const Cells& cells, const NodeLayout& layout, const ParticleSystem& system, const Way& way) {
    layout_ = layout;
    x_ = positionsOf(cells);
    surfaces_ = surfacesOf(cells, known_);
    listed_.clear();
    for (const Cell& cell : cells) listed_.push_back(cell.membrane.cell);
    listedOffset_ = system.periodicity().offset();
    list(contacts_, cells, x_, system, way, surfaces_);
    std::vector<char> mine(x_.size(), 0);
    contacts_.markListed(mine);
    sums_.plan(
        cells, system.comm(), [](const Cell& cell) { return cell.nodeCount(); }, mine);
    atWalls_ = atWallsOf(layout_, x_, surfaces_);
}

bool CellContacts::isListed(const Cells& cells, const Periodicity& period) const {
    return period.offset() == listedOffset_ &&
           std::equal(cells.begin(), cells.end(), listed_.begin(), listed_.end(),
                      [](const Cell& cell, int number) { return cell.membrane.cell == number; });
}

std::vector<CellContacts::AtWall> CellContacts::atWallsOf(const NodeLayout& layout, const NodeVectors& x,
                                                          const Surfaces& surfaces) const {
    std::vector<AtWall> found;
    if (!settings_.walls) return found;
    for (std::size_t c = 0; c < layout.cells(); ++c)
        for (const contact::AtWall& at : contact::nodesAtWalls(*settings_.law, walls_, *surfaces[c], layout.of(c, x))) {
            found.push_back({at, c});
            found.back().node += layout.first(c);
        }
    return found;
}

// add(part): adds the forces of the pairs that this rank computes.
template <class Add>
void CellContacts::addUp(NodeVectors& f, Add&& add) const {
    NodeVectors part(f.size(), Vec3::Zero());
    add(part);
    sums_.addUp({reinterpret_cast<double*>(part.data()), 3 * part.size()}, 3);
    for (std::size_t m = 0; m < f.size(); ++m) f[m] += part[m];
}

void CellContacts::addForces(NodeVectors& f) const {
    addUp(f, [&](NodeVectors& part) { contacts_.addForces(part); });
    for (const AtWall& at : atWalls_) f[at.node] += at.force();
}

void CellContacts::addStiffness(double factor, const NodeVectors& u, NodeVectors& f) const {
    addUp(f, [&](NodeVectors& part) { contacts_.addStiffness(factor, u, part); });
    for (const AtWall& at : atWalls_)
        f[at.node] += factor * at.area * std::max(at.psi.curvature, 0.0) * at.normal.dot(u[at.node]) * at.normal;
}

void CellContacts::addForcesAt(const NodeVectors& displacement, NodeVectors& f) const {
    NodeVectors x = x_;
    for (std::size_t m = 0; m < x.size(); ++m) x[m] += displacement[m];
    contact::Contacts there = contacts_;
    there.evaluate(x);
    addUp(f, [&](NodeVectors& part) { there.addForces(part); });
    for (const AtWall& at : atWallsOf(layout_, x, surfaces_)) f[at.node] += at.force();
}

std::vector<CellContacts::OnWall> CellContacts::forcesOnWalls(const Cells& cells, int rank,
                                                              const NodeVectors& displacement) const {
    NodeVectors x = x_;
    for (std::size_t m = 0; m < x.size(); ++m) x[m] += displacement[m];
    std::vector<OnWall> forces;
    for (const AtWall& at : atWallsOf(layout_, x, surfaces_))
        if (cells[at.cell].isOwnedBy(rank)) forces.push_back({at.wall, x[at.node], -at.force()});
    return forces;
}

double CellContacts::freeOfWalls(const NodeLayout& layout, const NodeVectors& x,
                                 const NodeVectors& displacement) const {
    double free = 1;
    for (std::size_t c = 0; settings_.walls && c < layout.cells(); ++c)
        free = std::min(
            free, contact::freeOfWalls(*settings_.law, walls_, layout.of(c, x), layout.of(c, displacement), keptShare));
    return free;
}

double CellContacts::freeTravel(const Cells& cells, const NodeLayout& layout, const ParticleSystem& system,
                                const NodeVectors& x, const Way& way) const {
    const NodeVectors& displacement = way.displacement;
    double free = isListed(cells, system.imagesAgo(way.ago)) && contacts_.covers(x)
                      ? contacts_.freeTravel(x, displacement, keptShare, way.seconds)
                      : 0;
    if (free < 1) {  // perhaps limited only by the lists, which were made for another motion
        std::map<const membrane::Network*, Known> known = known_;
        const Surfaces surfaces = surfacesOf(cells, known);
        contact::Contacts there(settings_.law.model);
        list(there, cells, x, system, way, surfaces);
        free = there.freeTravel(x, displacement, keptShare, way.seconds);
    }
    free = std::min(free, freeOfWalls(layout, x, displacement));
    return Communicator(system.comm()).min(free);
}

CellContacts::Now CellContacts::now(const Cells& cells, const ParticleSystem& system) const {
    const NodeLayout layout(cells);
    const NodeVectors x = positionsOf(cells);
    std::map<const membrane::Network*, Known> known = known_;
    const Surfaces surfaces = surfacesOf(cells, known);
    Now now{contacts_, atWallsOf(layout, x, surfaces)};
    if (isListed(cells, system.periodicity()) && contacts_.covers(x))
        now.among.evaluate(x);
    else
        list(now.among, cells, x, system, {NodeVectors(x.size(), Vec3::Zero())}, surfaces);
    std::erase_if(now.atWalls,
                  [&](const AtWall& at) { return !cells[at.cell].isOwnedBy(system.decomposition().rank()); });
    return now;
}

double CellContacts::energy(const Cells& cells, const ParticleSystem& system) const {
    const Now here = now(cells, system);
    double sum = here.among.energy();
    for (const AtWall& at : here.atWalls) sum += at.area * at.psi.energy;
    return sum;
}

// For images n periods L away, sum x f^T over the images that touch, less the same sum over their nodes, is
// sum (n L + ...) f^T. The dots are the offset of sliding images and periods along the other axes; its row of the
// sliding axis contains only n L.
double CellContacts::powerOfImages(const Periodicity& period, const NodeVectors& displacement) const {
    if (!period.slides()) return 0;
    NodeVectors x = x_, f(x_.size(), Vec3::Zero());
    for (std::size_t m = 0; m < x.size(); ++m) x[m] += displacement[m];
    contact::Contacts there = contacts_;
    there.evaluate(x);
    there.addForces(f);
    const int axis = period.slidingAxis();
    Vec3 force = there.virial().row(axis).transpose();  // becomes the sum of n L f
    for (std::size_t m = 0; m < f.size(); ++m) force -= x[m][axis] * f[m];
    return period.slide().dot(force) / period.lengths()[axis];
}

// For a node at a wall, x in x f^T is the vector from the wall to the node.
Mat3 CellContacts::stresslet(const Cells& cells, const ParticleSystem& system) const {
    const Now here = now(cells, system);
    Mat3 sum = -here.among.virial();
    for (const AtWall& at : here.atWalls) sum -= at.distance * at.normal * at.force().transpose();
    std::vector<double> numbers(sum.data(), sum.data() + sum.size());
    numbers = Communicator(system.comm()).sum(std::move(numbers));
    return Mat3::Map(numbers.data());
}

}  // namespace corpuscle::coupling
