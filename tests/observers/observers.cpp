// The observers of a case: files, times, restart, rejected settings, and that observing changes nothing.
#include <gtest/gtest.h>

#include <cstring>

#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"
#include "support/registered.hpp"

namespace corpuscle::observers::testing {
namespace {

const geometry::TriangleMesh& sphere() {
    static const geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Sphere(3 * um), 0.8 * um);
    return mesh;
}

ObserversSettings settings(const std::string& text, const Subject& subject = {true, true, 1}) {
    Problems problems;
    const Node dictionary = parseDictionary(text, "system/observers.yaml", problems);
    const auto chosen = read<ObserversSettings>(dictionary, problems);
    problems.throwIfAny();
    chosen.check(dictionary, subject, problems);
    problems.throwIfAny();
    return chosen;
}

std::string whyNot(const std::string& text, const Scene& scene, double shearRate = 1) {
    const Subject subject{scene.cells.exist(), scene.flow.walls.exist(), shearRate};
    return messageOf<CaseError>(
        [&] { Observers(settings(text, subject), scene, Time{.dt = 0.1, .shearRate = shearRate}, "."); });
}

// All fields of the particles and of the held membranes, bit by bit.
std::string bits(const Scene& scene) {
    std::string all;
    const auto add = [&](const auto& array) {
        all.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(array[0]));
    };
    scene.store().forEachField([&](std::string_view, const auto& array) { add(array); });
    for (const coupling::Cell& cell : scene.cells) {
        add(cell.membrane.position), add(cell.membrane.velocity), add(cell.membrane.force);
        add(cell.membrane.network().aliveBonds());
    }
    return all;
}

TEST(Observers, FilesTimesAndNothingChanged) {
    Scene scene = sampleScene({.cells = {{"rbc", Vec3::Zero()}}, .surface = &sphere()});
    couple(scene);
    const TemporaryFolder folder;
    const auto names = settings(
        "deformation: {type: shape, every: 0.2 strain}\n"
        "balance: {type: conservation, every: 3 steps}\n"
        "breaks: {type: rupture, every: 0.5 s}\n"
        "u: {type: profile, every: 5 steps, bins: 4}\n");
    const std::string before = bits(scene);
    Time time{.dt = 0.1, .shearRate = 1};
    Observers observers(names, scene, time, folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "postProcessing"));  // a dry run writes nothing
    Communicator().barrier();
    for (observers.run(scene, time); time.step < 10; observers.run(scene, time)) time.advance(0.1);
    EXPECT_EQ(bits(scene), before);

    Observers restarted(names, scene, time, folder.path());
    restarted.restore(observers.state());
    for (restarted.run(scene, time); time.step < 20; restarted.run(scene, time)) time.advance(0.1);

    Communicator().barrier();
    const auto shape = io::readCsvSeries(folder.path(), "deformation", "rbc");
    ASSERT_EQ(shape.rows.size(), 11u);  // strain 0, 0.2 .. 2, each once
    EXPECT_EQ(shape.columns[0], "time_s");
    EXPECT_EQ(shape.columns[1], "strain");
    EXPECT_EQ(shape.columns[2], "cell");
    EXPECT_EQ(shape.columns[3], "D12_extent");
    for (std::size_t n = 0; n < 11; ++n) EXPECT_NEAR(shape.column("strain")[n], 0.2 * static_cast<double>(n), 1e-9);
    EXPECT_EQ(io::readCsvSeries(folder.path(), "balance", "conservation").rows.size(), 7u);  // steps 0, 3 .. 18
    EXPECT_EQ(io::readCsvSeries(folder.path(), "breaks", "rbc").rows.size(), 5u);
    EXPECT_TRUE(io::readCsvSeries(folder.path(), "breaks", "events").rows.empty());
    EXPECT_EQ(io::readCsvSeries(folder.path(), "u", "profile").rows.size(), 5u * 4u);
    EXPECT_EQ(io::readCsvSeries(folder.path(), "u", "profile").columns[6], "density_kg_m3");
}

TEST(Observers, NoneCostNothing) {
    Scene scene = sampleScene({});
    const TemporaryFolder folder;
    Observers none(ObserversSettings{}, scene, {}, folder.path());
    none.run(scene, {});
    EXPECT_TRUE(none.empty());
    EXPECT_TRUE(none.state().empty());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "postProcessing"));
}

TEST(Observers, StateKnowsItsObservers) {
    Scene scene = sampleScene({.cells = {{"rbc", Vec3::Zero()}}, .surface = &sphere()});
    couple(scene);
    const Time start{.dt = 0.1, .shearRate = 1};
    const std::string shape = "deformation: {type: shape, every: 0.1 strain}\n",
                      rupture = "holes: {type: rupture, every: 0.1 strain}\n";
    const auto state = Observers(settings(shape + rupture), scene, start, ".").state();
    EXPECT_FALSE(state.empty());
    Observers other(settings(rupture + "more: {type: shape, every: 1 steps}\n"), scene, start,
                    ".");  // one observer is gone, one is new
    EXPECT_NO_THROW(other.restore(state));
    EXPECT_THROW(other.restore({state.begin(), state.end() - 1}), Failure);
}

TEST(Observers, RefusalsNameThePlaceAndTheWayOut) {
    const Scene fluid = sampleScene({});
    for (const std::string type : {"shape", "rupture"}) {
        const std::string text =
            whyNot("a: {type: conservation, every: 1 s}\nb: {type: " + type + ", every: 1 steps}\n", fluid);
        EXPECT_NE(text.find("system/observers.yaml:2"), std::string::npos) << text;
        EXPECT_NE(text.find("the case has none"), std::string::npos) << text;
        EXPECT_NE(text.find("system/mesh.yaml"), std::string::npos) << text;
    }
    EXPECT_NE(whyNot("a: {type: wallStress, every: 1 s}\n", fluid).find("constant/flow.yaml"), std::string::npos);
    EXPECT_NE(whyNot("a: {type: profile, every: 0.1 strain}\n", fluid, 0).find("no shear rate"), std::string::npos);
    EXPECT_NE(whyNot("a: {type: profil, every: 1 s}\n", fluid).find("Did you mean 'profile'"), std::string::npos);
    EXPECT_NE(whyNot("a: {type: profile}\n", fluid).find("every"), std::string::npos);
    EXPECT_NE(whyNot("a: {type: profile, every: 0 s}\n", fluid), "");
    EXPECT_NE(whyNot("a: {type: profile, every: 1 s, bin: 3}\n", fluid).find("bins"), std::string::npos);
    EXPECT_EQ(whyNot("a: {type: profile, every: 1 s}\n", fluid), "");

    Scene cells = sampleScene({.cells = {{"events", Vec3::Zero()}}, .surface = &sphere()});
    EXPECT_NE(whyNot("a: {type: shape, every: 2 strain}\n", cells).find("1.5 strain"), std::string::npos);
    EXPECT_NE(whyNot("a: {type: shape, every: 2 s}\n", cells).find("1.5 strain"), std::string::npos);
    EXPECT_EQ(whyNot("a: {type: shape, every: 1.5 strain}\n", cells), "");
    EXPECT_NE(whyNot("a: {type: rupture, every: 1 s}\n", cells).find("events.csv"), std::string::npos);
}

TEST(Observers, EveryModelIsThere) {
    EXPECT_EQ(
        corpuscle::support::missing<Observer>({"body", "cellFreeLayer", "conservation", "flowRate", "haemolysis",
                                               "profile", "rupture", "section", "shape", "suspension", "wallStress"}),
        std::vector<std::string>());
}

}  // namespace
}  // namespace corpuscle::observers::testing
