#include "simulation/case.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/caseFiles.hpp"
#include "simulation/caseRules.hpp"
#include "simulation/cost.hpp"
#include "simulation/readyCell.hpp"
#include "simulation/scheme.hpp"

namespace corpuscle::simulation {

namespace {

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

// A cell without a shape is named here, and read with another one, so that all else is read too.
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

// What the cells are, and their membranes: of two files, since a ready cell has its part in both.
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
            app.dictionary("constant/membranes.yaml", problems);  // which says that it is missing
        return;
    }
    c.files["constant/membranes.yaml"] = std::move(laws);
    if (inLaws + inReady == 0) c.membranes = readNode<MembranesSettings>("constant/membranes.yaml", c, problems);
}

// Place of a key, or of the innermost table around it that was written.
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

constexpr double conjugateBulk = 500;  // bulk modulus of conjugate operators in units of mu gammadot

}  // namespace

// Rules between files know a file and a key; the line and column follow from the dictionary.
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

Case Case::read(const Application& app) {
    Problems problems;
    const std::set<std::string> misnamed = checkFiles(app, problems);
    Case c;
    c.directory = app.caseDirectory();
    const auto readInto = [&]<class T>(T& settings, const std::string& file) {
        if (!misnamed.contains(file)) settings = readFile<T>(app, file, c, problems);
    };
    readInto(c.control, "system/control.yaml");
    readInto(c.numerics, "system/numerics.yaml");
    readCells(app, misnamed, c, problems);
    readInto(c.fluid, "constant/fluid.yaml");
    if (!c.mesh.bodies.empty() || app.hasDictionary("constant/bodies.yaml")) readInto(c.bodies, "constant/bodies.yaml");
    if (!misnamed.contains("constant/flow.yaml")) {
        const std::size_t before = problems.count();
        const Node& node = c.files["constant/flow.yaml"] = app.dictionary("constant/flow.yaml", problems);
        if (problems.count() == before) c.flowModel = readChoice<sph::Flow>(node, problems);
        if (problems.count() == before) c.effective.emplace_back("constant/flow.yaml", writeChoice(c.flowModel));
    }
    if (app.hasDictionary("system/observers.yaml"))
        c.observers = readFile<observers::ObserversSettings>(app, "system/observers.yaml", c, problems);
    problems.throwIfAny();

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
    c.throwIfAny(problems);
    c.written = c.numerics;
    c.numerics = schemeOf(c, c.written.integrator);
    checkTogether(c, problems);
    c.throwIfAny(problems);

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
    if (c.control.endStrain && c.flow.shearRate <= 0)
        problems.add({"system/control.yaml", 0, 0}, "endStrain",
                     "the flow '" + c.flowModel.name + "' has no shear rate to count strain with; give endTime");
    if (c.control.write.strain && c.flow.shearRate <= 0)
        problems.add({"system/control.yaml", 0, 0}, "write.strain",
                     "the flow '" + c.flowModel.name + "' has no shear rate to count strain with; give write.time");
    if (c.numerics.isAutomatic()) {
        c.numerics = schemeOf(c, cheapest(predictCosts(c)));
        c.integratorChosen = true;
    } else {
        c.numerics = schemeOf(c, c.written.integrator);  // its step, now that the flow is known
    }
    c.mesh.fill.jitter = jitterOf(c);
    for (auto& [file, table] : c.effective)
        if (file == "system/numerics.yaml")
            table = write(c.numerics);
        else if (file == "system/mesh.yaml")
            table = write(c.mesh);
    c.observers.check(c.files["system/observers.yaml"],
                      {!c.mesh.cells.empty(), c.flowModel->wallAxis() >= 0, c.flow.shearRate, !c.mesh.bodies.empty()},
                      problems);
    c.throwIfAny(problems);
    return c;
}

int Case::wallLayers() const {
    return flowModel->wallAxis() < 0 ? 0 : static_cast<int>(std::ceil(support() / spacing() - 1e-9));
}

particles::Box Case::fluidBox() const {
    return {-0.5 * mesh.domain.size, 0.5 * mesh.domain.size, mesh.domain.periodic};
}

particles::Box Case::particleBox() const {
    particles::Box box = fluidBox();
    if (const int k = flowModel->wallAxis(); k >= 0) {
        box.low[k] -= wallLayers() * latticeSpacing()[k];
        box.high[k] += wallLayers() * latticeSpacing()[k];
    }
    return box;
}

Vec3 Case::latticeSpacing() const { return mesh.domain.size.array() / (mesh.domain.size / spacing()).array().round(); }

double Case::soundSpeed() const {
    const std::optional<double>& given = fluid.equationOfState->soundSpeed;
    return given ? *given : automaticSoundSpeed();
}

double Case::automaticSoundSpeed() const {
    const double nu = viscosities().largest / flow.density;
    if (isConjugate())  // volumes are kept exactly: the membrane's stiffness does not count
        return std::sqrt(std::max({100 * flow.speed * flow.speed, conjugateBulk * nu * flow.rate,
                                   100 * flow.bodyForce.norm() * flow.length}));
    double length = flow.length, square = flow.speed * flow.speed;
    for (const CellSettings& cell : mesh.cells) {
        const double a = cell.shape->radius();
        length = std::min(length, a);
        square = std::max(square, membraneOf(cell).moduli(cell.edge).shear / (flow.density * a));
    }
    double speed = flow.speed;
    for (const BodyPlaceSettings& body : mesh.bodies) {
        const double a = body.shape->radius();
        length = std::min(length, a);
        speed = std::max(speed, bodyOf(body).motion->speed(a));
    }
    square = std::max({square, speed * speed, nu * speed / length, flow.bodyForce.norm() * flow.length});
    return 10 * std::sqrt(square);
}

sph::FluidModel Case::fluidModel() const {
    return {numerics.kernel.model,
            fluid.equationOfState.model,
            flow.density,
            fluid.viscosity,
            soundSpeed(),
            particleMass(),
            flow.bodyForce,
            flow.walls,
            fluid.layers.empty() ? 0 : viscosities().least};
}

bool Case::isConjugate() const {
    return numerics.isImplicit() || numerics.isCorrected() || (numerics.isImmersed() && !mesh.cells.empty());
}

particles::Precision Case::precision() const {
    return numerics.precision == "mixed" ? particles::Precision::mixed : particles::Precision::full;
}

bool Case::varyingViscosity() const {
    return !fluid.layers.empty() || std::any_of(mesh.cells.begin(), mesh.cells.end(), [&](const CellSettings& cell) {
        return membraneOf(cell).interior.viscosityRatio != 1;
    });
}

double Case::viscosityAt(const Vec3& x) const {
    double viscosity = fluid.viscosity;
    for (const LayerSettings& layer : fluid.layers)
        if (x[flowModel->wallAxis()] > layer.above) viscosity = layer.viscosity;
    return viscosity;
}

ViscosityRange Case::viscosities() const {
    ViscosityRange range{fluid.viscosity, fluid.viscosity};
    for (const LayerSettings& layer : fluid.layers)
        range = {std::min(range.least, layer.viscosity), std::max(range.largest, layer.viscosity)};
    return range;
}

}  // namespace corpuscle::simulation
