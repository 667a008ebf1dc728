#include "simulation/resultsWriter.hpp"

#include <algorithm>
#include <numeric>

#include "core/communicator.hpp"
#include "membrane/diagnostics.hpp"
#include "sph/localMean.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Scene;
using particles::Kind;

namespace {
// The entry at the time of a restart belongs to the previous run; entries of the restarted run begin after it.
double earliestOf(const Time& start) { return start.step == 0 ? start.t : start.t * (1 + 1e-8); }
}  // namespace

ResultsWriter::ResultsWriter(const Case& input, const Scene& scene, const Time& start)
    : ticker_(input.control.write.interval(), start),
      fields_(input.control.write.fields),
      fluid_(scene.system->comm(), input.directory, "fluid", static_cast<int>(input.control.write.keep.value_or(0)),
             earliestOf(start)) {
    const std::vector<coupling::CellType>& types = scene.cells.types();
    for (const coupling::CellType& type : types)
        types_.emplace_back(scene.system->comm(), input.directory, type.name,
                            static_cast<int>(input.control.write.keep.value_or(0)), earliestOf(start));
    if (std::any_of(types.begin(), types.end(), [](const coupling::CellType& type) { return !!type.settings.rupture; }))
        holes_.emplace(scene.system->comm(), input.directory, "holes",
                       static_cast<int>(input.control.write.keep.value_or(0)), earliestOf(start));
    if (scene.bodies)
        for (const bodies::Body& body : scene.bodies->all())
            bodies_.emplace_back(scene.system->comm(), input.directory, body.name,
                                 static_cast<int>(input.control.write.keep.value_or(0)), earliestOf(start));
}

std::vector<io::VtkSeries*> ResultsWriter::series() {
    std::vector<io::VtkSeries*> all{&fluid_};
    for (io::VtkSeries& one : types_) all.push_back(&one);
    for (io::VtkSeries& one : bodies_) all.push_back(&one);
    if (holes_) all.push_back(&*holes_);
    return all;
}

void ResultsWriter::change(const WriteSettings& settings, const Time& time) {
    ticker_ = Ticker(settings.interval(), time);
    fields_ = settings.fields;
    for (io::VtkSeries* one : series()) one->keep(static_cast<int>(settings.keep.value_or(0)));
}

void ResultsWriter::goBack(const Ticker& ticker, const Time& time) {
    ticker_ = ticker;
    for (io::VtkSeries* one : series()) one->goBack(time.t);
}

namespace {

// Offset and velocity of images that slide, for programs that draw surfaces across periodic faces.
std::map<std::string, double> imagesOf(const Periodicity& periodicity) {
    if (!periodicity.slides()) return {};
    return {{"slidingAxis", periodicity.slidingAxis()},
            {"imageOffset", periodicity.offset().x()},
            {"imageVelocity", periodicity.slide().x()}};
}

}  // namespace

io::PolyData ResultsWriter::fluidPiece(const Scene& scene) const {
    const auto& s = scene.store();
    const sph::FluidModel& model = scene.model();
    const auto wants = [&](const char* name) {
        return std::find(fields_.begin(), fields_.end(), name) != fields_.end();
    };
    io::PolyData data;
    auto& id = data.point.integers["id"];
    auto* side = wants("side") || scene.cells.exist() ? &data.point.integers["side"] : nullptr;
    auto* velocity = wants("velocity") ? &data.point.vectors["velocity"] : nullptr;
    auto* density = wants("density") ? &data.point.scalars["density"] : nullptr;
    auto* pressure = wants("pressure") ? &data.point.scalars["pressure"] : nullptr;
    auto* meanPressure = wants("meanPressure") ? &data.point.scalars["meanPressure"] : nullptr;
    auto* concentration = wants("concentration") ? &data.point.scalars["concentration"] : nullptr;
    std::vector<double> pressures, means;
    if (pressure || meanPressure)
        for (std::size_t i = 0; i < s.size(); ++i)
            pressures.push_back(model.equationOfState->pressure(s.density[i], model.density, model.soundSpeed));
    if (meanPressure) means = sph::localMean(*scene.system, *model.kernel, model.mass, pressures);
    auto& spacing = data.point.scalars["spacing"];
    const Periodicity& periodicity = scene.system->periodicity();
    data.field = imagesOf(periodicity);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.kindOf(i) != Kind::fluid) continue;
        Vec3 x = s.position(i), u = s.velocity(i);
        periodicity.wrap(x, u);
        data.points.push_back(x);
        id.push_back(s.id[i]);
        spacing.push_back(scene.spacing);
        if (side) side->push_back(s.optional().side ? s.side[i] : 0);
        if (velocity) velocity->push_back(u);
        if (density) density->push_back(s.density[i]);
        if (pressure) pressure->push_back(pressures[i]);
        if (meanPressure) meanPressure->push_back(means[i]);
        if (concentration) concentration->push_back(scene.solute ? scene.solute->concentration(s, i) : 0);
    }
    return data;
}

namespace {
void addNumbers(io::PolyData& data) {  // numbers of the nodes, as in the mesh in 0/
    auto& id = data.point.integers["id"];
    id.resize(data.points.size());
    std::iota(id.begin(), id.end(), 0);
}

// The arrays to which the damage of the law belongs.
auto& damageOf(const membrane::RuptureLaw& law, io::PolyData& data) {
    return law.damageOf() == membrane::RuptureLaw::DamageOf::nodes ? data.point.scalars : data.cell.scalars;
}
}  // namespace

io::PolyData membranePiece(const membrane::Membrane& m, double spacing) {
    const membrane::Network& network = m.network();
    io::PolyData data;
    if (m.canRupture()) data.point.integers["hole"] = membrane::holeOfNodes(network);
    if (!m.damage().empty()) damageOf(*m.laws().rupture, data)["damage"] = m.damage();
    if (!m.pores().empty()) data.point.scalars["pores"] = m.pores();
    data.points = m.position;
    data.triangles = network.triangles();
    addNumbers(data);
    data.point.vectors["force"] = m.force;
    data.point.vectors["velocity"] = m.velocity;
    data.point.scalars["stretch"] = membrane::nodeStretch(network, m.position);
    data.point.scalars["spacing"].assign(m.position.size(), spacing);
    data.cell.scalars["areaStrain"] = membrane::areaStrain(network, m.position);
    auto tensions = membrane::principalTensions(network, m.laws(), m.position);
    data.cell.scalars["tension1"] = std::move(tensions.tension1);
    data.cell.scalars["tension2"] = std::move(tensions.tension2);
    auto& broken = data.cell.integers["broken"];
    for (std::size_t t = 0; t < data.triangles.size(); ++t)
        broken.push_back(network.isBroken(static_cast<int>(t)) ? 1 : 0);
    return data;
}

io::PolyData typePiece(const Scene& scene, std::size_t type) {
    io::PolyData all;
    all.field = imagesOf(scene.system->periodicity());
    for (const char* name : {"force", "velocity"}) all.point.vectors[name];
    for (const char* name : {"stretch", "spacing"}) all.point.scalars[name];
    for (const char* name : {"areaStrain", "tension1", "tension2"}) all.cell.scalars[name];
    for (const char* name : {"id", "cell"}) all.point.integers[name];
    for (const char* name : {"broken", "cell"}) all.cell.integers[name];
    if (const auto& rupture = scene.cells.types()[type].settings.rupture) {
        all.point.integers["hole"];
        if (rupture->damageOf() != membrane::RuptureLaw::DamageOf::nothing) damageOf(*rupture, all)["damage"];
    }
    if (scene.cells.types()[type].settings.pores) all.point.scalars["pores"];
    const int rank = scene.system->decomposition().rank();
    for (const Cell& cell : scene.cells) {
        if (cell.type != type || !cell.isOwnedBy(rank)) continue;
        io::PolyData one = membranePiece(cell.membrane, scene.spacing);
        one.point.integers["cell"].assign(one.points.size(), cell.membrane.cell);
        one.cell.integers["cell"].assign(one.triangles.size(), cell.membrane.cell);
        io::append(all, one);
    }
    return all;
}

void addRims(const membrane::Membrane& m, io::PolyData& data) {
    auto& cells = data.cell.integers["cell"];
    auto& holes = data.cell.integers["hole"];
    std::int64_t number = 0;
    for (const std::vector<int>& rim : m.network().rims()) {
        const int first = static_cast<int>(data.points.size());
        auto& line = data.lines.emplace_back();
        for (const int node : rim) {
            line.push_back(static_cast<int>(data.points.size()));
            data.points.push_back(m.position[static_cast<std::size_t>(node)]);
        }
        line.push_back(first);
        cells.push_back(m.cell);
        holes.push_back(++number);
    }
}

io::PolyData bodyPiece(const Scene& scene, const bodies::Body& body, bool writer) {
    io::PolyData data;
    data.field = imagesOf(scene.system->periodicity());
    auto& velocity = data.point.vectors["velocity"];
    auto& spacing = data.point.scalars["spacing"];
    if (writer) data.points = body.nodes();
    addNumbers(data);
    if (!writer) return data;
    data.triangles = body.solid.surface.triangles;
    for (const Vec3& x : data.points) velocity.push_back(body.state.motion.at(x - body.state.centre));
    spacing.assign(data.points.size(), scene.spacing);
    return data;
}

void ResultsWriter::write(const Scene& scene, const Time& time) {
    int rank = 0;
    MPI_Comm_rank(scene.system->comm(), &rank);
    fluid_.write(time.t, time.strain(), fluidPiece(scene));
    io::PolyData rims;
    rims.cell.integers = {{"cell", {}}, {"hole", {}}};
    for (std::size_t type = 0; type < types_.size(); ++type)
        types_[type].write(time.t, time.strain(), typePiece(scene, type));
    for (const Cell& cell : scene.cells)
        if (cell.isOwnedBy(rank) && cell.membrane.network().brokenTriangles() > 0) addRims(cell.membrane, rims);
    if (holes_) {
        holes_->start();
        if (Communicator(scene.system->comm()).anyTrue(!rims.lines.empty())) holes_->write(time.t, time.strain(), rims);
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        bodies_[b].write(time.t, time.strain(), bodyPiece(scene, scene.bodies->all()[b], rank == 0));
    ++written_;
}

std::string writeFault(const Case& input, const Scene& scene, const Time& time, const Vec3& place) {
    constexpr double reach = 5;  // in supports
    const MPI_Comm comm = scene.system->comm();
    const auto& s = scene.store();
    io::PolyData near;
    auto &id = near.point.integers["id"], &kind = near.point.integers["kind"];
    auto& velocity = near.point.vectors["velocity"];
    auto& density = near.point.scalars["density"];
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i);
        if (!(scene.system->periodicity().shortest(x - place).norm() <= reach * input.support())) continue;
        near.points.push_back(x);
        id.push_back(s.id[i]), kind.push_back(s.kind[i]);
        velocity.push_back(s.velocity(i)), density.push_back(s.density[i]);
    }
    io::VtkSeries(comm, input.directory, "fault", 0, 0).write(time.t, time.strain(), near);
    for (std::size_t type = 0; type < scene.cells.types().size(); ++type)
        io::VtkSeries(comm, input.directory, "fault_" + scene.cells.types()[type].name, 0, 0)
            .write(time.t, time.strain(), typePiece(scene, type));
    return "results/fault.pvd";
}

}  // namespace corpuscle::simulation
