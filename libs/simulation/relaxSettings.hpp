// system/relax.yaml: one cell or one flat sheet, the protocol applied to it, and the tolerances of its equilibria.
#pragma once
#include "membrane/protocol.hpp"
#include "simulation/caseSettings.hpp"

namespace corpuscle::simulation {

// A flat sheet, open: a rectangle or a disc (geometry/flatSheet.hpp).
struct SheetSettings {
    std::string name;
    std::optional<std::string> membrane;  // as for a cell
    std::vector<double> size;             // along x and y; m
    std::optional<double> diameter;       // m
    double edge = 0;                      // m
    double disorder = 0;                  // in edges
    long seed = 1;
    static const Schema<SheetSettings>& schema();
    double radius() const;  // half of the shorter side, or of the diameter
};

struct RelaxSettings {
    std::optional<CellSettings> cell;
    std::optional<SheetSettings> sheet;
    Choice<membrane::Protocol> protocol;
    double tolerance = 1e-6;  // relative to the largest load, or to forceScale
    double forceScale = 0;    // N; for stages without loads
    long iterations = 500;    // of Newton's method, at most, in each stage
    std::vector<std::string> libs = {};
    static const Schema<RelaxSettings>& schema();

    const std::string& name() const { return cell ? cell->name : sheet->name; }
    const std::string& type() const { return cell ? cell->type() : sheet->membrane ? *sheet->membrane : sheet->name; }
    double edge() const { return cell ? cell->edgeLength.value : sheet->edge; }
    // Meshes the cell or sheet and makes its membrane; the shape has been prepared (Shape::prepare). Throws CaseError
    // if the stress-free shape that the laws name does not belong to this mesh.
    membrane::Membrane makeMembrane(const std::filesystem::path& caseDirectory,
                                    const MembranesSettings& membranes) const;
};

}  // namespace corpuscle::simulation
