// Rims of holes in the results: they are those that the observer rupture measures, and are written from the first hole
// on.
#include "simulation/resultsWriter.hpp"

#include <gtest/gtest.h>

#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"

namespace corpuscle::simulation {
namespace {

using namespace observers::testing;
using coupling::Scene;

Scene twoCells(const std::string& rupture) {
    static const geometry::TriangleMesh sphere = geometry::meshSurface(geometry::Sphere(3 * um), 0.8 * um);
    return sampleScene({.size = Vec3(20 * um, 12 * um, 12 * um),
                        .cells = {{"a", Vec3(-5 * um, 0, 0)}, {"b", Vec3(5 * um, 0, 0)}},
                        .surface = &sphere,
                        .rupture = rupture});
}

// Pulls nodes of a cell outwards by an eighth of the radius.
void pull(Scene& scene, std::size_t cell, const std::vector<int>& nodes) {
    const auto& rest = networkOf(scene, cell).stressFree();
    const Vec3 centre = cell == 0 ? Vec3(-5 * um, 0, 0) : Vec3(5 * um, 0, 0);
    deform(scene, cell, [&](const Vec3& x) {
        const bool far =
            std::any_of(nodes.begin(), nodes.end(), [&](int n) { return rest[static_cast<std::size_t>(n)] == x; });
        return far ? Vec3(x + 0.13 * (x - centre)) : x;
    });
}

Case writingTo(const std::filesystem::path& folder) {
    Case input;
    input.directory = folder;
    input.control.write.steps = 1;
    return input;
}

// Read on all ranks, after the writer has finished.
std::vector<io::SeriesEntry> entries(const std::filesystem::path& folder) {
    Communicator().barrier();
    const auto index = folder / "results" / "holes.pvd";
    auto found = std::filesystem::exists(index) ? io::readPvd(index) : std::vector<io::SeriesEntry>{};
    Communicator().barrier();
    return found;
}

TEST(Results, RimsOfHolesAreClosedLinesWithTheNumbersOfTheObserver) {
    const TemporaryFolder folder;
    Scene scene = twoCells("{type: bondStretch, limit: 1.05}");
    couple(scene);
    const Case input = writingTo(folder.path());
    Time time{.dt = 0.1};
    ResultsWriter writer(input, scene, time);
    writer.write(scene, time);
    Communicator().barrier();
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results" / "holes.pvd")) << "no hole yet";
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results" / "holes"));

    const int far = static_cast<int>(networkOf(scene, 0).nodeCount()) - 1;
    pull(scene, 0, {5});
    pull(scene, 1, {5, far});
    scene.coupling->endStep(*scene.system, 0);
    time.advance(0.1);
    writer.write(scene, time);

    const auto written = entries(folder.path());
    ASSERT_EQ(written.size(), 1u);
    EXPECT_EQ(written[0].time, 0.1);
    const io::PolyData rims = io::readPvtp(written[0].file);
    const auto observer = begin("{type: rupture, every: 1 steps}", scene);
    auto rows = observer->observe(scene, time);
    std::erase_if(rows, [](const observers::Row& row) { return row.table != 3; });
    ASSERT_EQ(rows.size(), 3u);
    ASSERT_EQ(rims.lines.size(), rows.size());
    for (std::size_t k = 0; k < rims.lines.size(); ++k) {
        const std::vector<int>& line = rims.lines[k];
        const double cell = static_cast<double>(rims.cell.integer("cell")[k]),
                     hole = static_cast<double>(rims.cell.integer("hole")[k]);
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const observers::Row& r) {
            return r.values[0] == cell && r.values[1] == hole;
        });
        ASSERT_NE(row, rows.end()) << cell << ' ' << hole;
        EXPECT_EQ(line.front(), line.back());
        EXPECT_EQ(static_cast<double>(line.size() - 1), row->values[2]);
        double perimeter = 0;
        Vec3 middle = Vec3::Zero();
        for (std::size_t n = 1; n < line.size(); ++n) {
            const Vec3 &from = rims.points[static_cast<std::size_t>(line[n - 1])],
                       &to = rims.points[static_cast<std::size_t>(line[n])];
            perimeter += (to - from).norm();
            middle += to / static_cast<double>(line.size() - 1);
        }
        EXPECT_NEAR(perimeter, row->values[3], 1e-12 * perimeter);
        EXPECT_LT((middle - Vec3(&row->values[5])).norm(), 1e-12 * um);
        rows.erase(row);
    }
}

TEST(Results, ARunFromBeforeTheFirstHoleTakesItsRimsAway) {
    const TemporaryFolder folder;
    const Case input = writingTo(folder.path());
    Time time{.dt = 0.1};
    {
        Scene scene = twoCells("{type: bondStretch, limit: 1.05}");
        couple(scene);
        pull(scene, 0, {5});
        scene.coupling->endStep(*scene.system, 0);
        time.advance(0.1);
        ResultsWriter(input, scene, time).write(scene, time);
        EXPECT_EQ(entries(folder.path()).size(), 1u);
    }
    Scene scene = twoCells("{type: bondStretch, limit: 1.05}");
    couple(scene);
    ResultsWriter(input, scene, Time{.dt = 0.1}).write(scene, Time{.dt = 0.1});
    EXPECT_TRUE(entries(folder.path()).empty());
}

TEST(Results, NoRimsWhereNothingCanRupture) {
    const TemporaryFolder folder;
    Scene scene = twoCells("none");
    couple(scene);
    const Time time{.dt = 0.1};
    ResultsWriter(writingTo(folder.path()), scene, time).write(scene, time);
    Communicator().barrier();
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results" / "a.pvd"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "results" / "holes.pvd"));
}

}  // namespace
}  // namespace corpuscle::simulation
