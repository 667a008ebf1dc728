// A case: all its dictionaries, read and checked together, and the quantities derived from them. All values are in SI.
#pragma once
#include <map>
#include <set>

#include "contact/contactSettings.hpp"
#include "core/application.hpp"
#include "observers/observers.hpp"
#include "schemes/choice.hpp"
#include "simulation/caseSettings.hpp"
#include "sph/fluidForces.hpp"

namespace corpuscle::simulation {

struct ViscosityRange {
    double least, largest;  // [Pa s]
};

struct Case {
    std::filesystem::path directory;
    ControlSettings control;
    NumericsSettings numerics;
    MeshSettings mesh;
    FluidSettings fluid;
    MembranesSettings membranes;
    bodies::BodiesSettings bodies;
    std::optional<contact::ContactSettings> contact;  // empty unless the case has constant/contact.yaml
    Choice<sph::Flow> flowModel;
    observers::ObserversSettings observers;
    std::map<std::string, Node> files;   // the dictionaries as they were read
    std::vector<Node::Entry> effective;  // each file with all its settings, as used.yaml has them

    NumericsSettings written;       // numerics as written, before automatic keys are resolved (schemes/choice.hpp)
    bool integratorChosen = false;  // the integrator was automatic; the cheapest has been chosen (schemes/cost.hpp)

    // Derived quantities.
    sph::FlowState flow;
    sph::FluidModel fluidModel() const;
    particles::Precision precision() const;  // in which pair laws are evaluated
    double spacing() const { return numerics.spacing; }
    double support() const { return numerics.support(); }
    double skin() const { return numerics.skin.metres(spacing()); }
    bool hasWallsAcross(int axis) const { return flowModel->walls() && flowModel->walls()->isAcross(axis); }
    // The axis normal to the two plane walls; empty if the flow has none.
    std::optional<int> planesAcross() const {
        return flowModel->walls() ? flowModel->walls()->planesAcross() : std::nullopt;
    }
    int wallLayers() const;  // layers of particles behind each wall, enough to cover the support
    Vec3 wallDepth() const { return wallLayers() * latticeSpacing(); }  // of these layers, along each axis [m]
    double fluidVolume() const;          // between the walls, cells and bodies included [m^3]
    particles::Box fluidBox() const;     // the smallest box around the fluid
    particles::Box particleBox() const;  // the same with the layers of wall particles
    Vec3 latticeSpacing() const;         // divides the fluid's box evenly; equals dx to 1e-3 of dx [m]
    double particleVolume() const { return latticeSpacing().prod(); }  // [m^3]
    double particleMass() const { return flow.density * particleVolume(); }
    double soundSpeed() const;
    double automaticSoundSpeed() const;  // what `soundSpeed: auto` stands for
    const membrane::MembraneSettings& membraneOf(const CellSettings& cell) const {
        return membranes.types.at(cell.type());
    }
    const bodies::BodySettings& bodyOf(const BodyPlaceSettings& place) const { return bodies.types.at(place.type()); }
    // Where a cell is listed. Cells are numbered from 1 through all entries and the places of each, as in the scene.
    struct CellPlace {
        std::size_t entry, place;
    };
    CellPlace cellAt(int cell) const;
    std::string nameOf(int cell) const;      // name of its entry, and the cell's own number if the entry has several
    std::string keyOfPlace(int cell) const;  // that gives its place: "cells[0].centre", "cells[0].places[3].centre"
    double densityOf(const BodyPlaceSettings& place) const { return bodyOf(place).density.value_or(flow.density); }
    bool varyingViscosity() const;
    // Viscosity of the fluid outside cells, from its layers [Pa s].
    double viscosityAt(const Vec3& x) const;
    ViscosityRange viscosities() const;  // of the fluid outside cells
    const schemes::Scheme& scheme() const { return *numerics.scheme; }
    schemes::CaseFacts facts() const;  // facts of the case that schemes use
    double duration() const;           // of the whole run [s]

    // Throws CaseError if there are problems, each with the line of its file where its key stands.
    void throwIfAny(const Problems& problems) const;

    // Reads all files of the case; throws CaseError with every problem found. Collective.
    // unplaced: types of cells whose `table` has not been written yet; they get no places.
    static Case read(const Application& app, const std::set<std::string>& unplaced = {});
    // The same case with system/control.yaml and system/observers.yaml as they are now. Throws CaseError with every
    // problem found in them. Collective.
    Case withEdits(const Application& app) const;
};

}  // namespace corpuscle::simulation
