// A case, read and checked as a whole: every dictionary, and what follows from their combination. SI from here on.
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
    std::optional<contact::ContactSettings> contact;  // none unless the case has constant/contact.yaml
    Choice<sph::Flow> flowModel;
    observers::ObserversSettings observers;
    std::map<std::string, Node> files;   // the dictionaries as they were read
    std::vector<Node::Entry> effective;  // file and its full table: used.yaml

    NumericsSettings written;       // numerics before it is settled what automatic keys stand for (schemes/choice.hpp)
    bool integratorChosen = false;  // the integrator was automatic, and is now what costs least (schemes/cost.hpp)

    // What follows.
    sph::FlowState flow;
    sph::FluidModel fluidModel() const;
    particles::Precision precision() const;  // of the laws between pairs
    double spacing() const { return numerics.spacing; }
    double support() const { return numerics.support(); }
    double skin() const { return numerics.skin.metres(spacing()); }
    bool hasWallsAcross(int axis) const { return flowModel->walls() && flowModel->walls()->isAcross(axis); }
    // The axis across two plane walls, where the flow has them.
    std::optional<int> planesAcross() const {
        return flowModel->walls() ? flowModel->walls()->planesAcross() : std::nullopt;
    }
    int wallLayers() const;  // of particles behind each wall: as deep as the support reaches
    Vec3 wallDepth() const { return wallLayers() * latticeSpacing(); }  // of these along each axis [m]
    double fluidVolume() const;          // between the walls, with all that floats in it [m^3]
    particles::Box fluidBox() const;     // the smallest around the fluid
    particles::Box particleBox() const;  // with the walls' layers
    Vec3 latticeSpacing() const;         // that divides the fluid's box evenly, dx to 1e-3 of it [m]
    double particleVolume() const { return latticeSpacing().prod(); }  // [m^3]
    double particleMass() const { return flow.density * particleVolume(); }
    double soundSpeed() const;
    double automaticSoundSpeed() const;  // what `soundSpeed: auto` stands for
    const membrane::MembraneSettings& membraneOf(const CellSettings& cell) const {
        return membranes.types.at(cell.type());
    }
    const bodies::BodySettings& bodyOf(const BodyPlaceSettings& place) const { return bodies.types.at(place.type()); }
    // All cells of all entries, numbered from 1 through the entries and the places of each, as in the scene.
    struct CellPlace {
        std::size_t entry, place;
    };
    CellPlace cellAt(int cell) const;
    std::string nameOf(int cell) const;      // of its entry, with the cell's own number where that has several
    std::string keyOfPlace(int cell) const;  // of what says where it is: "cells[0].centre", "cells[0].places[3].centre"
    double densityOf(const BodyPlaceSettings& place) const { return bodyOf(place).density.value_or(flow.density); }
    bool varyingViscosity() const;
    // Of the fluid outside cells, by its layers [Pa s].
    double viscosityAt(const Vec3& x) const;
    ViscosityRange viscosities() const;  // of the fluid outside cells
    const schemes::Scheme& scheme() const { return *numerics.scheme; }
    schemes::CaseFacts facts() const;  // what a scheme is told
    double duration() const;           // of the whole run [s]

    // Throws CaseError when there are problems, each at the line of its file where its key stands.
    void throwIfAny(const Problems& problems) const;

    // Reads all files of the case; throws CaseError with every problem found. Collective.
    // unplaced: types whose `table` is still to be written; they have no places.
    static Case read(const Application& app, const std::set<std::string>& unplaced = {});
};

}  // namespace corpuscle::simulation
