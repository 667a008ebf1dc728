#include "contact/contacts.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::contact {
namespace {

enum Kind { onTriangle, onEdge, onNode };

double longest(std::span<const Vec3> all) {
    double most2 = 0;
    for (const Vec3& one : all) most2 = std::max(most2, one.squaredNorm());
    return std::sqrt(most2);
}

}  // namespace

void Contacts::find(std::span<const Surface* const> surfaces, std::span<const Vec3> x,
                    std::span<const geometry::ImagePair> pairs, double spare, std::span<const Vec3> travel,
                    Sliding sliding) {
    surfaces_.assign(surfaces.begin(), surfaces.end());
    firstNode_ = firstNodes(surfaces);
    found_.assign(x.begin(), x.end());
    slide_ = sliding.slide;
    expectedOfOthers_ = pairMargin(spare, travel, sliding) - law_->range();
    expected_.assign(pairs.size(), spare);
    if (!travel.empty()) {
        const std::vector<Motion> motions = motionsOf(travel);
        for (std::size_t p = 0; p < pairs.size(); ++p)
            expected_[p] = expectedOf(pairs[p], motions, sliding.seconds, spare);
    }
    std::vector<double> within = expected_;
    for (double& one : within) one += law_->range();
    candidates_ = std::make_shared<const Candidates>(findCandidates(surfaces, x, pairs, within));
    evaluate(x);
}

double Contacts::expectedOf(const geometry::ImagePair& pair, const std::vector<Motion>& motions, double seconds,
                            double spare) const {
    const double any = approach(pair, motions, seconds);
    const Motion& own = motions[pair.first];
    if (!isOfOne(pair) || own.gradient > mostGradient) return spare + any;
    const double within = (law_->range() + spare + 2 * own.rest) / (1 - own.gradient);
    return std::min(spare + any, within - law_->range());
}

double Contacts::pairMargin(double spare, std::span<const Vec3> travel, Sliding sliding) const {
    return law_->range() + spare + 2 * longest(travel) + sliding.seconds * sliding.slide;
}

std::vector<Contacts::Motion> Contacts::motionsOf(std::span<const Vec3> u) const {
    std::vector<Motion> motions;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
        const auto first = static_cast<std::size_t>(firstNode_[s]), count = surfaces_[s]->nodes();
        motions.push_back(motionOf(std::span<const Vec3>(found_).subspan(first, count), u.subspan(first, count)));
    }
    return motions;
}

Contacts::Motion Contacts::motionOf(std::span<const Vec3> x, std::span<const Vec3> u) const {
    Motion motion;
    if (u.empty()) return motion;
    Vec3 middle = Vec3::Zero();
    for (std::size_t n = 0; n < u.size(); ++n) middle += x[n], motion.mean += u[n];
    middle /= static_cast<double>(u.size()), motion.mean /= static_cast<double>(u.size());
    Mat3 spread = Mat3::Zero(), moved = Mat3::Zero();
    for (std::size_t n = 0; n < u.size(); ++n) {
        const Vec3 r = x[n] - middle;
        spread += r * r.transpose(), moved += (u[n] - motion.mean) * r.transpose();
    }
    spread += 1e-9 * spread.trace() * Mat3::Identity();  // for a flat sheet, which leaves one direction undetermined
    const Mat3 gradient = spread.trace() > 0 ? Mat3(moved * spread.inverse()) : Mat3(Mat3::Zero());
    motion.gradient = gradient.norm();
    double most2 = 0, rest2 = 0;
    for (std::size_t n = 0; n < u.size(); ++n) {
        const Vec3 d = u[n] - motion.mean;
        most2 = std::max(most2, d.squaredNorm());
        rest2 = std::max(rest2, (d - gradient * (x[n] - middle)).squaredNorm());
    }
    motion.spread = std::sqrt(most2), motion.rest = std::sqrt(rest2);
    return motion;
}

std::vector<Vec3> Contacts::since(std::span<const Vec3> x) const {
    std::vector<Vec3> d(x.begin(), x.end());
    for (std::size_t n = 0; n < d.size(); ++n) d[n] -= found_[n];
    return d;
}

bool Contacts::covers(std::span<const Vec3> x) const {
    if (x.size() != found_.size()) return false;
    const std::vector<Vec3> d = since(x);
    if (2 * longest(d) > expectedOfOthers_) return false;
    const std::vector<Motion> motions = motionsOf(d);
    for (std::size_t p = 0; p < expected_.size(); ++p)
        if (approach(candidates_->pairs[p], motions, 0, candidates_->within[p]) > expected_[p]) return false;
    return true;
}

std::array<int, 4> Contacts::nodesOf(const NodeRow& row, int triangle) const {
    const Index3& t = surfaces_[row.target]->triangles()[triangle];
    const int first = firstNode_[row.target];
    return {row.node, first + t[0], first + t[1], first + t[2]};
}

std::array<int, 4> Contacts::nodesOf(const EdgePair& pair) const {
    const geometry::ImagePair& both = candidates_->pairs[pair.pair];
    const Edge &e = surfaces_[both.first]->edges()[pair.first], &o = surfaces_[both.second]->edges()[pair.second];
    const int first = firstNode_[both.first], second = firstNode_[both.second];
    return {first + e[0], first + e[1], second + o[0], second + o[1]};
}

void Contacts::markListed(std::span<char> marks) const {
    const auto mark = [&](const std::array<int, 4>& nodes) {
        for (const int n : nodes) marks[static_cast<std::size_t>(n)] = 1;
    };
    for (const NodeRow& row : candidates_->rows)
        for (int n = row.triangles[0]; n < row.triangles[1]; ++n)
            mark(nodesOf(row, candidates_->triangles[static_cast<std::size_t>(n)]));
    for (const EdgePair& pair : candidates_->edgePairs) mark(nodesOf(pair));
}

void Contacts::evaluate(std::span<const Vec3> x) {
    points_.clear(), turnings_.clear(), springs_.clear();
    energy_ = 0;
    virial_.setZero();
    leastGap_ = std::numeric_limits<double>::infinity();
    for (const NodeRow& row : candidates_->rows) addNode(row, x);
    for (const EdgePair& pair : candidates_->edgePairs) addEdges(pair, x);
}

void Contacts::addNode(const NodeRow& row, std::span<const Vec3> x) {
    places_.clear();
    addTriangles(row, x);
    if (places_.empty()) return;  // edges and nodes are not nearer than their triangles
    addRims(row, x);
    const Surface &own = *surfaces_[row.own], &target = *surfaces_[row.target];
    const double share = nodeShare * target.meanNodeArea() / (own.meanNodeArea() + target.meanNodeArea());
    const double area = share * own.nodeArea()[row.node - firstNode_[row.own]];
    for (const Place& place : places_)
        if (place.coefficient != 0) addPoint(place.nodes, place.gap, area * place.coefficient);
}

void Contacts::addTriangles(const NodeRow& row, std::span<const Vec3> x) {
    const Surface& target = *surfaces_[row.target];
    const Vec3 at = x[row.node] + row.offset;
    for (int n = row.triangles[0]; n < row.triangles[1]; ++n) {
        const int number = candidates_->triangles[n];
        const std::array<int, 4> nodes = nodesOf(row, number);
        const Gap gap = nodeToTriangle(at, x[nodes[1]], x[nodes[2]], x[nodes[3]]);
        leastGap_ = std::min(leastGap_, gap.distance - law_->thickness);
        if (gap.distance >= law_->range()) continue;
        const std::array<bool, 3> counts{gap.weights[1] != 0, gap.weights[2] != 0, gap.weights[3] != 0};
        const int corners = counts[0] + counts[1] + counts[2];
        if (corners == 3) {
            addPlace(onTriangle, number, 1, nodes, gap);
        } else if (corners == 2) {  // on the side opposite to the corner with weight 0
            const std::size_t without = !counts[0] ? 0 : !counts[1] ? 1 : 2;
            addPlace(onEdge, target.sides()[number][(without + 1) % 3], 1, nodes, gap);
        } else {
            const std::size_t corner = counts[0] ? 0 : counts[1] ? 1 : 2;
            addPlace(onNode, target.triangles()[number][corner], 1, nodes, gap);
        }
    }
}

// Adds the edges and nodes of the triangles, with their coefficients.
void Contacts::addRims(const NodeRow& row, std::span<const Vec3> x) {
    const Surface& target = *surfaces_[row.target];
    const int first = firstNode_[row.target];
    const Vec3 at = x[row.node] + row.offset;
    for (int n = row.edges[0]; n < row.edges[1]; ++n) {
        const int number = candidates_->edges[n];
        const Edge& edge = target.edges()[number];
        const std::array<int, 4> nodes{row.node, first + edge[0], first + edge[1], row.node};
        const Gap gap = nodeToEdge(at, x[nodes[1]], x[nodes[2]]);
        if (gap.distance >= law_->range()) continue;
        const bool inside = gap.weights[1] != 0 && gap.weights[2] != 0;
        const int end = gap.weights[1] != 0 ? edge[0] : edge[1];
        addPlace(inside ? onEdge : onNode, inside ? number : end, target.edgeCoefficient()[number], nodes, gap);
    }
    for (int n = row.nodes[0]; n < row.nodes[1]; ++n) {
        const int number = candidates_->nodes[n];
        const Gap gap = nodeToNode(at, x[first + number]);
        if (gap.distance >= law_->range()) continue;
        addPlace(onNode, number, target.nodeCoefficient()[number], {row.node, first + number, row.node, row.node}, gap);
    }
}

void Contacts::addPlace(int kind, int number, int coefficient, const std::array<int, 4>& nodes, const Gap& gap) {
    for (Place& place : places_)
        if (place.kind == kind && place.number == number) {
            place.coefficient += coefficient;
            return;
        }
    places_.push_back({kind, number, coefficient, nodes, gap});
}

void Contacts::addPoint(const std::array<int, 4>& nodes, const Gap& gap, double weight) {
    const ContactLaw::Value psi = law_->at(gap.distance - law_->thickness);
    points_.push_back({nodes, gap, weight, psi});
    energy_ += weight * psi.energy;
    virial_ -= (weight * psi.slope * gap.distance) * gap.normal * gap.normal.transpose();
    if (const double c = weight * psi.curvature; c > 0) springs_.push_back({nodes, gap.weights, gap.normal, c});
}

void Contacts::addEdges(const EdgePair& pair, std::span<const Vec3> x) {
    const geometry::ImagePair& both = candidates_->pairs[pair.pair];
    const std::array<int, 4> nodes = nodesOf(pair);
    const FourNodes at{x[nodes[0]] - both.shift, x[nodes[1]] - both.shift, x[nodes[2]], x[nodes[3]]};
    const CrossingFactor m = crossingFactor(at[0], at[1], at[2], at[3]);
    if (!(m.value > 0)) return;  // such contacts are covered by nodes near triangles
    const Gap gap = edgeToEdge(at[0], at[1], at[2], at[3]);
    leastGap_ = std::min(leastGap_, gap.distance - law_->thickness);
    if (gap.distance >= law_->range()) return;
    const double width =
        std::min(surfaces_[both.first]->edgeWidth()[pair.first], surfaces_[both.second]->edgeWidth()[pair.second]);
    const double weight = edgeShare / crossingMean * width * width;
    addPoint(nodes, gap, weight * m.value);
    Turning turning{nodes, {}};
    for (std::size_t k = 0; k < 4; ++k) {
        turning.force[k] = -weight * points_.back().psi.energy * m.slope[k];
        virial_ += at[k] * turning.force[k].transpose();
    }
    turnings_.push_back(turning);
}

void Contacts::addForces(std::span<Vec3> f) const {
    for (const Point& point : points_) {
        const Vec3 force = -(point.weight * point.psi.slope) * point.gap.normal;
        for (std::size_t k = 0; k < 4; ++k) f[point.nodes[k]] += point.gap.weights[k] * force;
    }
    for (const Turning& turning : turnings_)
        for (std::size_t k = 0; k < 4; ++k) f[turning.nodes[k]] += turning.force[k];
}

void Contacts::addStiffness(double factor, std::span<const Vec3> u, std::span<Vec3> f) const {
    for (const Spring& spring : springs_) {
        double stretch = 0;
        for (std::size_t k = 0; k < 4; ++k) stretch += spring.weights[k] * spring.normal.dot(u[spring.nodes[k]]);
        const Vec3 force = (factor * spring.stiffness * stretch) * spring.normal;
        for (std::size_t k = 0; k < 4; ++k) f[spring.nodes[k]] += spring.weights[k] * force;
    }
}

double Contacts::freeTravel(std::span<const Vec3> x, std::span<const Vec3> u, double share, double seconds) const {
    if (!covers(x)) return 0;
    const std::vector<Vec3> d = since(x);
    double free = 1;
    const auto limit = [&](double expected, double before, double more) {
        const double room = (1 - share) * law_->reach() + expected - before;
        if (more * free > room) free = room / more;
    };
    limit(expectedOfOthers_, 2 * longest(d), 2 * longest(u) + seconds * slide_);
    const std::vector<Motion> before = motionsOf(d), more = motionsOf(u);
    for (std::size_t p = 0; p < expected_.size(); ++p)
        limit(expected_[p], approach(candidates_->pairs[p], before, 0, candidates_->within[p]),
              approach(candidates_->pairs[p], more, seconds, candidates_->within[p]));
    const Keep keep{law_->thickness, share};
    const auto pick = [](std::span<const Vec3> all, const std::array<int, 4>& nodes) {
        return FourNodes{all[nodes[0]], all[nodes[1]], all[nodes[2]], all[nodes[3]]};
    };
    for (const NodeRow& row : candidates_->rows)
        for (int n = row.triangles[0]; n < row.triangles[1]; ++n) {
            const std::array<int, 4> nodes = nodesOf(row, candidates_->triangles[n]);
            FourNodes at = pick(x, nodes), way = pick(u, nodes);
            at[0] += row.offset, way[0] += seconds * row.slide;
            free = nodeTriangleTravel(at, way, keep, free);
        }
    for (const EdgePair& pair : candidates_->edgePairs) {
        const std::array<int, 4> nodes = nodesOf(pair);
        const geometry::ImagePair& image = candidates_->pairs[pair.pair];
        FourNodes at = pick(x, nodes), way = pick(u, nodes);
        for (std::size_t k = 0; k < 2; ++k) at[k] -= image.shift, way[k] -= seconds * image.slide;
        free = edgeEdgeTravel(at, way, keep, free);
    }
    return free;
}

}  // namespace corpuscle::contact
