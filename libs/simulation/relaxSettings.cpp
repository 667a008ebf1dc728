#include "simulation/relaxSettings.hpp"

#include "geometry/enclosedVolume.hpp"
#include "geometry/flatSheet.hpp"
#include "simulation/stressFree.hpp"

namespace corpuscle::simulation {

const Schema<SheetSettings>& SheetSettings::schema() {
    static const Schema<SheetSettings> s =
        Schema<SheetSettings>("sheet",
                              "a flat sheet across z with its middle at the origin, open: a rectangle or a disc")
            .name("name", &SheetSettings::name, "names its results")
            .name("membrane", &SheetSettings::membrane,
                  "its entry of constant/membranes.yaml; the sheet's own name when absent")
            .quantities("size", &SheetSettings::size, unit::metre, "of a rectangle, along x and y",
                        {.fallback = "[]", .range = positive})
            .quantity("diameter", &SheetSettings::diameter, unit::metre, "of a disc", {.range = positive})
            .quantity("edge", &SheetSettings::edge, unit::metre, "edge length of the mesh", {.range = positive})
            .quantity("disorder", &SheetSettings::disorder, unit::none,
                      "largest random displacement of the nodes inside along each axis, in edges",
                      {.fallback = "0", .range = between(0, 0.25)})
            .integer("seed", &SheetSettings::seed, "of the random numbers", {.fallback = "1", .range = nonNegative})
            .check([](const SheetSettings& s, const Node& node, Problems& problems) {
                const Node* size = node.find("size");
                if (s.size.empty() == !s.diameter)
                    problems.add(node.place(), node.path, "give either size, of a rectangle, or diameter, of a disc");
                else if (!s.diameter && s.size.size() != 2)
                    problems.add(size->mark, size->path,
                                 "found " + std::to_string(s.size.size()) +
                                     " lengths; a rectangle has two, along x and y, such as [8 um, 6 um]");
                else if (s.edge > s.radius())
                    problems.add(node.find("edge")->mark, node.find("edge")->path,
                                 "found " + formatQuantity(s.edge, unit::metre) +
                                     ", too coarse for this sheet; at most half its least side, " +
                                     formatQuantity(s.radius(), unit::metre));
            });
    return s;
}

double SheetSettings::radius() const { return 0.5 * (diameter ? *diameter : std::min(size[0], size[1])); }

const Schema<RelaxSettings>& RelaxSettings::schema() {
    static const Schema<RelaxSettings> s =
        Schema<RelaxSettings>("relax", "a membrane without fluid, in equilibrium stage by stage")
            .table("cell", &RelaxSettings::cell, "the cell; its centre and axis are not used")
            .table("sheet", &RelaxSettings::sheet, "a flat sheet in place of a cell")
            .exactlyOneOf({"cell", "sheet"})
            .model("protocol", &RelaxSettings::protocol, "what is done to the membrane")
            .quantity("tolerance", &RelaxSettings::tolerance, unit::none,
                      "largest residual force, relative to the largest load or to forceScale",
                      {.fallback = "1e-6", .range = positive})
            .quantity("forceScale", &RelaxSettings::forceScale, unit::newton,
                      "what a force of a node is compared with where loads are small",
                      {.fallback = "1 pN", .range = positive})
            .integer("iterations", &RelaxSettings::iterations, "of Newton's method, each stage at most",
                     {.fallback = "500", .range = atLeast(1)})
            .values("libs", &RelaxSettings::libs, pluginsText, {.fallback = "[]"})
            .check([](const RelaxSettings& s, const Node& node, Problems& problems) {
                if (!s.cell || !s.cell->edgeLength.inSpacings) return;
                const Node* edge = node.find("cell")->find("edge");
                problems.add(edge->mark, edge->path,
                             "found a length in particle spacings, but there are no particles here; give it in a unit "
                             "of length, such as 0.4 um");
            });
    return s;
}

membrane::Membrane RelaxSettings::makeMembrane(const std::filesystem::path& caseDirectory,
                                               const MembranesSettings& membranes) const {
    geometry::TriangleMesh mesh;
    if (cell) {
        mesh = geometry::meshEnclosing(*cell->shape, edge(), cell->enclosesExactly());
    } else {
        mesh = sheet->diameter ? geometry::disc(0.5 * *sheet->diameter, sheet->edge)
                               : geometry::rectangle(sheet->size[0], sheet->size[1], sheet->edge);
        geometry::disorder(mesh, sheet->disorder, static_cast<unsigned long>(sheet->seed));
    }
    const membrane::MembraneSettings& laws = membranes.types.at(type());
    Problems problems;
    std::vector<Vec3> stressFree = stressFreeNodes(caseDirectory, type(), laws, mesh, problems);
    problems.throwIfAny();
    return {name(),
            1,
            mesh.nodes,
            std::move(mesh.triangles),
            laws,
            cell ? cell->shape->radius() : sheet->radius(),
            std::move(stressFree)};
}

}  // namespace corpuscle::simulation
