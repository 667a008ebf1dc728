#include "packing/crowd.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "geometry/place.hpp"

namespace corpuscle::packing {
namespace {

// Approach of two surfaces, over the reach of the law, after which the lists are made anew.
constexpr double spareOfReach = 1;

double radiusOf(const geometry::TriangleMesh& mesh) {
    double most = 0;
    for (const Vec3& x : mesh.nodes) most = std::max(most, x.norm());
    return most;
}

// Two unit vectors normal to the axis and to each other.
Eigen::Matrix<double, 3, 2> across(const Vec3& axis) {
    Eigen::Matrix<double, 3, 2> both;
    both.col(0) = axis.unitOrthogonal();
    both.col(1) = axis.cross(both.col(0));
    return both;
}

}  // namespace

Crowd::Crowd(std::vector<Kind> kinds, const std::vector<geometry::TriangleMesh>& fixed, boundary::Walls walls,
             const Periodicity& period, std::shared_ptr<const contact::ContactLaw> law)
    : walls_(std::move(walls)), period_(period), law_(law), contacts_(std::move(law)) {
    const auto solid = [](geometry::TriangleMesh mesh, bool mayTurn) {
        contact::Surface surface(mesh.nodes, mesh.triangles);
        const double radius = radiusOf(mesh);
        return Solid{std::move(mesh), std::move(surface), radius, mayTurn};
    };
    for (Kind& kind : kinds) kinds_.push_back(solid(std::move(kind.mesh), kind.mayTurn));
    for (const geometry::TriangleMesh& mesh : fixed) fixed_.push_back(solid(mesh, false));
}

void Crowd::populate(const std::vector<Pose>& poses) {
    cellCount_ = poses.size();
    surfaces_.clear(), cellOf_.clear();
    firstNode_.assign(1, 0);
    const auto add = [&](const Solid& solid, int cell) {
        surfaces_.push_back(&solid.surface);
        firstNode_.push_back(firstNode_.back() + solid.mesh.nodes.size());
        cellOf_.insert(cellOf_.end(), solid.mesh.nodes.size(), cell);
    };
    for (std::size_t c = 0; c < poses.size(); ++c) add(kinds_[poses[c].kind], static_cast<int>(c));
    for (const Solid& solid : fixed_) add(solid, -1);
    isListed_ = false;
}

std::vector<Vec3> Crowd::nodes(const std::vector<Pose>& poses, double scale) const {
    std::vector<Vec3> x;
    x.reserve(cellOf_.size());
    for (const Pose& pose : poses) {
        const std::vector<Vec3> own = geometry::Place{pose.centre, pose.axis, scale}.of(kinds_[pose.kind].mesh.nodes);
        x.insert(x.end(), own.begin(), own.end());
    }
    for (const Solid& solid : fixed_) x.insert(x.end(), solid.mesh.nodes.begin(), solid.mesh.nodes.end());
    return x;
}

std::vector<Pose> Crowd::moved(std::vector<Pose> poses, const Eigen::VectorXd& step) const {
    for (std::size_t c = 0; c < poses.size(); ++c) {
        Pose& pose = poses[c];
        const Row q = step.segment<freedoms>(freedoms * static_cast<Eigen::Index>(c));
        pose.centre += q.head<3>();
        const Vec3 turn = across(pose.axis) * q.tail<2>() / kinds_[pose.kind].radius;
        if (const double angle = turn.norm(); angle > 0)
            pose.axis = (Eigen::AngleAxisd(angle, turn / angle) * pose.axis).normalized();
    }
    return poses;
}

std::span<const Vec3> Crowd::ofCell(std::size_t cell, const std::vector<Vec3>& x) const {
    return std::span<const Vec3>(x).subspan(firstNode_[cell], firstNode_[cell + 1] - firstNode_[cell]);
}

void Crowd::list(const std::vector<Vec3>& x, std::span<const Vec3> travel) {
    std::vector<geometry::Bounds> bounds(surfaces_.size());
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
        for (const Vec3& place : ofCell(s, x)) bounds[s].extend(place);
    const double spare = spareOfReach * law_->reach();
    std::vector<geometry::ImagePair> pairs;
    for (const geometry::ImagePair& pair : geometry::neighbours(bounds, period_, contacts_.pairMargin(spare, travel)))
        if (pair.first < cellCount_ || pair.second < cellCount_) pairs.push_back(pair);
    contacts_.find(surfaces_, x, pairs, spare, travel);
    isListed_ = true;
}

void Crowd::evaluate(const std::vector<Vec3>& x) {
    x_ = x;
    if (isListed_ && contacts_.covers(x))
        contacts_.evaluate(x);
    else
        list(x, {});
    findWalls();
}

void Crowd::findWalls() {
    atWalls_.clear();
    for (std::size_t c = 0; c < cellCount_; ++c)
        for (const contact::AtWall& at : contact::nodesAtWalls(*law_, walls_, *surfaces_[c], ofCell(c, x_))) {
            atWalls_.push_back({static_cast<int>(c), at});
            atWalls_.back().at.node += firstNode_[c];
        }
}

double Crowd::energy() const {
    double sum = contacts_.energy();
    for (const auto& [cell, at] : atWalls_) sum += at.area * at.psi.energy;
    return sum;
}

double Crowd::leastGap() const {
    double least = contacts_.leastGap();
    for (const auto& [cell, at] : atWalls_)
        least = std::min(least, walls_[static_cast<std::size_t>(at.wall)].distance(x_[at.node]) - law_->thickness);
    return least;
}

// For each cell, the matrix that maps the rotation of its axis to that of its nodes, divided by its radius [1/m].
std::vector<Mat3> Crowd::turnsOf(const std::vector<Pose>& poses) const {
    constexpr double leastDivisor = 1e-3;  // near -z, where the shortest rotation is undetermined
    std::vector<Mat3> turns;
    for (const Pose& pose : poses) {
        const Vec3& a = pose.axis;
        const Vec3 rest = Vec3::UnitZ() - a * a[2];
        turns.push_back((Mat3::Identity() - a * rest.transpose() / std::max(1 + a[2], leastDivisor)) /
                        kinds_[pose.kind].radius);
    }
    return turns;
}

// Derivative of direction . x by the unknowns of the cell, where x is one of its nodes.
Crowd::Row Crowd::rowOf(const Pose& pose, const Mat3& turns, const Vec3& x, const Vec3& direction) const {
    Row row;
    row.head<3>() = direction;
    if (kinds_[pose.kind].mayTurn)
        row.tail<2>() = across(pose.axis).transpose() * (turns.transpose() * (x - pose.centre).cross(direction));
    else
        row.tail<2>().setZero();
    return row;
}

Eigen::VectorXd Crowd::gradient(const std::vector<Pose>& poses) const {
    std::vector<Vec3> f(x_.size(), Vec3::Zero());
    contacts_.addForces(f);
    for (const auto& [cell, at] : atWalls_) f[at.node] += at.force();
    const std::vector<Mat3> turns = turnsOf(poses);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(freedoms * static_cast<Eigen::Index>(cellCount_));
    for (std::size_t n = 0; n < firstNode_[cellCount_]; ++n)
        if (const auto c = static_cast<std::size_t>(cellOf_[n]); !f[n].isZero(0))
            g.segment<freedoms>(freedoms * static_cast<Eigen::Index>(c)) -= rowOf(poses[c], turns[c], x_[n], f[n]);
    return g;
}

Eigen::SparseMatrix<double> Crowd::stiffness(const std::vector<Pose>& poses) const {
    using Block = Eigen::Matrix<double, freedoms, freedoms>;
    std::map<std::pair<int, int>, Block> blocks;  // row >= column
    const auto add = [&](int i, int j, const Block& block) {
        auto [at, isNew] = blocks.try_emplace({i, j}, block);
        if (!isNew) at->second += block;
    };
    const std::vector<Mat3> turns = turnsOf(poses);
    for (const contact::Spring& spring : contacts_.springs()) {
        std::array<int, 2> cell{-1, -1};  // a spring connects two cells at most
        std::array<Row, 2> rows{Row::Zero(), Row::Zero()};
        for (std::size_t k = 0; k < 4; ++k) {
            const auto n = static_cast<std::size_t>(spring.nodes[k]);
            const int c = cellOf_[n];
            if (spring.weights[k] == 0 || c < 0) continue;
            const std::size_t side = cell[0] < 0 || cell[0] == c ? 0 : 1;
            cell[side] = c;
            rows[side] += rowOf(poses[static_cast<std::size_t>(c)], turns[static_cast<std::size_t>(c)], x_[n],
                                spring.weights[k] * spring.normal);
        }
        for (std::size_t a = 0; a < 2; ++a)
            for (std::size_t b = 0; b < 2; ++b)
                if (cell[a] >= 0 && cell[b] >= 0 && cell[a] >= cell[b])
                    add(cell[a], cell[b], spring.stiffness * rows[a] * rows[b].transpose());
    }
    for (const auto& [cell, at] : atWalls_) {
        const auto c = static_cast<std::size_t>(cell);
        const Row row = rowOf(poses[c], turns[c], x_[at.node], at.normal);
        add(cell, cell, at.area * std::max(at.psi.curvature, 0.0) * row * row.transpose());
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [at, block] : blocks)
        for (int i = 0; i < freedoms; ++i)
            for (int j = 0; j < freedoms; ++j)
                if (at.first != at.second || i >= j)
                    entries.emplace_back(freedoms * at.first + i, freedoms * at.second + j, block(i, j));
    const Eigen::Index size = freedoms * static_cast<Eigen::Index>(cellCount_);
    Eigen::SparseMatrix<double> k(size, size);
    k.setFromTriplets(entries.begin(), entries.end());
    return k;
}

double Crowd::freeTravel(const std::vector<Vec3>& u, double share) {
    double free = contacts_.freeTravel(x_, u, share);
    if (free < 1) {  // perhaps limited only by the lists, which were made for a shorter motion
        list(x_, u);
        free = contacts_.freeTravel(x_, u, share);
    }
    for (std::size_t c = 0; c < cellCount_; ++c)
        free = std::min(free, contact::freeOfWalls(*law_, walls_, ofCell(c, x_), ofCell(c, u), share));
    return free;
}

}  // namespace corpuscle::packing
