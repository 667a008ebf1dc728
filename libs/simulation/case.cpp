#include "simulation/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/cell.hpp"
#include "schemes/cost.hpp"
#include "simulation/caseFiles.hpp"
#include "simulation/caseRules.hpp"
#include "simulation/foreignKeys.hpp"
#include "simulation/placesTable.hpp"
#include "simulation/readyCell.hpp"

namespace corpuscle::simulation {

namespace {

constexpr const char *controlFile = "system/control.yaml", *observersFile = "system/observers.yaml";

template <class T>
T readNode(const std::string& file, Case& result, Problems& problems) {
    const std::size_t before = problems.count();
    T settings = read<T>(result.files.at(file), problems);
    if (problems.count() == before) result.effective.emplace_back(file, write(settings));
    return settings;
}

template <class T>
T readFile(const Application& app, const std::string& file, Case& result, Problems& problems) {
    const std::size_t before = problems.count();
    result.files[file] = app.dictionary(file, problems);
    if (problems.count() != before) return T{};  // the file itself is missing or malformed
    return readNode<T>(file, result, problems);
}

// Reports each cell without a shape and gives it a dummy shape, so that everything else is read too.
void requireShapes(Node& mesh, Problems& problems) {
    Node* const cells = mesh.find("cells");
    if (!cells) return;
    for (Node& cell : cells->items) {
        if (cell.kind != Node::Kind::table || cell.find("shape") || cell.find("cell")) continue;
        const bool isMisspelt = std::any_of(cell.entries.begin(), cell.entries.end(), [](const Node::Entry& entry) {
            return !nearestWord(entry.key, {"shape", "cell"}).empty();
        });
        if (!isMisspelt)
            problems.add(cell.place(), cell.path + ".shape",
                         "missing: shape of the cell. Expected a model of the family shape, for example 'shape: {type: "
                         "sphere, radius: 4 um}', or a ready cell in its place, for example 'cell: healthyRBC'");
        Problems none;
        Node any = parseValue("{type: sphere, radius: 1 um}", cell.mark.file, none);
        any.setPath(cell.path + ".shape");
        cell.entries.emplace_back("shape", std::move(any));
    }
}

// Reads the cells and their membranes: two files together, since a ready cell contributes to both.
void readCells(const Application& app, const std::set<std::string>& misnamed, Case& c, Problems& problems) {
    if (misnamed.contains("system/mesh.yaml")) return;
    const std::size_t before = problems.count();
    Node& mesh = c.files["system/mesh.yaml"] = app.dictionary("system/mesh.yaml", problems);
    const std::size_t inMesh = problems.count() - before;
    const bool areReady = namesReadyCells(mesh);
    const bool hasLaws = app.hasDictionary("constant/membranes.yaml");
    Node laws = hasLaws ? app.dictionary("constant/membranes.yaml", problems) : Node();
    const std::size_t inLaws = problems.count() - before - inMesh;
    if (inMesh + inLaws == 0 && areReady) insertReadyCells(app, mesh, laws, problems);
    const std::size_t inReady = problems.count() - before - inMesh - inLaws;
    if (inMesh == 0) requireShapes(mesh, problems);
    if (inMesh + inReady == 0) c.mesh = readNode<MeshSettings>("system/mesh.yaml", c, problems);
    if (!hasLaws && !areReady) {
        if (!c.mesh.cells.empty() && !misnamed.contains("constant/membranes.yaml"))
            app.dictionary("constant/membranes.yaml", problems);  // adds the problem that it is missing
        return;
    }
    c.files["constant/membranes.yaml"] = std::move(laws);
    if (inLaws + inReady == 0) c.membranes = readNode<MembranesSettings>("constant/membranes.yaml", c, problems);
}

// Location of a key in its file, or of the innermost table around it that the file contains.
const Mark& placeOf(const Node& node, const std::string& key) {
    const auto holds = [&](const Node& child) {
        const std::size_t n = child.path.size();
        return key.starts_with(child.path) && (key.size() == n || key[n] == '.' || key[n] == '[');
    };
    for (const auto& [name, child] : node.entries)
        if (holds(child)) return placeOf(child, key);
    for (const Node& child : node.items)
        if (holds(child)) return placeOf(child, key);
    return node.isNothing() ? node.place() : node.mark;
}

constexpr double adjointBulk = 500;  // bulk modulus of adjoint operators in units of mu gammadot

// Adjoint operators conserve volumes exactly, so the membrane's stiffness does not enter.
double adjointSoundSpeed(const Case& c) {
    const sph::FlowState& flow = c.flow;
    const double nu = c.viscosities().largest / flow.density;
    return std::sqrt(std::max(
        {100 * flow.speed * flow.speed, adjointBulk * nu * flow.rate, 100 * flow.largestForce() * flow.length}));
}

double plainSoundSpeed(const Case& c) {
    const sph::FlowState& flow = c.flow;
    const double nu = c.viscosities().largest / flow.density;
    double length = flow.length, square = flow.speed * flow.speed;
    for (const CellSettings& cell : c.mesh.cells) {
        const double a = cell.shape->radius();
        length = std::min(length, a);
        square = std::max(square, c.membraneOf(cell).moduli(cell.edge).shear / (flow.density * a));
    }
    double speed = flow.speed;
    for (const BodyPlaceSettings& body : c.mesh.bodies) {
        const double a = body.shape->radius();
        length = std::min(length, a);
        speed = std::max(speed, c.bodyOf(body).motion->speed(a));
    }
    square = std::max({square, speed * speed, nu * speed / length, flow.largestForce() * flow.length});
    return 10 * std::sqrt(square);
}

// M^-1 K (a rate squared) of a hexagonal network of nodes on the stiffest membrane [1/s^2]: 6 k/m, with bonds of
// stiffness k = (Gs + Ks) 4/(3 sqrt(3)) and, as mass m of a node, that of its hexagon, one spacing thick. Bending is
// neglected.
double springRate2(const Case& c) {
    double most = 0;
    for (const CellSettings& cell : c.mesh.cells) {
        const membrane::SurfaceModuli moduli = c.membraneOf(cell).moduli(cell.edge);
        const double bond = (moduli.shear + moduli.area) * 4 / (3 * std::numbers::sqrt3),
                     mass = c.flow.density * c.spacing() * std::numbers::sqrt3 / 2 * cell.edge * cell.edge;
        most = std::max(most, 6 * bond / mass);
    }
    return most;
}

// If the key is absent: 0.1 with immersed membranes, in three-dimensional flows, and with rigid bodies if images slide
// (spheres that pass each other stretch the fluid between them); 0 otherwise. Reason: where the flow stretches a
// perfect lattice, its planes separate until all neighbours of a particle lie in one plane. Shifting, which follows
// gradients, does not detect this, because every particle has its mirror image.
double jitterOf(const Case& c) {
    constexpr double usual = 0.1;
    const bool disordered = c.flowModel->isThreeDimensional() || (c.numerics.isImmersed() && !c.mesh.cells.empty()) ||
                            (c.flowModel->slides() && !c.mesh.bodies.empty());
    return c.mesh.fill.jitter.value_or(disordered ? usual : 0);
}

}  // namespace

// Rules between files give only a file and a key; line and column are found here, in the dictionary.
void Case::throwIfAny(const Problems& problems) const {
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        Problems placed;
        for (const Problem& p : error.problems()) {
            const auto file = files.find(p.mark.file);
            placed.add(p.mark.line == 0 && file != files.end() ? placeOf(file->second, p.key) : p.mark, p.key,
                       p.message);
        }
        placed.addUncounted(error.more());
        placed.throwIfAny();
    }
}

namespace {

// Reads all files by their declared settings; throws all problems together.
void readFiles(const Application& app, Case& c, Problems& problems) {
    const std::set<std::string> misnamed = checkFiles(app, problems);
    const auto readInto = [&]<class T>(T& settings, const std::string& file) {
        if (!misnamed.contains(file)) settings = readFile<T>(app, file, c, problems);
    };
    readInto(c.control, controlFile);
    readInto(c.numerics, "system/numerics.yaml");
    readCells(app, misnamed, c, problems);
    readInto(c.fluid, "constant/fluid.yaml");
    if (!c.mesh.bodies.empty() || app.hasDictionary("constant/bodies.yaml")) readInto(c.bodies, "constant/bodies.yaml");
    if (app.hasDictionary("constant/contact.yaml") && !misnamed.contains("constant/contact.yaml"))
        c.contact = readFile<contact::ContactSettings>(app, "constant/contact.yaml", c, problems);
    if (!misnamed.contains("constant/flow.yaml")) {
        const std::size_t before = problems.count();
        const Node& node = c.files["constant/flow.yaml"] = app.dictionary("constant/flow.yaml", problems);
        if (problems.count() == before) c.flowModel = readChoice<sph::Flow>(node, problems);
        if (problems.count() == before) c.effective.emplace_back("constant/flow.yaml", writeChoice(c.flowModel));
    }
    if (app.hasDictionary(observersFile))
        c.observers = readFile<observers::ObserversSettings>(app, observersFile, c, problems);
    throwWithKeysInstead(problems);
}

// Finds the places of the cells of each type.
void findPlaces(Case& c, const std::set<std::string>& unplaced, Problems& problems) {
    for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
        CellTypeSettings& cell = c.mesh.cells[i];
        if (!cell.isPlacedByList()) continue;
        cell.placed.clear();
        for (const PlaceSettings& place : cell.places) cell.placed.push_back({place.centre, place.axis, place.scale});
        if (cell.table && !unplaced.contains(cell.name))
            cell.placed = readPlaces(c.directory, *cell.table, {"system/mesh.yaml", 0, 0},
                                     fmt::format("cells[{}].table", i), problems);
    }
    c.throwIfAny(problems);
}

void prepareSurfaces(Case& c, const std::set<std::string>& unplaced, Problems& problems) {
    findPlaces(c, unplaced, problems);
    const auto resolve = [&](SurfaceSettings& surface) { surface.edge = surface.edgeLength.metres(c.spacing()); };
    std::for_each(c.mesh.cells.begin(), c.mesh.cells.end(), resolve);
    std::for_each(c.mesh.bodies.begin(), c.mesh.bodies.end(), resolve);
    for (const PlacedSurface& surface : surfacesOf(c.mesh)) {
        try {
            surface.settings.shape->prepare(c.directory);
        } catch (const Failure& fault) {
            problems.add({"system/mesh.yaml", 0, 0}, surface.key + ".shape", fault.what());
        }
    }
    if (const boundary::WallShape* const walls = c.flowModel->walls()) {
        try {
            walls->prepare(c.directory);
        } catch (const Failure& fault) {
            problems.add({"constant/flow.yaml", 0, 0}, "walls.file", fault.what());
        }
    }
    if (const sph::Drive* const drive = c.flowModel->drive()) {
        try {
            drive->prepare(c.directory);
        } catch (const Failure& fault) {
            problems.add({"constant/flow.yaml", 0, 0}, "drive.file", fault.what());
        }
    }
    c.throwIfAny(problems);
}

void resolveFlow(Case& c, Problems& problems) {
    sph::FlowContext context{.box = c.fluidBox(),
                             .viscosity = c.fluid.viscosity,
                             .density = c.fluid.density,
                             .layered = !c.fluid.layers.empty(),
                             .leastViscosity = c.viscosities().least};
    if (!c.mesh.cells.empty()) {
        const CellSettings& first = c.mesh.cells.front();
        context.radius = first.shape->radius();
        context.shearModulus = c.membraneOf(first).moduli(first.edge).shear;
    } else if (!c.mesh.bodies.empty()) {
        context.radius = c.mesh.bodies.front().shape->radius();
    }
    c.flow = c.flowModel->resolve(context, {"constant/flow.yaml", 0, 0}, problems);
    c.throwIfAny(problems);
    checkSizes(c, context.shearModulus, problems);
    c.throwIfAny(problems);
    checkIntervals(c, problems);
}

// Resolves automatic keys, now that the flow is known.
void settle(Case& c) {
    const schemes::CaseFacts facts = c.facts();
    c.integratorChosen = c.written.isAutomatic();
    c.numerics =
        schemes::settled(c.written, facts,
                         c.integratorChosen ? schemes::cheapest(predictCosts(c.written, facts)) : c.written.integrator);
    c.mesh.fill.jitter = jitterOf(c);
    for (auto& [file, table] : c.effective)
        if (file == "system/numerics.yaml")
            table = write(c.numerics);
        else if (file == "system/mesh.yaml")
            table = write(c.mesh);
}

void checkObservers(const Case& c, Problems& problems) {
    const auto dictionary = c.files.find(observersFile);
    c.observers.check(dictionary == c.files.end() ? Node{} : dictionary->second,
                      {!c.mesh.cells.empty(), c.planesAcross().has_value(), c.flow.shearRate, !c.mesh.bodies.empty(),
                       c.fluid.solute.has_value(), c.flow.section > 0},
                      problems);
}

}  // namespace

Case Case::read(const Application& app, const std::set<std::string>& unplaced) {
    Problems problems;
    Case c;
    c.directory = app.caseDirectory();
    readFiles(app, c, problems);
    prepareSurfaces(c, unplaced, problems);
    c.written = c.numerics;
    c.numerics = schemes::settled(c.written, c.facts(), c.written.integrator);
    checkTogether(c, problems);
    c.throwIfAny(problems);
    resolveFlow(c, problems);
    settle(c);
    checkObservers(c, problems);
    c.throwIfAny(problems);
    return c;
}

Case Case::withEdits(const Application& app) const {
    Problems problems;
    Case edited;  // the two files alone
    edited.control = readFile<ControlSettings>(app, controlFile, edited, problems);
    if (app.hasDictionary(observersFile))
        edited.observers = readFile<observers::ObserversSettings>(app, observersFile, edited, problems);
    else if (files.contains(observersFile))
        problems.add({observersFile, 0, 0}, "",
                     "the file is gone; its observers go on. To end all of them, write {} in it");
    throwWithKeysInstead(problems);

    Case c = *this;
    c.control = edited.control, c.observers = edited.observers;
    for (auto& [file, node] : edited.files) c.files[file] = std::move(node);
    for (Node::Entry& entry : edited.effective) {
        const auto old = std::find_if(c.effective.begin(), c.effective.end(),
                                      [&](const Node::Entry& one) { return one.key == entry.key; });
        if (old == c.effective.end())
            c.effective.push_back(std::move(entry));
        else
            *old = std::move(entry);
    }
    checkControl(c, problems);
    checkIntervals(c, problems);
    checkObservers(c, problems);
    c.throwIfAny(problems);
    return c;
}

int Case::wallLayers() const {
    return !flowModel->walls() ? 0 : static_cast<int>(std::ceil(support() / spacing() - 1e-9));
}

particles::Box Case::fluidBox() const {
    return {-0.5 * mesh.domain.size, 0.5 * mesh.domain.size, mesh.domain.periodic};
}

particles::Box Case::particleBox() const {
    particles::Box box = fluidBox();
    const Vec3 depth = wallDepth();
    for (int k = 0; k < 3; ++k)
        if (hasWallsAcross(k)) box.low[k] -= depth[k], box.high[k] += depth[k];
    return box;
}

double Case::fluidVolume() const {
    const boundary::WallShape* const walls = flowModel->walls();
    return walls ? walls->volume(fluidBox()) : fluidBox().volume();
}

Vec3 Case::latticeSpacing() const { return mesh.domain.size.array() / (mesh.domain.size / spacing()).array().round(); }

double Case::soundSpeed() const {
    const std::optional<double>& given = fluid.equationOfState->soundSpeed;
    return given ? *given : automaticSoundSpeed();
}

double Case::automaticSoundSpeed() const {
    return scheme().traits().isAdjoint ? adjointSoundSpeed(*this) : plainSoundSpeed(*this);
}

schemes::CaseFacts Case::facts() const {
    schemes::CaseFacts facts;
    facts.hasCells = !mesh.cells.empty(), facts.hasBodies = !mesh.bodies.empty();
    facts.hasContact = contact.has_value() && facts.hasCells;
    facts.slides = flowModel->slides();
    if (const auto file = files.find("system/numerics.yaml"); file != files.end()) facts.written = &file->second;
    const auto [least, largest] = viscosities();
    facts.leastViscosity = least, facts.largestViscosity = facts.mostViscous = largest;
    if (flow.density == 0) return facts;  // not resolved yet
    for (const CellSettings& cell : mesh.cells)
        facts.mostViscous = std::max(facts.mostViscous, fluid.viscosity * membraneOf(cell).interior.viscosityRatio);
    facts.flow = flow;
    facts.springRate2 = springRate2(*this);
    const std::optional<double>& given = fluid.equationOfState->soundSpeed;
    facts.soundSpeed = given.value_or(plainSoundSpeed(*this));
    facts.adjointSoundSpeed = given.value_or(adjointSoundSpeed(*this));
    facts.duration = duration();
    return facts;
}

double Case::duration() const { return control.endTime ? *control.endTime : *control.endStrain / flow.shearRate; }

sph::FluidModel Case::fluidModel() const {
    return {numerics.kernel.model,
            fluid.equationOfState.model,
            flow.density,
            fluid.viscosity,
            soundSpeed(),
            particleMass(),
            flow.factor * flow.bodyForce,
            flow.walls,
            fluid.layers.empty() ? 0 : viscosities().least,
            fluid.solute};
}

particles::Precision Case::precision() const {
    return numerics.precision == "mixed" ? particles::Precision::mixed : particles::Precision::full;
}

Case::CellPlace Case::cellAt(int cell) const {
    auto left = static_cast<std::size_t>(cell) - 1;
    std::size_t entry = 0;
    for (; left >= mesh.cells[entry].placed.size(); ++entry) left -= mesh.cells[entry].placed.size();
    return {entry, left};
}

std::string Case::nameOf(int cell) const {
    const CellTypeSettings& entry = mesh.cells[cellAt(cell).entry];
    return coupling::nameOfCell(entry.name, entry.placed.size(), cell);
}

std::string Case::keyOfPlace(int cell) const {
    const auto [entry, place] = cellAt(cell);
    const CellTypeSettings& settings = mesh.cells[entry];
    if (settings.table) return fmt::format("cells[{}].table", entry);
    return settings.places.empty() ? fmt::format("cells[{}].centre", entry)
                                   : fmt::format("cells[{}].places[{}].centre", entry, place);
}

bool Case::varyingViscosity() const {
    return !fluid.layers.empty() || std::any_of(mesh.cells.begin(), mesh.cells.end(), [&](const CellSettings& cell) {
        return membraneOf(cell).interior.viscosityRatio != 1;
    });
}

double Case::viscosityAt(const Vec3& x) const {
    double viscosity = fluid.viscosity;
    for (const LayerSettings& layer : fluid.layers)
        if (x[*planesAcross()] > layer.above) viscosity = layer.viscosity;
    return viscosity;
}

ViscosityRange Case::viscosities() const {
    ViscosityRange range{fluid.viscosity, fluid.viscosity};
    for (const LayerSettings& layer : fluid.layers)
        range = {std::min(range.least, layer.viscosity), std::max(range.largest, layer.viscosity)};
    return range;
}

}  // namespace corpuscle::simulation
