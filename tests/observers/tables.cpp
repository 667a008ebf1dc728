// Every column of every observer has a description and a unit, and the tables of a scene are among the documented ones.
#include <gtest/gtest.h>

#include <set>

#include "geometry/spheroid.hpp"
#include "observers/sampleScene.hpp"

namespace corpuscle::observers::testing {
namespace {

std::shared_ptr<const Observer> sample(const std::string& name) {
    Problems missing;
    return Registry<Observer>::instance().find(name)->make(Node{}, missing);
}

TEST(Tables, EveryColumnHasAMeaning) {
    for (const std::string& name : Registry<Observer>::instance().names()) {
        const std::vector<Table> tables = sample(name)->tables(SceneParts::all());
        EXPECT_FALSE(tables.empty()) << name;
        for (const Table& table : tables) {
            std::set<std::string> headers{"time_s", "strain"};
            for (const io::Column& column : table.columns) {
                const std::string where = name + ", " + table.file + ", " + column.header();
                EXPECT_GE(column.meaning.size(), 5u) << where << " has no meaning";
                EXPECT_EQ(column.meaning.find('\n'), std::string::npos) << where;
                EXPECT_TRUE(headers.insert(column.header()).second) << where << " is there twice";
            }
        }
    }
    for (const io::Column& column : timeColumns()) EXPECT_FALSE(column.meaning.empty());
}

TEST(Tables, ASceneHasWhatIsDocumented) {
    const geometry::TriangleMesh mesh = geometry::meshSurface(geometry::Sphere(3 * um), 0.8 * um);
    Scene scene = sampleScene({.cells = {{"<cell>", Vec3::Zero()}}, .surface = &mesh});
    couple(scene);
    for (const std::string type : {"shape", "rupture", "conservation", "profile"}) {
        const auto all = sample(type)->tables(SceneParts::all());
        const auto observation = begin("{type: " + type + ", every: 1 s}", scene);
        for (const Table& table : observation->tables()) {
            const auto documented =
                std::find_if(all.begin(), all.end(), [&](const Table& t) { return t.file == table.file; });
            ASSERT_NE(documented, all.end()) << type << ", " << table.file;
            for (const io::Column& c : table.columns) EXPECT_NO_THROW(column(*documented, c.header())) << type;
        }
        for (const Row& row : observation->observe(scene, {}))
            EXPECT_EQ(row.values.size(), observation->tables()[row.table].columns.size()) << type;
    }
}

}  // namespace
}  // namespace corpuscle::observers::testing
