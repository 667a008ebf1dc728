#include "simulation/caseSettings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace corpuscle::simulation {

const Schema<WriteSettings>& WriteSettings::schema() {
    static const Schema<WriteSettings> s =
        Schema<WriteSettings>("write",
                              "when results are written, and what; nothing but the start when no interval is given")
            .quantity("strain", &WriteSettings::strain, unit::none, "strain gammadot t between two writes",
                      {.range = positive})
            .quantity("time", &WriteSettings::time, unit::second, "time between two writes", {.range = positive})
            .integer("steps", &WriteSettings::steps, "time steps between two writes", {.range = atLeast(1)})
            .atMostOneOf({"strain", "time", "steps"})
            .words("fields", &WriteSettings::fields,
                   {"velocity", "density", "pressure", "meanPressure", "side", "concentration"},
                   "arrays of the fluid; meanPressure: over the kernel's support on the particle's own side, without "
                   "the noise of single particles",
                   {.fallback = "[velocity, density, pressure]"})
            .integerOr("all", "keep", &WriteSettings::keep, "how many times stay on disk",
                       {.fallback = "all", .range = atLeast(1)});
    return s;
}

Interval WriteSettings::interval() const {
    if (strain) return {Interval::Kind::strain, *strain};
    if (time) return {Interval::Kind::time, *time};
    if (steps) return {Interval::Kind::steps, static_cast<double>(*steps)};
    return {};
}

const Schema<CheckpointSettings>& CheckpointSettings::schema() {
    static const Schema<CheckpointSettings> s =
        Schema<CheckpointSettings>("checkpoint", "complete states for restarts; one is written at the end of every run")
            .quantityOr("never", "wallClock", &CheckpointSettings::wallClock, unit::second,
                        "wall-clock time between two checkpoints", {.fallback = "30 min", .range = positive})
            .integer("keep", &CheckpointSettings::keep, "how many checkpoints stay on disk",
                     {.fallback = "2", .range = atLeast(1)});
    return s;
}

const Schema<StopSettings>& StopSettings::schema() {
    static const Schema<StopSettings> s =
        Schema<StopSettings>("stop", "ways to end a run early, with a checkpoint")
            .name("file", &StopSettings::file, "a file of this name in the case directory stops the run",
                  {.fallback = "stop"})
            .quantityOr("never", "wallClock", &StopSettings::wallClock, unit::second,
                        "wall-clock time after which the run stops", {.fallback = "never", .range = positive})
            .boolean("firstBreak", &StopSettings::firstBreak, "stop as soon as a membrane has broken",
                     {.fallback = "false"});
    return s;
}

std::optional<double> ControlSettings::startingTime(const std::string& startFrom) {
    if (startFrom == "latestTime") return std::nullopt;
    if (startFrom == "firstTime") return 0.0;
    Quantity time;
    try {
        time = parseQuantity(startFrom);
    } catch (const std::invalid_argument&) {
        time.hasUnit = false;
    }
    if (!time.hasUnit || time.dimension != unit::second || time.value < 0)
        throw std::invalid_argument("found '" + startFrom +
                                    "'; allowed are latestTime, firstTime, or a time with its unit (1.2e-3 s)." +
                                    didYouMean(startFrom, {"latestTime", "firstTime"}));
    return time.value;
}

const Schema<ControlSettings>& ControlSettings::schema() {
    static const Schema<ControlSettings> s =
        Schema<ControlSettings>("control", "system/control.yaml: how long to run and what to write")
            .word("application", &ControlSettings::application, {"dmpFlow", "sphFlow"}, "the solver that runs the case")
            .wordOrQuantity(
                "startFrom", &ControlSettings::startFrom, {"latestTime", "firstTime"}, unit::second,
                "where the run goes on: from the last checkpoint, the start, or the checkpoint nearest before a time",
                {.fallback = "latestTime", .range = nonNegative})
            .quantity("endTime", &ControlSettings::endTime, unit::second, "time at which the run ends",
                      {.range = positive})
            .quantity("endStrain", &ControlSettings::endStrain, unit::none, "strain gammadot t at which the run ends",
                      {.range = positive})
            .exactlyOneOf({"endTime", "endStrain"})
            .table("write", &ControlSettings::write, "results", {.fallback = "{}"})
            .table("checkpoint", &ControlSettings::checkpoint, "checkpoints", {.fallback = "{}"})
            .table("stop", &ControlSettings::stop, "early end", {.fallback = "{}"})
            .values("libs", &ControlSettings::libs, pluginsText, {.fallback = "[]"})
            .atRestart(AtRestart::free,
                       {"application", "startFrom", "endTime", "endStrain", "write", "checkpoint", "stop"})
            .atRestart(AtRestart::noted, {"libs"});
    return s;
}

const Schema<DomainSettings>& DomainSettings::schema() {
    static const Schema<DomainSettings> s =
        Schema<DomainSettings>("domain", "the box of fluid, centred on the origin")
            .vector("size", &DomainSettings::size, unit::metre,
                    "between the walls, a whole number of spacings along each axis", {.range = positive})
            .booleans("periodic", &DomainSettings::periodic,
                      "which axes are periodic; the axis across the walls is not");
    return s;
}

namespace {
// The keys of all closed surfaces; a cell may have them from a ready cell.
template <class Surface>
void addSurface(Schema<Surface>& s, const FieldOptions& ofShape = {}) {
    s.name("name", static_cast<std::string Surface::*>(&SurfaceSettings::name), "names 0/<name>.vtp and its results")
        .model("shape", static_cast<Choice<geometry::Shape> Surface::*>(&SurfaceSettings::shape),
               "shape, of a cell the stress-free one; axis along z", ofShape)
        .length("edge", static_cast<Length Surface::*>(&SurfaceSettings::edgeLength), "edge length of the mesh",
                {.range = positive})
        .word("enclose", static_cast<std::string Surface::*>(&SurfaceSettings::enclose), {"exact", "surface"},
              "what the mesh encloses: exactly the volume of the shape, for which its nodes lie a little off the "
              "surface; or what facets leave of it whose nodes lie on the surface",
              {.fallback = "exact"})
        .vector("centre", static_cast<Vec3 Surface::*>(&SurfaceSettings::centre), unit::metre, "place of its centre",
                {.fallback = "[0 m, 0 m, 0 m]"})
        .vector("axis", static_cast<Vec3 Surface::*>(&SurfaceSettings::axis), unit::none,
                "direction of its symmetry axis", {.fallback = "[0, 0, 1]"})
        .check([](const Surface& c, const Node& node, Problems& problems) {
            if (const Node* axis = node.find("axis"); axis && c.axis.norm() == 0)
                problems.add(axis->mark, axis->path, "found the zero vector; a direction is needed, such as [0, 0, 1]");
        });
}
}  // namespace

const Schema<SurfaceSettings>& SurfaceSettings::schema() {
    static const Schema<SurfaceSettings> s = [] {
        Schema<SurfaceSettings> keys("surface", "one closed surface: its shape, place and mesh");
        addSurface(keys);
        return keys;
    }();
    return s;
}

const Schema<PlaceSettings>& PlaceSettings::schema() {
    static const Schema<PlaceSettings> s =
        Schema<PlaceSettings>("place", "where one cell of a type is put")
            .vector("centre", &PlaceSettings::centre, unit::metre, "place of its centre")
            .vector("axis", &PlaceSettings::axis, unit::none, "direction of its symmetry axis",
                    {.fallback = "[0, 0, 1]"})
            .quantity("scale", &PlaceSettings::scale, unit::none, "its size, in sizes of the shape",
                      {.fallback = "1", .range = positive})
            .check([](const PlaceSettings& place, const Node& node, Problems& problems) {
                if (const Node* axis = node.find("axis"); axis && place.axis.norm() == 0)
                    problems.add(axis->mark, axis->path,
                                 "found the zero vector; a direction is needed, such as [0, 0, 1]");
            });
    return s;
}

double CellTypeSettings::largestScale() const {
    double largest = 0;
    for (const geometry::Place& place : placed) largest = std::max(largest, place.scale);
    return largest;
}

const Schema<CellSettings>& CellSettings::schema() {
    static const Schema<CellSettings> s = [] {
        Schema<CellSettings> keys("cell", "one cell: its shape, place and mesh");
        addSurface(keys, {.fallback = "that of 'cell'"});
        keys.name("cell", &CellSettings::cell,
                  "a ready cell, in place of 'shape' and 'membrane': a file of constant/cells or etc/cells")
            .name("membrane", &CellSettings::membrane,
                  "its entry of constant/membranes.yaml; the cell's own name when absent")
            .atRestart(AtRestart::noted, {"membrane", "cell"})
            .exactlyOneOf({"shape", "cell"});
        return keys;
    }();
    return s;
}

const Schema<CellTypeSettings>& CellTypeSettings::schema() {
    static const Schema<CellTypeSettings> s =
        Schema<CellTypeSettings>("cell", "one type of cell: its shape, mesh and place, or places")
            .include<CellSettings>()
            .list("places", &CellTypeSettings::places, "many cells of this type, in place of 'centre' and 'axis'",
                  {.fallback = "[]"})
            .text("table", &CellTypeSettings::table,
                  "the same from a file, relative to the case: CSV with columns x_um, y_um, z_um and, where wanted, "
                  "axis_x, axis_y, axis_z, scale; or VTP")
            .check([](const CellTypeSettings& cell, const Node& node, Problems& problems) {
                if (!cell.places.empty() && cell.table)
                    problems.add(node.find("table")->place(), node.path + ".table",
                                 "given beside 'places'; keep one of them");
                if (!cell.isPlacedByList()) return;
                const char* const list = cell.table ? "table" : "places";
                for (const auto& [key, isUsual] : {std::pair("centre", cell.centre.isZero()),
                                                   {"axis", cell.axis.normalized() == Vec3(Vec3::UnitZ())}})
                    if (const Node* own = node.find(key); own && !isUsual)
                        problems.add(own->place(), own->path,
                                     fmt::format("given beside '{}', which says it for each cell; remove it", list));
            });
    return s;
}

const Schema<BodyPlaceSettings>& BodyPlaceSettings::schema() {
    static const Schema<BodyPlaceSettings> s =
        Schema<BodyPlaceSettings>("body", "one rigid body: its shape, place and mesh")
            .include<SurfaceSettings>()
            .name("body", &BodyPlaceSettings::body,
                  "its entry of constant/bodies.yaml; the body's own name when absent")
            .atRestart(AtRestart::noted, {"body"});
    return s;
}

const Schema<FillSettings>& FillSettings::schema() {
    static const Schema<FillSettings> s =
        Schema<FillSettings>("fill", "how particleFill places particles")
            .quantity(
                "jitter", &FillSettings::jitter, unit::none,
                "largest random displacement in spacings; when absent 0.1 around immersed membranes, in flows of three "
                "dimensions and with rigid bodies where images slide, else 0",
                {.range = between(0, 0.45)})
            .integer("seed", &FillSettings::seed, "of the random displacements",
                     {.fallback = "1", .range = nonNegative})
            .integer("relaxation", &FillSettings::relaxation, "sweeps that even out particles around membranes",
                     {.fallback = "60", .range = nonNegative});
    return s;
}

const Schema<MeshSettings>& MeshSettings::schema() {
    static const Schema<MeshSettings> s =
        Schema<MeshSettings>("mesh", "system/mesh.yaml: the box, and the cells and rigid bodies in it")
            .table("domain", &MeshSettings::domain, "the box")
            .list("cells", &MeshSettings::cells, "the cells", {.fallback = "[]"})
            .list("bodies", &MeshSettings::bodies, "the rigid bodies", {.fallback = "[]"})
            .table("fill", &MeshSettings::fill, "placing of particles", {.fallback = "{}"})
            .atRestart(AtRestart::fixed, {"domain", "cells", "bodies", "fill"});
    return s;
}

const Schema<LayerSettings>& LayerSettings::schema() {
    static const Schema<LayerSettings> s =
        Schema<LayerSettings>("layer", "fluid of another viscosity, as far as the next layer or the upper wall")
            .quantity("above", &LayerSettings::above, unit::metre,
                      "coordinate along the walls' normal at which it begins; the box is centred on 0")
            .quantity("viscosity", &LayerSettings::viscosity, unit::pascalSecond, "its dynamic viscosity",
                      {.range = positive});
    return s;
}

const Schema<FluidSettings>& FluidSettings::schema() {
    static const Schema<FluidSettings> s =
        Schema<FluidSettings>("fluid", "constant/fluid.yaml: the fluid outside the cells")
            .quantity("density", &FluidSettings::density, unit::kilogramPerMetre3, "rest density rho0",
                      {.range = positive})
            .quantity("viscosity", &FluidSettings::viscosity, unit::pascalSecond,
                      "dynamic viscosity mu; with layers, that beside the lower wall", {.range = positive})
            .list("layers", &FluidSettings::layers,
                  "layers of other viscosities between two walls, from the lowest up, at t = 0; for a fluid alone",
                  {.fallback = "[]"})
            .model("equationOfState", &FluidSettings::equationOfState, "pressure from density", {.fallback = "tait"})
            .table("solute", &FluidSettings::solute, "a solute that the fluid carries, such as haemoglobin")
            .atRestart(AtRestart::resolved, {"density", "viscosity"})
            .atRestart(AtRestart::fixed, {"layers"})
            .atRestart(AtRestart::noted, {"equationOfState"});
    return s;
}

const Schema<MembranesSettings>& MembranesSettings::schema() {
    static const Schema<MembranesSettings> s =
        Schema<MembranesSettings>("membranes", "constant/membranes.yaml: laws of each kind of cell")
            .map("*", &MembranesSettings::types, "laws of one kind of cell");
    return s;
}

void requireEntry(const std::vector<std::string>& known, const std::string& type, const std::string& user,
                  const Mark& mark, Problems& problems) {
    if (std::find(known.begin(), known.end(), type) != known.end()) return;
    problems.add(mark, type,
                 user + " needs an entry of this name; there " +
                     (known.empty() ? "is none" : "are: " + joinWords(known)) + "." + didYouMean(type, known));
}

}  // namespace corpuscle::simulation
