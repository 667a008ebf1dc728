#include "simulation/caseRules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "coupling/noFlux.hpp"
#include "geometry/mesher.hpp"
#include "io/vtkSeries.hpp"
#include "schemes/cost.hpp"

namespace corpuscle::simulation {

std::vector<PlacedSurface> surfacesOf(const MeshSettings& mesh) {
    std::vector<PlacedSurface> all;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        all.push_back({mesh.cells[i], "cells[" + std::to_string(i) + "]", "cell"});
    for (std::size_t i = 0; i < mesh.bodies.size(); ++i)
        all.push_back({mesh.bodies[i], "bodies[" + std::to_string(i) + "]", "body"});
    return all;
}

namespace {

constexpr double leastBodyInSpacings = 3;
constexpr double largestEdgeInSpacings = 2;                // of immersed membranes
constexpr double leastSupport = 1.2, largestSupport = 10;  // in spacings

const char* axisName(int k) { return k == 0 ? "x" : k == 1 ? "y" : "z"; }

// Message about a surface whose size does not fit the box or the edge, but would in another unit of its file; else
// empty.
std::string wrongScale(const Case& c, const SurfaceSettings& surface) {
    const double longest = surface.shape->box().sizes().maxCoeff(), room = c.mesh.domain.size.maxCoeff();
    if (longest <= room && surface.edge <= 0.5 * surface.shape->radius()) return {};
    const std::string cure = surface.shape->cureForSize(4 * surface.edge, room);
    if (cure.empty()) return {};
    return "the surface is " + formatQuantity(longest, unit::metre) + " long, in a box of " +
           formatQuantity(room, unit::metre) + " and with edges of " + formatQuantity(surface.edge, unit::metre) +
           "; " + cure;
}

void checkSurface(const Case& c, const PlacedSurface& surface, Problems& problems) {
    const Mark mesh{"system/mesh.yaml", 0, 0};
    const auto& [settings, key, kind] = surface;
    if (!settings.shape) return;
    const double radius = settings.shape->radius();
    const Eigen::AlignedBox3d box = settings.shape->box();
    if (const std::string why = wrongScale(c, settings); !why.empty()) {
        problems.add(mesh, key + ".shape", why);
        return;
    }
    if (const std::string why = geometry::tooManyTriangles(*settings.shape.model, settings.edge); !why.empty())
        problems.add(mesh, key + ".edge", why);
    if (settings.edge > 0.5 * radius)
        problems.add(mesh, key + ".edge",
                     "found " + formatQuantity(settings.edge, unit::metre) + ", too coarse for a " + kind +
                         " of radius " + formatQuantity(radius, unit::metre) + "; at most half the radius, " +
                         formatQuantity(0.5 * radius, unit::metre));
    if (kind == "body" && box.sizes().minCoeff() < leastBodyInSpacings * c.spacing())
        problems.add(mesh, key + ".shape",
                     "the body is " + formatQuantity(box.sizes().minCoeff(), unit::metre) +
                         " thick, too thin to be filled with particles of spacing " +
                         formatQuantity(c.spacing(), unit::metre) + "; at least " +
                         formatQuantity(leastBodyInSpacings * c.spacing(), unit::metre) +
                         ": take a smaller spacing in system/numerics.yaml, or a thicker body");
    if (kind == "body")
        for (int k = 0; k < 3; ++k) {
            const double least = box.sizes().maxCoeff() + 2 * c.support();
            if (c.mesh.domain.periodic[static_cast<std::size_t>(k)] && c.mesh.domain.size[k] < least)
                problems.add(mesh, key + ".shape",
                             std::string("the body is too long for the box, which is periodic along ") + axisName(k) +
                                 " with " + formatQuantity(c.mesh.domain.size[k], unit::metre) +
                                 ": it would meet its own image within the kernel's reach; at least " +
                                 formatQuantity(least, unit::metre) + ", better five times its radius");
        }
}

// Plane walls only; walls of other shapes are tested with the nodes of the mesh (stateCheck.hpp).
void checkBetweenPlanes(const Case& c, const geometry::Shape& shape, const std::string& kind,
                        const geometry::Place& place, const std::string& key, Problems& problems) {
    const Mark mesh{"system/mesh.yaml", 0, 0};
    const Eigen::AlignedBox3d box = shape.box();
    const int wall = *c.planesAcross();
    // Extent across the walls: that of the ellipsoid in the shape's box.
    const Vec3 across = place.scale * geometry::rotationFromZ(place.axis).row(wall).transpose(),
               half = 0.5 * box.sizes(), middle = box.center();
    const double extent = std::abs(place.centre[wall] + across.dot(middle)) + across.cwiseProduct(half).norm();
    if (extent > 0.5 * c.mesh.domain.size[wall])
        problems.add(mesh, key,
                     "the " + kind + " reaches through the wall along " + axisName(wall) + ", to " +
                         formatQuantity(extent, unit::metre) + " from the middle, and the wall is at " +
                         formatQuantity(0.5 * c.mesh.domain.size[wall], unit::metre) +
                         "; move it towards the middle or make the box larger");
}

// What immersed coupling requires of a type of cell: triangles small enough to hold particles near their middle to
// their side.
void checkImmersed(const Case& c, const CellTypeSettings& cell, const std::string& key, Problems& problems) {
    if (!wrongScale(c, cell).empty()) return;
    const Mark mesh{"system/mesh.yaml", 0, 0};
    const double longest = largestEdgeInSpacings * c.spacing(), edge = cell.largestScale() * cell.edge;
    if (edge > longest)
        problems.add(
            mesh, key + ".edge",
            "found " + formatQuantity(edge, unit::metre) +
                ", too coarse for 'coupling: immersed', which does not hold particles near the middle of large "
                "triangles to their side; at most " +
                formatQuantity(largestEdgeInSpacings, unit::none) + " dx, " + formatQuantity(longest, unit::metre));
}

// What a rupture law that weakens the sheet requires: edges that resolve its length.
void checkTearLength(const Case& c, const CellTypeSettings& cell, const std::string& key, Problems& problems) {
    const auto type = c.membranes.types.find(cell.type());
    if (type == c.membranes.types.end() || !type->second.rupture || !wrongScale(c, cell).empty()) return;
    const std::optional<double> length = type->second.rupture->resolvedLength();
    const double edge = cell.largestScale() * cell.edge;
    constexpr double rounding = 1 + 1e-9;
    if (length && edge > rounding * membrane::RuptureLaw::edgeOfResolvedLength * *length)
        problems.add({"system/mesh.yaml", 0, 0}, key + ".edge",
                     "found " + formatQuantity(edge, unit::metre) + ", too coarse for the tears of '" + cell.type() +
                         "' in constant/membranes.yaml, whose length is " + formatQuantity(*length, unit::metre) +
                         ": at most half of it, " +
                         formatQuantity(membrane::RuptureLaw::edgeOfResolvedLength * *length, unit::metre) +
                         "; take a finer mesh, or a greater 'length' of the rupture law");
}

// What immersed coupling requires of one cell: a unique nearest image everywhere.
void checkImmersedPlace(const Case& c, const CellTypeSettings& cell, const geometry::Place& place,
                        const std::string& key, Problems& problems) {
    const Mark mesh{"system/mesh.yaml", 0, 0};
    const double margin = coupling::NoFlux::imageMarginInSpacings * c.spacing();
    const Vec3 half = 0.5 * place.scale * cell.shape->box().sizes();
    const Mat3 rotation = geometry::rotationFromZ(place.axis);
    for (int k = 0; k < 3; ++k) {
        const double length = 2 * Vec3(rotation.row(k).transpose()).cwiseProduct(half).norm();
        if (!c.mesh.domain.periodic[static_cast<std::size_t>(k)] || length <= c.mesh.domain.size[k] - margin) continue;
        problems.add(mesh, key,
                     "the cell is " + formatQuantity(length, unit::metre) + " long along " + axisName(k) +
                         ", where the box is periodic with " + formatQuantity(c.mesh.domain.size[k], unit::metre) +
                         ": with 'coupling: immersed' it must be shorter than the box by " +
                         formatQuantity(coupling::NoFlux::imageMarginInSpacings, unit::none) +
                         " dx at least; make the box " + formatQuantity(length + margin, unit::metre) +
                         " or longer, or the cell smaller");
    }
}

// Layers of other viscosities require two plane walls, must each be at least a spacing thick, and exclude cells and
// bodies.
void checkLayers(const Case& c, Problems& problems) {
    const Mark fluid{"constant/fluid.yaml", 0, 0};
    const std::vector<LayerSettings>& layers = c.fluid.layers;
    if (layers.empty()) return;
    if (!c.planesAcross()) {
        problems.add(fluid, "layers",
                     "found layers, but the flow '" + c.flowModel.name +
                         "' has no plane walls for them to lie between; remove them, or take a flow with plane walls "
                         "in constant/flow.yaml");
        return;
    }
    const int wall = *c.planesAcross();
    if (!c.mesh.cells.empty() || !c.mesh.bodies.empty())
        problems.add(fluid, "layers",
                     std::string("found layers, which are for a fluid alone, but system/mesh.yaml has ") +
                         (c.mesh.cells.empty() ? "bodies; remove these, or the layers"
                                               : "cells; remove these, or the layers (the fluid inside a cell has "
                                                 "'interior: {viscosityRatio}' in constant/membranes.yaml)"));
    const double half = 0.5 * c.mesh.domain.size[wall], dx = c.spacing();
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const double below = i > 0 ? layers[i - 1].above : -half, above = layers[i].above;
        const std::string key = "layers[" + std::to_string(i) + "].above", found = formatQuantity(above, unit::metre);
        if (std::abs(above) >= half)
            problems.add(fluid, key,
                         "found " + found + ", which is not between the walls, at " +
                             formatQuantity(-half, unit::metre) + " and " + formatQuantity(half, unit::metre) +
                             " along " + axisName(wall));
        else if (i > 0 && above <= below)
            problems.add(fluid, key,
                         "found " + found + ", but the layer before it begins at " +
                             formatQuantity(below, unit::metre) + "; write the layers from the lowest up");
        else if (std::min(above - below, half - above) < (1 - 1e-6) * dx)
            problems.add(fluid, key,
                         "found " + found + ", which leaves a layer thinner than a spacing, " +
                             formatQuantity(dx, unit::metre) + "; nearest that fit: " +
                             formatQuantity(below + dx, unit::metre) + " to " + formatQuantity(half - dx, unit::metre));
    }
}

void checkApplication(const Case& c, Problems& problems) {
    if (c.control.application != "sphFlow") return;
    for (const auto& [isThere, what] : {std::pair(!c.mesh.cells.empty(), "cells"), {!c.mesh.bodies.empty(), "bodies"}})
        if (isThere)
            problems.add({"system/control.yaml", 0, 0}, "application",
                         fmt::format("found sphFlow, which is for a fluid alone, but system/mesh.yaml has {0}; write "
                                     "dmpFlow, or remove the {0}",
                                     what));
}

void checkDomain(const Case& c, Problems& problems) {
    const Mark mesh{"system/mesh.yaml", 0, 0};
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const bool hasWalls = c.hasWallsAcross(k);
        if (hasWalls && c.mesh.domain.periodic[axis])
            problems.add(mesh, "domain.periodic",
                         std::string("axis ") + axisName(k) + " is periodic, but the flow '" + c.flowModel.name +
                             "' has walls across it; write false for this axis");
        if (!hasWalls && !c.mesh.domain.periodic[axis])
            problems.add(mesh, "domain.periodic",
                         std::string("axis ") + axisName(k) + " is not periodic and has no walls; write true" +
                             (c.flowModel->walls() ? ", or give the flow walls across it in constant/flow.yaml" : ""));
        const double n = c.mesh.domain.size[k] / c.spacing();
        if (!(std::abs(c.latticeSpacing()[k] / c.spacing() - 1) <= 1e-3))
            problems.add(
                mesh, "domain.size",
                std::string("along ") + axisName(k) + " found " + formatQuantity(c.mesh.domain.size[k], unit::metre) +
                    ", which is not a whole number of spacings (" + formatQuantity(c.spacing(), unit::metre) +
                    "); nearest that fit: " + formatQuantity(std::max(1.0, std::floor(n)) * c.spacing(), unit::metre) +
                    ", " + formatQuantity(std::ceil(n) * c.spacing(), unit::metre));
    }
}

// Names, entries and shapes of all cells and bodies.
void checkSurfaces(const Case& c, Problems& problems) {
    std::set<std::string> names;
    for (const PlacedSurface& surface : surfacesOf(c.mesh)) {
        const std::string& name = surface.settings.name;
        if (!names.insert(name).second || io::isReservedStream(name))
            problems.add({"system/mesh.yaml", 0, 0}, surface.key + ".name",
                         "the name '" + name +
                             "' is taken; each cell and body needs its own, and fluid, walls, bodies, holes, fault and "
                             "what begins with fault_ are reserved");
        const std::string user = "the " + surface.kind + " '" + name + "' of system/mesh.yaml";
        if (surface.kind == "cell")
            requireEntry(c.membranes.types, static_cast<const CellSettings&>(surface.settings).type(), user,
                         {"constant/membranes.yaml", 0, 0}, problems);
        else
            requireEntry(c.bodies.types, static_cast<const BodyPlaceSettings&>(surface.settings).type(), user,
                         {"constant/bodies.yaml", 0, 0}, problems);
        checkSurface(c, surface, problems);
    }
    for (std::size_t i = 0; i < c.mesh.bodies.size(); ++i) {
        const BodyPlaceSettings& body = c.mesh.bodies[i];
        if (body.shape && c.planesAcross() && wrongScale(c, body).empty())
            checkBetweenPlanes(c, *body.shape, "body", {body.centre, body.axis, 1}, fmt::format("bodies[{}].centre", i),
                               problems);
    }
    int number = 0;  // number of the cell
    for (std::size_t i = 0; i < c.mesh.cells.size(); ++i) {
        const CellTypeSettings& cell = c.mesh.cells[i];
        const bool isRight = cell.shape && wrongScale(c, cell).empty();
        const std::string key = fmt::format("cells[{}]", i);
        if (isRight && c.numerics.isImmersed()) checkImmersed(c, cell, key, problems);
        checkTearLength(c, cell, key, problems);
        for (const geometry::Place& place : cell.standing()) {
            ++number;
            const std::string ofPlace = c.keyOfPlace(number);
            if (isRight && c.numerics.isImmersed())
                checkImmersedPlace(c, cell, place, cell.isPlacedByList() ? ofPlace : key + ".shape", problems);
            if (isRight && c.planesAcross()) checkBetweenPlanes(c, *cell.shape, "cell", place, ofPlace, problems);
        }
    }
}

void checkFirstBreak(const Case& c, Problems& problems) {
    const bool breaks = std::any_of(c.mesh.cells.begin(), c.mesh.cells.end(), [&](const CellSettings& cell) {
        const auto type = c.membranes.types.find(cell.type());
        return type != c.membranes.types.end() && type->second.rupture;
    });
    if (c.control.stop.firstBreak && !breaks)
        problems.add(
            {"system/control.yaml", 0, 0}, "stop.firstBreak",
            "found true, but nothing can break: no cell's entry of constant/membranes.yaml names a rupture law (" +
                joinWords(Registry<membrane::RuptureLaw>::instance().names()) + "); name one, or write false");
}

void checkFields(const Case& c, Problems& problems) {
    const std::vector<std::string>& fields = c.control.write.fields;
    if (!c.fluid.solute && std::find(fields.begin(), fields.end(), "concentration") != fields.end())
        problems.add({"system/control.yaml", 0, 0}, "write.fields",
                     "found concentration, but the fluid carries no solute; add 'solute' to constant/fluid.yaml, or "
                     "leave concentration out");
}

// What a solute and pores for it need of each other.
void checkSolute(const Case& c, Problems& problems) {
    bool isSome = c.fluid.solute && c.fluid.solute->concentration > 0;
    for (const auto& entry : c.membranes.types) isSome = isSome || entry.second.interior.concentration.value_or(0) > 0;
    if (c.fluid.solute && !isSome)
        problems.add({"constant/fluid.yaml", 0, 0}, "solute",
                     "found a solute that is nowhere: its concentration is 0 outside and inside of all cells; give "
                     "'interior: {concentration: 330 kg/m^3}' to a cell in constant/membranes.yaml, or 'concentration' "
                     "here, or remove solute");
    for (const auto& [name, laws] : c.membranes.types) {
        const Mark membranes{"constant/membranes.yaml", 0, 0};
        if (!c.fluid.solute) {
            const char* const cure = ", but the fluid carries no solute; add 'solute' to constant/fluid.yaml, or ";
            if (laws.interior.concentration)
                problems.add(membranes, name + ".interior.concentration",
                             "found a concentration" + (cure + std::string("leave it out")));
            if (laws.pores)
                problems.add(membranes, name + ".pores", "found pores" + (cure + std::string("write pores: none")));
        } else if (laws.pores && laws.pores->radius <= c.fluid.solute->radius)
            problems.add(membranes, name + ".pores.radius",
                         "found " + formatQuantity(laws.pores->radius, unit::metre) +
                             ", through which the solute of constant/fluid.yaml does not pass: its molecules have the "
                             "radius " +
                             formatQuantity(c.fluid.solute->radius, unit::metre) +
                             "; take larger pores, or another solute.radius");
    }
}

void checkContact(const Case& c, Problems& problems) {
    if (c.contact && c.mesh.cells.empty())
        problems.add(
            {"constant/contact.yaml", 0, 0}, "",
            "there is contact of membranes, but system/mesh.yaml has no cells; remove the file, or name cells");
}

void checkSupport(const Case& c, Problems& problems) {
    const double support = c.support() / c.spacing();
    if (!(support >= leastSupport && support <= largestSupport))
        problems.add({"system/numerics.yaml", 0, 0}, "kernel.support",
                     fmt::format("found {} dx, which reaches too {} neighbours; {:g} to {:g} dx, usually 2.4 to 3 dx",
                                 formatQuantity(support, unit::none), support > largestSupport ? "many" : "few",
                                 leastSupport, largestSupport));
}

}  // namespace

void checkTogether(const Case& c, Problems& problems) {
    checkApplication(c, problems);
    checkDomain(c, problems);
    checkSurfaces(c, problems);
    checkLayers(c, problems);
    schemes::check(c.numerics, c.written, c.facts(), problems);
    checkControl(c, problems);
    checkContact(c, problems);
    checkSolute(c, problems);
    checkSupport(c, problems);
}

void checkControl(const Case& c, Problems& problems) {
    checkFirstBreak(c, problems);
    checkFields(c, problems);
}

void checkIntervals(const Case& c, Problems& problems) {
    if (c.flow.shearRate > 0) return;
    const std::string noShear = "the flow '" + c.flowModel.name + "' has no shear rate to count strain with; give ";
    if (c.control.endStrain) problems.add({"system/control.yaml", 0, 0}, "endStrain", noShear + "endTime");
    if (c.control.write.strain) problems.add({"system/control.yaml", 0, 0}, "write.strain", noShear + "write.time");
}

void checkSizes(const Case& c, double shearModulus, Problems& problems) {
    constexpr double least = 1e-60, largest = 1e60;  // squares and products of a few such values do not overflow
    const double soundSpeed = c.soundSpeed();
    struct Value {
        const char* what;
        double size;
        Dimension dimension;
    };
    for (const auto& [what, size, dimension] :
         {Value{"the density of the fluid", c.flow.density, unit::kilogramPerMetre3},
          Value{"the shear modulus of the membrane", shearModulus, unit::newtonPerMetre},
          Value{"the shear rate", c.flow.shearRate, unit::perSecond},
          Value{"the speed", c.flow.speed, unit::metrePerSecond},
          Value{"the rate of the flow", c.flow.rate, unit::perSecond},
          Value{"the time in which the flow changes", c.flow.transient, unit::second},
          Value{"the speed of sound", soundSpeed, unit::metrePerSecond},
          Value{"the mass of a particle", c.particleMass(), {1, 0, 0}}}) {
        const double magnitude = std::abs(size);
        if (size == 0 || (magnitude >= least && magnitude <= largest)) continue;
        problems.add({"constant/flow.yaml", 0, 0}, "",
                     fmt::format("{} comes out as {}, which cannot be computed with: one of the values that it follows "
                                 "from (Ca, Re, viscosity, moduli, sizes) is far from anything real",
                                 what, formatQuantity(size, dimension)));
        return;  // the others depend on it
    }
}

std::vector<std::string> caseNotes(const Case& c) {
    std::vector<std::string> notes;
    const auto costs = schemes::predictCosts(c.written, c.facts());
    const auto taken = std::find_if(costs.begin(), costs.end(), [&](const schemes::IntegratorCost& cost) {
        return cost.name == c.numerics.integrator;
    });
    const double step = taken == costs.end() ? 0 : taken->step().seconds;
    for (const auto& [name, observer] : c.observers.models) {
        const Interval& every = observer->every;
        const bool isStrain = every.kind == Interval::Kind::strain && c.flow.shearRate > 0;
        if (!isStrain && every.kind != Interval::Kind::time) continue;
        const double seconds = isStrain ? every.value / c.flow.shearRate : every.value;
        if (seconds >= step) continue;
        const std::string least =
            isStrain ? fmt::format("{:.3g} strain", step * c.flow.shearRate) : formatQuantity(step, unit::second, 3);
        notes.push_back(
            fmt::format("system/observers.yaml: {}.every: an interval of {} is shorter than the predicted step of {}: "
                        "there will be one row for each step, at its end; for fewer rows write {} or more",
                        name, formatQuantity(seconds, unit::second), formatQuantity(step, unit::second, 3), least));
    }
    return notes;
}

std::vector<std::string> caseWarnings(const Case& c) {
    std::map<std::string, std::set<std::string>> taken;  // by kind
    for (const PlacedSurface& surface : surfacesOf(c.mesh))
        taken[surface.kind].insert(surface.kind == "cell"
                                       ? static_cast<const CellSettings&>(surface.settings).type()
                                       : static_cast<const BodyPlaceSettings&>(surface.settings).type());
    std::vector<std::string> words;
    const auto find = [&](const auto& entries, const std::string& file, const std::string& kind, const char* key) {
        const std::set<std::string>& names = taken[kind];
        const std::string others = names.empty() ? fmt::format("there is no {}", kind)
                                                 : "they take " + joinWords({names.begin(), names.end()});
        for (const auto& entry : entries)
            if (!names.contains(entry.first))
                words.push_back(fmt::format(
                    "{}: {}: no {} of system/mesh.yaml takes this entry, so that it has no effect ({}); remove it, or "
                    "name it in '{}' of a {}",
                    file, entry.first, kind, others, key, kind));
    };
    find(c.membranes.types, "constant/membranes.yaml", "cell", "membrane");
    find(c.bodies.types, "constant/bodies.yaml", "body", "body");
    // A case may well step over a start or a decay; a drive, hardly.
    const std::string unfit = c.flow.drive && !c.flow.drive->isSteady() ? c.scheme().unfit(c.facts(), c.numerics) : "";
    if (!unfit.empty()) words.push_back(fmt::format("system/numerics.yaml: {}: {}", c.numerics.integrator, unfit));
    return words;
}

}  // namespace corpuscle::simulation
