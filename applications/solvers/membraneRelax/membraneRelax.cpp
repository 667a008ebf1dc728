// membraneRelax: static equilibrium of a membrane without fluid under the loads of a protocol: a cell stretched by
// tweezers, inflated or at rest, or a flat sheet stretched and sheared.
//
// Reads system/relax.yaml and constant/membranes.yaml, meshes the cell or sheet, and writes
// postProcessing/relax/<name>.csv and results/<name>.pvd, in which the number of the stage takes the place of the time.
//
// Sample runs:
//     membraneRelax -case tutorials/tweezers
//     membraneRelax -case tutorials/tweezers -set 'system/relax.yaml:/cell/edge=0.3 um'
#include <fmt/core.h>

#include "core/application.hpp"
#include "core/runRecord.hpp"
#include "core/writable.hpp"
#include "io/csvSeries.hpp"
#include "io/vtkSeries.hpp"
#include "simulation/caseFiles.hpp"
#include "simulation/dictionaries.hpp"
#include "simulation/relaxSettings.hpp"
#include "simulation/resultsWriter.hpp"

using namespace corpuscle;

namespace {

struct Input {
    simulation::RelaxSettings relax;
    simulation::MembranesSettings membranes;
    std::vector<Node::Entry> effective;

    static Input read(const Application& app) {
        Problems problems;
        Input input;
        const std::set<std::string> misnamed = simulation::checkFiles(app, problems);
        const auto dictionary = [&](const std::string& file) {
            return misnamed.contains(file) ? Node() : app.dictionary(file, problems);
        };
        const Node relax = dictionary("system/relax.yaml");
        const Node membranes = dictionary("constant/membranes.yaml");
        problems.throwIfAny();
        input.relax = corpuscle::read<simulation::RelaxSettings>(relax, problems);
        input.membranes = corpuscle::read<simulation::MembranesSettings>(membranes, problems);
        problems.throwIfAny();
        simulation::requireEntry(input.membranes.types, input.relax.type(),
                                 "'" + input.relax.name() + "' of system/relax.yaml", membranes.mark, problems);
        problems.throwIfAny();
        if (input.relax.cell) input.relax.cell->shape->prepare(app.caseDirectory());
        input.effective = {{"system/relax.yaml", write(input.relax)},
                           {"constant/membranes.yaml", write(input.membranes)}};
        return input;
    }
};

// Writes the stages; holds the area and volume to which those of each stage are compared.
class Results {
  public:
    Results(const Application& app, const std::string& name, const membrane::Protocol& protocol,
            const membrane::Membrane& membrane, double edge)
        : protocol_(protocol),
          edge_(edge),
          area0_(membrane.area()),
          volume0_(membrane.network().isOpen() ? 0 : membrane.volume()),
          table_(app.communicator().handle(), app.caseDirectory(),
                 {"relax", membrane.name, "protocol " + name, Registry<membrane::Protocol>::instance().find(name)->text,
                  columns(protocol)}),
          surfaces_(app.communicator().handle(), app.caseDirectory(), membrane.name, 0, 0) {}

    // Writes a stage and returns its line for the log.
    std::string write(int stage, const membrane::Membrane& membrane, const membrane::EquilibriumReport& report) {
        const std::vector<double> measured = protocol_.measure(stage, membrane);
        const bool closed = volume0_ > 0;
        const double area = membrane.area(), volume = closed ? membrane.volume() : 0;
        const double areaStrain = area / area0_ - 1, volumeStrain = closed ? volume / volume0_ - 1 : 0;
        std::vector<double> row{static_cast<double>(stage)};
        row.insert(row.end(), measured.begin(), measured.end());
        row.insert(row.end(), {area, volume, areaStrain, volumeStrain, membrane.energy(),
                               static_cast<double>(report.iterations), report.residual});
        table_.row(row);
        io::PolyData surface = simulation::membranePiece(membrane, edge_);
        if (const auto& pores = membrane.laws().pores)  // at equilibrium, at rest
            surface.point.scalars["pores"] = pores->atRest(membrane.network(), membrane.laws(), membrane.position);
        surface.field["stage"] = stage;
        surfaces_.write(stage, std::nullopt, surface);
        std::string values;
        for (std::size_t k = 0; k < measured.size(); ++k)
            values += fmt::format("{}{} {:.5g}", k ? ", " : "", protocol_.columns()[k].header(), measured[k]);
        return fmt::format("stage {}, {}: {}; area {:+.3f} %, volume {:+.3f} %; {} iterations, residual {:.2g} N",
                           stage, protocol_.describe(stage), values, 100 * areaStrain, 100 * volumeStrain,
                           report.iterations, report.residual);
    }

  private:
    static std::vector<io::Column> columns(const membrane::Protocol& protocol) {
        std::vector<io::Column> all;
        for (const auto& some : {protocol.columnsBefore(), protocol.columns(), protocol.columnsAfter()})
            for (const membrane::Protocol::Column& c : some) all.push_back({c.name, c.unit, c.meaning});
        return all;
    }

    const membrane::Protocol& protocol_;
    double edge_, area0_, volume0_;  // 0: an open membrane, which encloses no volume
    io::CsvSeries table_;
    io::VtkSeries surfaces_;
};

// Each stage starts from the equilibrium of the stage before it. Throws Failure(numerics) for a stage without
// equilibrium.
void runStages(Application& app, const simulation::RelaxSettings& relax, membrane::Membrane& membrane,
               RunRecord& record) {
    const membrane::Protocol& protocol = *relax.protocol;
    io::clearTables(app.communicator().handle(), app.caseDirectory(), "protocol");
    Results results(app, relax.protocol.name, protocol, membrane, relax.edge());
    for (int stage = 0; stage < protocol.stages(); ++stage) {
        const membrane::Loads loads = protocol.apply(stage, membrane);
        const membrane::EquilibriumReport report =
            findEquilibrium(membrane, loads, {relax.tolerance, relax.forceScale, static_cast<int>(relax.iterations)});
        app.log().info("{}", results.write(stage, membrane, report));
        if (report.converged) continue;
        const std::string reason = fmt::format(
            "stage {} ({}): no equilibrium after {} iterations, the largest residual force is {:.3g} N. Take "
            "smaller steps between the stages of system/relax.yaml, or more 'iterations'",
            stage, protocol.describe(stage), report.iterations, report.residual);
        throw Failure(ExitCode::numerics, reason);
    }
    record.set("result", "stages", static_cast<long>(protocol.stages()));
    record.finish(ExitCode::done, "all stages in equilibrium");
    if (app.json()) record.print();
}

}  // namespace

int main(int argc, char* argv[]) {
    Application app("membraneRelax",
                    "A membrane without fluid, in equilibrium: tweezers, pipette, inflation, sheets, resting shapes.",
                    argc, argv,
                    {.samples = {"membraneRelax -case tutorials/tweezers",
                                 "membraneRelax -set 'system/relax.yaml:/cell/edge=0.3 um'"}});
    return app.run([&] {
        if (app.communicator().size() > 1) throw Failure(ExitCode::usage, "runs on one rank: run it without mpirun");
        app.announce();
        requireWritable(app.communicator(), {app.path("run.json.0000000.tmp"), app.path("results/.file.part"),
                                             app.path("postProcessing/.file.part")});
        const Input input = Input::read(app);  // 1. strict dictionaries, SI from here on
        membrane::Membrane membrane =
            input.relax.makeMembrane(app.caseDirectory(), input.membranes);  // 2. the membrane
        app.lockCase();
        app.openLog();
        simulation::refreshSchemas(app);
        app.log().info("{}: {} nodes, edge {}; protocol {}, {} stages", membrane.name, membrane.position.size(),
                       formatQuantity(input.relax.edge(), unit::metre), input.relax.protocol.name,
                       input.relax.protocol->stages());

        const auto kept = std::make_shared<RunRecord>(app.path("run.json"), app.name(), app.communicator());
        RunRecord& record = *kept;
        record.set("parameters", "nodes", static_cast<long>(membrane.position.size()));
        record.set("parameters", "commandLine", app.commandLine());
        record.write();
        app.keepRecord(kept);
        writeUsed(app.path("used.yaml"), input.effective, app.communicator());
        // 3. for each stage: loads, equilibrium, a row of the table and a surface
        runStages(app, input.relax, membrane, record);
        return ExitCode::done;
    });
}
