#include "observers/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/communicator.hpp"
#include "core/units.hpp"
#include "observers/cells.hpp"

namespace corpuscle::observers {

using sph::Budget;

namespace {

Budget::Values summed(const Scene& scene) {
    const Budget::Values& own = scene.budget.total;
    return Communicator(scene.system->comm()).sum(own);
}

void add(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), v.data(), v.data() + 3); }
std::vector<double> numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

BudgetTable::BudgetTable(const Scene& scene)
    : parts_(SceneParts::of(scene)), start_(contentOf(scene)), before_(summed(scene)) {}

BudgetTable::Content BudgetTable::contentOf(const Scene& scene) {
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
            angular +=
                spin + body.solid.mass *
                           scene.system->periodicity().shortest(body.state.centre - box.middle()).cross(motion.linear);
        }
    std::copy_n(momentum.data(), 3, c.momentum), std::copy_n(angular.data(), 3, c.angular);
    const auto own = std::bit_cast<Numbers>(c);
    c = contentFrom(ranks.sum(std::vector<double>(own.begin(), own.end())));
    if (scene.cells.exist())
        for (const auto& cell :
             ofEachCell(scene, 1, [](const coupling::Cell&held, double*out) { *out = held.membrane.energy(); }))
            c.elastic += cell[0];
    if (scene.contacts) c.elastic += ranks.sum(scene.contacts->energy(scene.cells, *scene.system));
    return c;
}

BudgetTable::Content BudgetTable::contentFrom(std::span<const double> numbers) {
    Numbers own;
    std::copy_n(numbers.begin(), contentLength, own.begin());
    return std::bit_cast<Content>(own);
}

BudgetTable::Balance BudgetTable::balance(const Scene& scene) const {
    const Content now = contentOf(scene);
    Balance b{};
    b.work = summed(scene);
    for (std::size_t k = 0; k < b.work.size(); ++k) b.work[k] -= before_[k];
    const Budget::Values& w = b.work;
    b.elastic = now.elastic - start_.elastic, b.compression = now.compression - start_.compression,
    b.kinetic = now.kinetic - start_.kinetic;
    b.dissipated = w[Budget::viscous] + w[Budget::inMembranes];
    const double given = w[Budget::ofWalls] + w[Budget::ofBodyForce] + w[Budget::ofBodies] + w[Budget::ofImages];
    b.residual = given - b.dissipated - w[Budget::released] - b.elastic - b.compression - b.kinetic;
    b.ofInertia = w[Budget::kinetic] - b.kinetic;
    b.ofMembranes = w[Budget::elastic] - w[Budget::released] - b.elastic;
    b.ofCompression = w[Budget::compression] - b.compression;
    b.ofSolver = w[Budget::ofSolver];
    const double largest = std::max({std::abs(given), std::abs(w[Budget::ofWalls]), std::abs(w[Budget::ofBodyForce]),
                                     std::abs(w[Budget::ofBodies]), std::abs(w[Budget::ofImages]),
                                     std::abs(b.dissipated), std::abs(b.elastic), std::abs(b.kinetic)});
    b.share = largest > 0 ? std::abs(b.residual) / largest : 0;

    b.momentum = Vec3::Map(now.momentum) - Vec3::Map(start_.momentum);
    b.angular = Vec3::Map(now.angular) - Vec3::Map(start_.angular);
    const Vec3 force = Budget::vector(w, Budget::bodyForce), bodies = Budget::vector(w, Budget::givenBodies),
               images = Budget::vector(w, Budget::images);
    b.drift = b.momentum;
    double byWalls = 0;
    for (std::size_t n = 0; n < parts_.walls.size(); ++n) {
        const Vec3 impulse = Budget::vector(w, Budget::wall(n));
        b.drift -= impulse;
        byWalls += impulse.norm();
    }
    b.drift = b.drift - force - bodies - images;
    const double exchanged = std::max({byWalls, force.norm(), bodies.norm(), now.speeds, start_.speeds});
    b.driftShare = exchanged > 0 ? b.drift.norm() / exchanged : 0;
    b.mass = now.mass / start_.mass - 1, b.volume = now.volume / start_.volume - 1;
    return b;
}

std::vector<io::Column> BudgetTable::columns(const SceneParts& parts) {
    std::vector<io::Column> columns;
    const auto joules = [&](const std::string& name, const std::string& meaning) {
        columns.push_back({name, "J", meaning});
    };
    const bool cells = !parts.cells.empty();
    if (!parts.walls.empty()) joules("workOfWalls", "energy put in by the walls since the start");
    if (parts.bodyForce) joules("workOfBodyForce", "energy put in by the body force since the start");
    if (parts.givenBodies) joules("workOfBodies", "energy put in by bodies whose motion is given, since the start");
    if (parts.slidingImages)
        joules("workOfImages", "energy put in by images that slide past each other, since the start");
    joules("dissipated", "energy dissipated by viscosity since the start, all of it");
    if (parts.viscousMembranes)
        joules("dissipatedInMembranes", "of that, by the viscosity of the membranes themselves");
    if (cells) joules("stored", "change of the membranes' elastic energy");
    if (parts.rupture) joules("released", "elastic energy that was in bonds and triangles as they broke");
    joules("compressed", "change of the energy of compression");
    joules("kineticEnergy", "change of the kinetic energy");
    joules("residual", "put in - dissipated - stored - released - compressed - kinetic");
    columns.push_back({"residualShare", "", "the residual's size over that of the largest entry"});
    joules("residualOfInertia", "part of the residual: kinetic energy as the steps change it less that of the state");
    if (cells) joules("residualOfMembranes", "part of the residual: the same of the elastic energy");
    joules("residualOfCompression", "part of the residual: the same of the energy of compression");
    joules("residualOfSolver", "part of the residual: what the linear solver leaves");
    addVector(columns, "momentum", "Ns", "component of the change of momentum");
    for (const std::string& wall : parts.walls)
        addVector(columns, "impulseOfWall_" + wall, "Ns",
                  "component of the time integral of the force of the " + wall + " wall");
    if (parts.bodyForce)
        addVector(columns, "impulseOfBodyForce", "Ns", "component of the time integral of the body force");
    if (parts.givenBodies)
        addVector(columns, "impulseOfBodies", "Ns", "component of the time integral of the force of given bodies");
    if (parts.slidingImages)
        addVector(columns, "impulseOfImages", "Ns", "component of what particles gain at faces whose images slide");
    addVector(columns, "momentumDrift", "Ns", "component of the change of momentum that no force explains");
    addVector(columns, "angularMomentum", "Js", "component of the change of angular momentum about the box's middle");
    if (!parts.walls.empty())
        addVector(columns, "angularImpulseOfWalls", "Js", "component of the time integral of the walls' torque");
    if (parts.bodyForce)
        addVector(columns, "angularImpulseOfBodyForce", "Js",
                  "component of the time integral of the body force's torque");
    columns.push_back({"massChange", "", "relative change of the mass of all that moves"});
    columns.push_back({"volumeChange", "", "relative change of sum m/rho of fluid and nodes"});
    return columns;
}

std::vector<double> BudgetTable::row(const Scene& scene) const {
    const Balance b = balance(scene);
    const Budget::Values& w = b.work;
    const bool walls = !parts_.walls.empty(), force = parts_.bodyForce, bodies = parts_.givenBodies,
               cells = !parts_.cells.empty();
    std::vector<double> row;
    if (walls) row.push_back(w[Budget::ofWalls]);
    if (force) row.push_back(w[Budget::ofBodyForce]);
    if (bodies) row.push_back(w[Budget::ofBodies]);
    if (parts_.slidingImages) row.push_back(w[Budget::ofImages]);
    row.push_back(b.dissipated);
    if (parts_.viscousMembranes) row.push_back(w[Budget::inMembranes]);
    if (cells) row.push_back(b.elastic);
    if (parts_.rupture) row.push_back(w[Budget::released]);
    row.insert(row.end(), {b.compression, b.kinetic, b.residual, b.share, b.ofInertia});
    if (cells) row.push_back(b.ofMembranes);
    row.push_back(b.ofCompression), row.push_back(b.ofSolver);
    add(row, b.momentum);
    for (std::size_t n = 0; n < parts_.walls.size(); ++n) add(row, Budget::vector(w, Budget::wall(n)));
    if (force) add(row, Budget::vector(w, Budget::bodyForce));
    if (bodies) add(row, Budget::vector(w, Budget::givenBodies));
    if (parts_.slidingImages) add(row, Budget::vector(w, Budget::images));
    add(row, b.drift);
    add(row, b.angular);
    if (walls) add(row, Budget::vector(w, Budget::wallTorque));
    if (force) add(row, Budget::vector(w, Budget::forceTorque));
    row.push_back(b.mass), row.push_back(b.volume);
    return row;
}

Summary BudgetTable::summary(const Scene& scene) const {
    const Balance b = balance(scene);
    const Budget::Values& w = b.work;
    const std::vector<double> values = row(scene);
    Summary summary;
    const std::vector<io::Column> names = columns(parts_);
    for (std::size_t k = 0; k < names.size(); ++k)
        if (names[k].unit == "J" || names[k].unit.empty()) summary.figures[names[k].header()] = values[k];
    summary.figures["momentumDrift_Ns"] = numbers(b.drift);
    summary.figures["momentumDriftShare"] = b.driftShare;
    const auto joule = [](double value) { return formatQuantity(value, unit::joule); };
    std::string given;
    if (!parts_.walls.empty()) given += "walls put in " + joule(w[Budget::ofWalls]) + ", ";
    if (parts_.bodyForce) given += "the body force " + joule(w[Budget::ofBodyForce]) + ", ";
    if (parts_.givenBodies) given += "bodies of given motion " + joule(w[Budget::ofBodies]) + ", ";
    if (parts_.slidingImages) given += "sliding images " + joule(w[Budget::ofImages]) + ", ";
    if (!parts_.cells.empty()) given += "stored in membranes " + joule(b.elastic) + ", ";
    summary.lines.push_back(
        fmt::format("energy budget: {}dissipated {}, kinetic {}, compression {}; closes to {:.2g} %", given,
                    joule(b.dissipated), joule(b.kinetic), joule(b.compression), 100 * b.share));
    summary.lines.push_back(
        fmt::format("momentum drifts by {:.2g} of what is exchanged, mass by {:.2g}, volume (sum of m/rho) by {:.2g}",
                    b.driftShare, b.mass, b.volume));
    if (!parts_.cells.empty()) {
        double worst = 0;
        for (const auto& cell : ofEachCell(scene, 1, [](const coupling::Cell&held, double*out) {
                 *out = held.membrane.volume() / held.initialVolume - 1;
             }))
            worst = std::abs(cell[0]) > std::abs(worst) ? cell[0] : worst;
        summary.figures["largestVolumeChangeOfCells"] = worst;
        summary.lines.push_back(fmt::format("volumes of cells change by {:.2g} at most", worst));
    }
    return summary;
}

std::vector<double> BudgetTable::state() const {
    const auto own = std::bit_cast<Numbers>(start_);
    std::vector<double> all(own.begin(), own.end());
    all.insert(all.end(), before_.begin(), before_.end());
    return all;
}

void BudgetTable::setState(std::span<const double> saved) {
    start_ = contentFrom(saved);
    std::copy(saved.begin() + contentLength, saved.end(), before_.begin());
}

}  // namespace corpuscle::observers
