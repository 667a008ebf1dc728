// The dictionaries of a case, file by file. Each setting is declared once, in caseSettings.cpp.
#pragma once
#include "bodies/bodySettings.hpp"
#include "core/registry.hpp"
#include "geometry/place.hpp"
#include "geometry/shape.hpp"
#include "membrane/membraneSettings.hpp"
#include "schemes/numericsSettings.hpp"
#include "sph/equationOfState.hpp"
#include "sph/flow.hpp"

namespace corpuscle::simulation {

// system/control.yaml
struct WriteSettings {
    std::optional<double> strain, time;  // time in s
    std::optional<long> steps;
    std::vector<std::string> fields;  // arrays of the fluid
    std::optional<long> keep;         // number of written times that stay on disk; empty: all
    static const Schema<WriteSettings>& schema();
    Interval interval() const;
};
struct CheckpointSettings {
    std::optional<double> wallClock;  // interval in s; empty: only at the end
    long keep = 2;
    static const Schema<CheckpointSettings>& schema();
};
struct StopSettings {
    std::string file = "stop";
    std::optional<double> wallClock;  // s
    bool firstBreak = false;
    static const Schema<StopSettings>& schema();
};
// Description of the key `libs`, here and in system/relax.yaml.
inline constexpr const char* pluginsText =
    "libraries with models of your own, such as [myLaw.so]; paths from the case directory";

struct ControlSettings {
    std::string application;
    std::string startFrom = "latestTime";
    // The time that `startFrom` (or -restart) selects [s]; empty for latestTime. Throws std::invalid_argument with the
    // allowed values.
    static std::optional<double> startingTime(const std::string& startFrom);
    std::optional<double> endTime, endStrain;
    WriteSettings write;
    CheckpointSettings checkpoint;
    StopSettings stop;
    std::vector<std::string> libs;  // loaded by core/plugins before anything is read
    static const Schema<ControlSettings>& schema();
};

using schemes::NumericsSettings;  // system/numerics.yaml

// system/mesh.yaml
struct DomainSettings {
    Vec3 size = Vec3::Zero();  // of the fluid, between the walls [m]; centred on the origin
    std::array<bool, 3> periodic{};
    static const Schema<DomainSettings>& schema();
};
struct SurfaceSettings {
    std::string name;
    Choice<geometry::Shape> shape;
    Length edgeLength;  // target, as written: a length, or in spacings
    double edge = 0;    // the same [m], once the particle spacing is known
    std::string enclose;
    bool enclosesExactly() const { return enclose == "exact"; }  // geometry/enclosedVolume.hpp
    Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();
    static const Schema<SurfaceSettings>& schema();
};
struct PlaceSettings {
    Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();
    double scale = 1;
    static const Schema<PlaceSettings>& schema();
};
struct CellSettings : SurfaceSettings {
    std::optional<std::string> cell;      // name of a ready cell, replaced by its values (readyCell.hpp)
    std::optional<std::string> membrane;  // entry of constant/membranes.yaml; empty: the entry with the cell's name
    static const Schema<CellSettings>& schema();
    const std::string& type() const { return membrane ? *membrane : name; }
};
// One type of cell: a mesh and a membrane, for a single cell or for one cell at each place of `places` or `table`.
struct CellTypeSettings : CellSettings {
    std::vector<PlaceSettings> places;
    std::optional<std::string> table;  // file of places (placesTable.hpp)
    static const Schema<CellTypeSettings>& schema();

    // Derived: for each cell, where the mesh in 0/ is put. If the entry itself says where its single cell is, the mesh
    // in 0/ already stands there, and the only place is the identity.
    std::vector<geometry::Place> placed{geometry::Place{}};
    bool isPlacedByList() const { return !places.empty() || table; }
    // For each cell, where the shape is put, which is given around the origin with its axis along z.
    std::vector<geometry::Place> standing() const {
        return isPlacedByList() ? placed : std::vector<geometry::Place>{{centre, axis, 1}};
    }
    double largestScale() const;
};
struct BodyPlaceSettings : SurfaceSettings {
    std::optional<std::string> body;  // entry of constant/bodies.yaml; empty: the entry with the body's name
    static const Schema<BodyPlaceSettings>& schema();
    const std::string& type() const { return body ? *body : name; }
};
struct FillSettings {
    std::optional<double> jitter;  // in spacings; always set in a Case that has been read (case.cpp)
    long seed = 1;
    long relaxation = 60;  // number of sweeps that even out the particles around membranes
    static const Schema<FillSettings>& schema();
};
struct MeshSettings {
    DomainSettings domain;
    std::vector<CellTypeSettings> cells;
    std::vector<BodyPlaceSettings> bodies;
    FillSettings fill;
    static const Schema<MeshSettings>& schema();
};

// constant/fluid.yaml
struct LayerSettings {
    double above = 0;  // coordinate along the walls' normal at which the layer begins [m]
    double viscosity = 0;
    static const Schema<LayerSettings>& schema();
};
struct FluidSettings {
    double density = 0, viscosity = 0;
    std::vector<LayerSettings> layers;  // from the lowest up
    Choice<sph::EquationOfState> equationOfState;
    std::optional<sph::Solute> solute;
    static const Schema<FluidSettings>& schema();
};

// constant/membranes.yaml: one entry for each kind of cell.
struct MembranesSettings {
    std::map<std::string, membrane::MembraneSettings> types;
    static const Schema<MembranesSettings>& schema();
};

// Adds a problem at `mark` if the entry `type`, which `user` ("the cell 'rbc' of system/mesh.yaml") names, is not among
// the known ones.
void requireEntry(const std::vector<std::string>& known, const std::string& type, const std::string& user,
                  const Mark& mark, Problems& problems);
template <class Settings>
void requireEntry(const std::map<std::string, Settings>& types, const std::string& type, const std::string& user,
                  const Mark& mark, Problems& problems) {
    std::vector<std::string> known;
    known.reserve(types.size());
    for (const auto& [name, settings] : types) known.push_back(name);
    requireEntry(known, type, user, mark, problems);
}

}  // namespace corpuscle::simulation
