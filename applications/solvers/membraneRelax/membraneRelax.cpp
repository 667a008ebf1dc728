// membraneRelax: a membrane without fluid, in static equilibrium under the loads of a protocol: stretched by tweezers, inflated, at
// rest.
//
// Reads system/relax.yaml and constant/membranes.yaml, meshes the cell, and writes postProcessing/relax/0/<cell>.csv and
// results/<cell>.pvd, whose times are the numbers of the stages.
//
// Sample runs:
//     membraneRelax -case tutorials/tweezers
//     membraneRelax -case tutorials/tweezers -set 'system/relax.yaml:/cell/edge=0.3 um'
#include <fmt/core.h>

#include "core/application.hpp"
#include "core/runRecord.hpp"
#include "geometry/mesher.hpp"
#include "io/csvSeries.hpp"
#include "io/vtkSeries.hpp"
#include "membrane/diagnostics.hpp"
#include "simulation/relaxSettings.hpp"
#include "simulation/stressFree.hpp"

using namespace corpuscle;

namespace {

struct Input {
    simulation::RelaxSettings relax;
    simulation::MembranesSettings membranes;
    std::vector<Node::Entry> effective;

    const membrane::MembraneSettings& laws() const { return membranes.types.at(relax.cell.type()); }

    static Input read(const Application& app) {
        Problems problems;
        Input input;
        const Node relax = app.dictionary("system/relax.yaml", problems);
        const Node membranes = app.dictionary("constant/membranes.yaml", problems);
        problems.throwIfAny();
        input.relax = corpuscle::read<simulation::RelaxSettings>(relax, problems);
        input.membranes = corpuscle::read<simulation::MembranesSettings>(membranes, problems);
        problems.throwIfAny();
        if (!input.membranes.types.contains(input.relax.cell.type())) {
            std::vector<std::string> known;
            for (const auto& [name, type] : input.membranes.types) known.push_back(name);
            problems.add(membranes.mark, input.relax.cell.type(),
                         "the cell of system/relax.yaml needs an entry of this name; there are: " + joinWords(known) +
                             "." + didYouMean(input.relax.cell.type(), known));
        }
        input.relax.cell.shape->prepare(app.caseDirectory());
        problems.throwIfAny();
        input.effective = {{"system/relax.yaml", write(input.relax)},
                           {"constant/membranes.yaml", write(input.membranes)}};
        return input;
    }
};

membrane::Membrane makeCell(const Application& app, const Input& input) {
    const simulation::CellSettings& settings = input.relax.cell;
    const geometry::TriangleMesh mesh = geometry::meshSurface(*settings.shape, settings.edge);
    Problems problems;
    membrane::Membrane cell(
        settings.name, 1,
        simulation::stressFreeNodes(app.caseDirectory(), settings.type(), input.laws(), mesh, problems), mesh.triangles,
        input.laws(), settings.shape->radius());
    problems.throwIfAny();
    cell.position = mesh.nodes;
    return cell;
}

// "force_N" -> {"force", "N"}.
io::Column column(const std::string& name) {
    const std::size_t bar = name.rfind('_');
    return bar == std::string::npos ? io::Column{name, ""} : io::Column{name.substr(0, bar), name.substr(bar + 1)};
}

io::PolyData piece(const membrane::Membrane& cell, const membrane::MembraneSettings& laws, int stage) {
    io::PolyData data;
    data.field["stage"] = stage;
    data.points = cell.position;
    data.triangles = cell.network().triangles();
    data.point.vectors["force"] = cell.force;
    data.point.scalars["stretch"] = membrane::nodeStretch(cell.network(), cell.position);
    data.cell.scalars["areaStrain"] = membrane::areaStrain(cell.network(), cell.position);
    membrane::PrincipalTensions tensions = membrane::principalTensions(cell.network(), laws, cell.position);
    data.cell.scalars["tension1"] = std::move(tensions.tension1);
    data.cell.scalars["tension2"] = std::move(tensions.tension2);
    return data;
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("membraneRelax", "A membrane without fluid, in equilibrium: tweezers, inflation, resting shapes.",
                    argc, argv,
                    {.samples = {"membraneRelax -case tutorials/tweezers",
                                 "membraneRelax -set 'system/relax.yaml:/cell/edge=0.3 um'"}});
    return app.run([&] {
        if (app.communicator().size() > 1) throw Failure(ExitCode::usage, "runs on one rank: run it without mpirun");
        app.openLog();
        const Input input = Input::read(app);
        const simulation::RelaxSettings& relax = input.relax;
        const membrane::Protocol& protocol = *relax.protocol;
        membrane::Membrane cell = makeCell(app, input);
        const double area0 = cell.area(), volume0 = cell.volume();
        app.log().info("cell {}: {}, {} nodes, edge {}; protocol {}, {} stages", cell.name, relax.cell.shape.name,
                       cell.position.size(), formatQuantity(relax.cell.edge, unit::metre), relax.protocol.name,
                       protocol.stages());

        RunRecord record(app.path("run.json"), app.name(), app.communicator());
        record.set("parameters", "nodes", static_cast<long>(cell.position.size()));
        record.set("parameters", "commandLine", app.commandLine());
        record.write();
        writeUsed(app.path("used.yaml"), input.effective, app.communicator());
        std::vector<io::Column> columns{{"stage", ""}};
        for (const std::string& name : protocol.columns()) columns.push_back(column(name));
        for (const char* name : {"area_m2", "volume_m3", "areaStrain", "volumeStrain", "energy_J"})
            columns.push_back(column(name));
        columns.push_back({"iterations", ""}), columns.push_back({"residual", "N"});
        io::CsvSeries table(app.communicator().handle(), app.caseDirectory(), "relax", 0, cell.name, columns);
        io::VtkSeries results(app.communicator().handle(), app.caseDirectory(), cell.name, 0, 0);

        for (int stage = 0; stage < protocol.stages(); ++stage) {
            const membrane::Loads loads = protocol.apply(stage, cell);
            const membrane::EquilibriumReport report =
                findEquilibrium(cell, loads, {relax.tolerance, relax.forceScale, static_cast<int>(relax.iterations)});
            std::vector<double> row{static_cast<double>(stage)};
            const std::vector<double> measured = protocol.measure(stage, cell);
            row.insert(row.end(), measured.begin(), measured.end());
            const double area = cell.area(), volume = cell.volume();
            row.insert(row.end(), {area, volume, area / area0 - 1, volume / volume0 - 1, cell.energy(),
                                   static_cast<double>(report.iterations), report.residual});
            table.row(row);
            results.write(stage, std::nullopt, piece(cell, input.laws(), stage));
            std::string values;
            for (std::size_t k = 0; k < measured.size(); ++k)
                values += fmt::format("{}{} {:.5g}", k ? ", " : "", protocol.columns()[k], measured[k]);
            app.log().info("stage {}, {}: {}; area {:+.3f} %, volume {:+.3f} %; {} iterations, residual {:.2g} N",
                           stage, protocol.describe(stage), values, 100 * (area / area0 - 1),
                           100 * (volume / volume0 - 1), report.iterations, report.residual);
            if (!report.converged) {
                const std::string reason = fmt::format(
                    "stage {} ({}): no equilibrium after {} iterations, the largest residual force is {:.3g} N. Take "
                    "smaller steps between the stages of system/relax.yaml, or more 'iterations'",
                    stage, protocol.describe(stage), report.iterations, report.residual);
                record.finish(ExitCode::numerics, reason);
                throw Failure(ExitCode::numerics, reason);
            }
        }
        record.set("result", "stages", static_cast<long>(protocol.stages()));
        record.finish(ExitCode::done, "all stages in equilibrium");
        return ExitCode::done;
    });
}
