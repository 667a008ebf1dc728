#include "observers/account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/communicator.hpp"
#include "core/units.hpp"
#include "observers/cells.hpp"

namespace corpuscle::observers {

using sph::Account;

namespace {

bool anyViscous(const Scene& scene) {
    return std::any_of(scene.cells.begin(), scene.cells.end(),
                       [](const coupling::Cell& cell) { return cell.membrane.isViscous(); });
}
bool anyRupture(const Scene& scene) {
    return std::any_of(scene.cells.begin(), scene.cells.end(),
                       [](const coupling::Cell& cell) { return cell.membrane.canRupture(); });
}
bool anyGivenBody(const Scene& scene) {
    return scene.bodies && std::any_of(scene.bodies->all().begin(), scene.bodies->all().end(),
                                       [](const bodies::Body& body) { return !body.behaviour->yields(); });
}
bool hasBodyForce(const Scene& scene) { return !scene.model().bodyForce.isZero(); }

Account::Values summed(const Scene& scene) {
    const Account::Values& own = scene.account.total;
    const std::vector<double> all = Communicator(scene.system->comm()).sum(std::vector<double>(own.begin(), own.end()));
    Account::Values values;
    std::copy(all.begin(), all.end(), values.begin());
    return values;
}

void addVector(std::vector<io::Column>& columns, const std::string& name, const std::string& unit) {
    for (const char* component : {"_x", "_y", "_z"}) columns.push_back({name + component, unit});
}
void add(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), v.data(), v.data() + 3); }
std::vector<double> numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

AccountBook::AccountBook(const Scene& scene) : start_(contentOf(scene)), before_(summed(scene)) {}

AccountBook::Content AccountBook::contentOf(const Scene& scene) {
    const Communicator ranks(scene.system->comm());
    const particles::ParticleStore& s = scene.store();
    const sph::FluidModel& model = scene.model();
    const particles::Box& box = scene.system->box();
    Content c;
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double mass = scene.mass(i);
        c.compression += mass * model.equationOfState->energy(s.density[i], model.density, model.soundSpeed);
        if (particles::isBoundary(s.kindOf(i))) continue;
        const Vec3 u = s.velocity(i);
        c.kinetic += 0.5 * mass * u.squaredNorm();
        c.mass += mass, c.volume += mass / s.density[i], c.speeds += mass * u.norm();
        momentum += mass * u;
        angular += mass * (s.position(i) - box.middle()).cross(u);
    }
    if (scene.bodies && ranks.isRoot())
        for (const bodies::Body& body : scene.bodies->all()) {
            if (!body.behaviour->yields()) continue;
            const bodies::RigidMotion& motion = body.state.motion;
            const Vec3 spin = body.state.angularMomentum(body.solid);
            c.kinetic += 0.5 * (body.solid.mass * motion.linear.squaredNorm() + motion.angular.dot(spin));
            c.mass += body.solid.mass, c.speeds += body.solid.mass * motion.linear.norm();
            momentum += body.solid.mass * motion.linear;
            angular += spin + body.solid.mass * box.minimumImage(body.state.centre - box.middle()).cross(motion.linear);
        }
    std::copy_n(momentum.data(), 3, c.momentum), std::copy_n(angular.data(), 3, c.angular);
    const auto own = std::bit_cast<Numbers>(c);
    c = contentFrom(ranks.sum(std::vector<double>(own.begin(), own.end())));
    if (!scene.cells.empty())
        for (const auto& cell : ofEachCell(
                 scene, 1, [](const coupling::Cell&held, std::size_t, double*out) { *out = held.membrane.energy(); }))
            c.elastic += cell[0];
    return c;
}

AccountBook::Content AccountBook::contentFrom(std::span<const double> numbers) {
    Numbers own;
    std::copy_n(numbers.begin(), contentLength, own.begin());
    return std::bit_cast<Content>(own);
}

AccountBook::Balance AccountBook::balance(const Scene& scene) const {
    const Content now = contentOf(scene);
    Balance b{};
    b.work = summed(scene);
    for (std::size_t k = 0; k < Account::count; ++k) b.work[k] -= before_[k];
    const Account::Values& w = b.work;
    b.elastic = now.elastic - start_.elastic, b.compression = now.compression - start_.compression,
    b.kinetic = now.kinetic - start_.kinetic;
    b.dissipated = w[Account::viscous] + w[Account::inMembranes];
    const double given = w[Account::ofWalls] + w[Account::ofBodyForce] + w[Account::ofBodies];
    b.residual = given - b.dissipated - w[Account::released] - b.elastic - b.compression - b.kinetic;
    b.ofInertia = w[Account::kinetic] - b.kinetic;
    b.ofMembranes = w[Account::elastic] - w[Account::released] - b.elastic;
    b.ofCompression = w[Account::compression] - b.compression;
    b.ofSolver = w[Account::ofSolver];
    const double largest =
        std::max({std::abs(given), std::abs(w[Account::ofWalls]), std::abs(w[Account::ofBodyForce]),
                  std::abs(w[Account::ofBodies]), std::abs(b.dissipated), std::abs(b.elastic), std::abs(b.kinetic)});
    b.share = largest > 0 ? std::abs(b.residual) / largest : 0;

    b.momentum = Vec3::Map(now.momentum) - Vec3::Map(start_.momentum);
    b.angular = Vec3::Map(now.angular) - Vec3::Map(start_.angular);
    const Vec3 lower = Account::vector(w, Account::lowerWall), upper = Account::vector(w, Account::upperWall),
               force = Account::vector(w, Account::bodyForce), bodies = Account::vector(w, Account::givenBodies);
    b.drift = b.momentum - lower - upper - force - bodies;
    const double exchanged =
        std::max({lower.norm() + upper.norm(), force.norm(), bodies.norm(), now.speeds, start_.speeds});
    b.driftShare = exchanged > 0 ? b.drift.norm() / exchanged : 0;
    b.mass = now.mass / start_.mass - 1, b.volume = now.volume / start_.volume - 1;
    return b;
}

std::vector<io::Column> AccountBook::columns(const Scene& scene) {
    std::vector<io::Column> columns;
    if (scene.flow.walls.exist()) columns.push_back({"workOfWalls", "J"});
    if (hasBodyForce(scene)) columns.push_back({"workOfBodyForce", "J"});
    if (anyGivenBody(scene)) columns.push_back({"workOfBodies", "J"});
    columns.push_back({"dissipated", "J"});
    if (anyViscous(scene)) columns.push_back({"dissipatedInMembranes", "J"});
    if (!scene.cells.empty()) columns.push_back({"stored", "J"});
    if (anyRupture(scene)) columns.push_back({"released", "J"});
    for (const char* name : {"compressed", "kineticEnergy", "residual"}) columns.push_back({name, "J"});
    columns.push_back({"residualShare", ""});
    columns.push_back({"residualOfInertia", "J"});
    if (!scene.cells.empty()) columns.push_back({"residualOfMembranes", "J"});
    columns.push_back({"residualOfCompression", "J"}), columns.push_back({"residualOfSolver", "J"});
    addVector(columns, "momentum", "Ns");
    if (scene.flow.walls.exist())
        addVector(columns, "impulseOfLowerWall", "Ns"), addVector(columns, "impulseOfUpperWall", "Ns");
    if (hasBodyForce(scene)) addVector(columns, "impulseOfBodyForce", "Ns");
    if (anyGivenBody(scene)) addVector(columns, "impulseOfBodies", "Ns");
    addVector(columns, "momentumDrift", "Ns");
    addVector(columns, "angularMomentum", "Js");
    if (scene.flow.walls.exist()) addVector(columns, "angularImpulseOfWalls", "Js");
    if (hasBodyForce(scene)) addVector(columns, "angularImpulseOfBodyForce", "Js");
    columns.push_back({"massChange", ""}), columns.push_back({"volumeChange", ""});
    return columns;
}

std::vector<double> AccountBook::row(const Scene& scene) const {
    const Balance b = balance(scene);
    const Account::Values& w = b.work;
    const bool walls = scene.flow.walls.exist(), force = hasBodyForce(scene), bodies = anyGivenBody(scene);
    std::vector<double> row;
    if (walls) row.push_back(w[Account::ofWalls]);
    if (force) row.push_back(w[Account::ofBodyForce]);
    if (bodies) row.push_back(w[Account::ofBodies]);
    row.push_back(b.dissipated);
    if (anyViscous(scene)) row.push_back(w[Account::inMembranes]);
    if (!scene.cells.empty()) row.push_back(b.elastic);
    if (anyRupture(scene)) row.push_back(w[Account::released]);
    row.insert(row.end(), {b.compression, b.kinetic, b.residual, b.share, b.ofInertia});
    if (!scene.cells.empty()) row.push_back(b.ofMembranes);
    row.push_back(b.ofCompression), row.push_back(b.ofSolver);
    add(row, b.momentum);
    if (walls) add(row, Account::vector(w, Account::lowerWall)), add(row, Account::vector(w, Account::upperWall));
    if (force) add(row, Account::vector(w, Account::bodyForce));
    if (bodies) add(row, Account::vector(w, Account::givenBodies));
    add(row, b.drift);
    add(row, b.angular);
    if (walls) add(row, Account::vector(w, Account::wallTorque));
    if (force) add(row, Account::vector(w, Account::forceTorque));
    row.push_back(b.mass), row.push_back(b.volume);
    return row;
}

Summary AccountBook::summary(const Scene& scene) const {
    const Balance b = balance(scene);
    const Account::Values& w = b.work;
    const std::vector<double> values = row(scene);
    Summary summary;
    const std::vector<io::Column> names = columns(scene);
    for (std::size_t k = 0; k < names.size(); ++k)
        if (names[k].unit == "J" || names[k].unit.empty()) summary.figures[names[k].header()] = values[k];
    summary.figures["momentumDrift_Ns"] = numbers(b.drift);
    summary.figures["momentumDriftShare"] = b.driftShare;
    const auto joule = [](double value) { return formatQuantity(value, unit::joule); };
    std::string given;
    if (scene.flow.walls.exist()) given += "walls put in " + joule(w[Account::ofWalls]) + ", ";
    if (hasBodyForce(scene)) given += "the body force " + joule(w[Account::ofBodyForce]) + ", ";
    if (anyGivenBody(scene)) given += "bodies of given motion " + joule(w[Account::ofBodies]) + ", ";
    if (!scene.cells.empty()) given += "stored in membranes " + joule(b.elastic) + ", ";
    summary.lines.push_back(
        fmt::format("energy account: {}dissipated {}, kinetic {}, compression {}; closes to {:.2g} %", given,
                    joule(b.dissipated), joule(b.kinetic), joule(b.compression), 100 * b.share));
    summary.lines.push_back(
        fmt::format("momentum drifts by {:.2g} of what is exchanged, mass by {:.2g}, volume (sum of m/rho) by {:.2g}",
                    b.driftShare, b.mass, b.volume));
    if (!scene.cells.empty()) {
        double worst = 0;
        for (const auto& cell : ofEachCell(scene, 1, [](const coupling::Cell&held, std::size_t, double*out) {
                 *out = held.membrane.volume() / held.initialVolume - 1;
             }))
            worst = std::abs(cell[0]) > std::abs(worst) ? cell[0] : worst;
        summary.figures["largestVolumeChangeOfCells"] = worst;
        summary.lines.push_back(fmt::format("volumes of cells change by {:.2g} at most", worst));
    }
    return summary;
}

std::vector<double> AccountBook::state() const {
    const auto own = std::bit_cast<Numbers>(start_);
    std::vector<double> all(own.begin(), own.end());
    all.insert(all.end(), before_.begin(), before_.end());
    return all;
}

void AccountBook::setState(std::span<const double> saved) {
    start_ = contentFrom(saved);
    std::copy(saved.begin() + contentLength, saved.end(), before_.begin());
}

}  // namespace corpuscle::observers
