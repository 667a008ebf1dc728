// Every byte of a checkpoint, and of a file of 0/, flipped in turn: what is then read is what was written, or an error.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <fstream>
#include <random>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "io/checkpointFile.hpp"
#include "io/dataChecksum.hpp"
#include "io/hdf5Handle.hpp"
#include "io/polyData.hpp"
#include "temporaryFolder.hpp"

namespace corpuscle::io {
namespace {

namespace fs = std::filesystem;

struct State {
    std::vector<double> place;
    std::vector<std::int64_t> id, bonds;
    double time = 0;
    std::int64_t step = 0;
    std::string scheme;
    // More in one group than HDF5 keeps in a header unless told to.
    std::array<double, 12> figures{}, sums{};
    bool operator==(const State&) const = default;
};
std::string numbered(const std::string& name, std::size_t k) { return name + std::to_string(k); }

State someState() {
    State s;
    std::mt19937 random(7);
    for (int i = 0; i < 60; ++i) {
        s.place.push_back(std::uniform_real_distribution(-1e-5, 1e-5)(random));
        if (i % 3 == 0) s.id.push_back(i / 3);
    }
    s.bonds = {1, 1, 0, 1};
    s.time = 1.25e-3, s.step = 4711, s.scheme = "implicit";
    for (std::size_t k = 0; k < s.figures.size(); ++k)
        s.figures[k] = 0.5 + static_cast<double>(k), s.sums[k] = 1 / s.figures[k];
    return s;
}

void save(const fs::path& path, const State& s) {
    CheckpointWriter file(MPI_COMM_WORLD, path);
    file.attribute("time", s.time);
    file.attribute("step", s.step);
    file.attribute("scheme", s.scheme);
    for (std::size_t k = 0; k < s.figures.size(); ++k) {
        file.attribute(numbered("figure", k), s.figures[k]);
        file.writeReplicated(numbered("sums/sum", k), std::span<const double>(&s.sums[k], 1));
    }
    file.writeDistributed("particles/place", std::span<const double>(s.place), 3);
    file.writeDistributed("particles/id", std::span<const std::int64_t>(s.id));
    file.writeReplicated("cells/rbc/bonds", std::span<const std::int64_t>(s.bonds));
    file.finish();
}

State load(const fs::path& path) {
    CheckpointReader file(MPI_COMM_WORLD, path);
    State s;
    s.time = file.attribute<double>("time");
    s.step = file.attribute<std::int64_t>("step");
    s.scheme = file.attribute<std::string>("scheme");
    for (std::size_t k = 0; k < s.figures.size(); ++k) {
        s.figures[k] = file.attribute<double>(numbered("figure", k));
        s.sums[k] = file.readReplicated<double>(numbered("sums/sum", k)).at(0);
    }
    s.place = file.readDistributed<double>("particles/place", 3);
    s.id = file.readDistributed<std::int64_t>("particles/id");
    s.bonds = file.readReplicated<std::int64_t>("cells/rbc/bonds");
    return s;
}

struct Damage {
    long accepted = 0, found = 0, changed = 0;  // accepted: the values read are those that were written
};

// check(): 0 accepted, 1 found, 2 changed.
template <class Check>
Damage flipAll(const fs::path& path, std::size_t stride, Check&& check) {
    Damage damage;
    const std::string whole = readFile(path);
    std::mt19937 random(11);
    for (std::size_t at = 0; at < whole.size(); at += stride) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ (1 << (random() % 8)));
        std::ofstream(path, std::ios::binary) << flipped;
        const int result = check();
        ++(result == 0 ? damage.accepted : result == 1 ? damage.found : damage.changed);
        if (result == 2) ADD_FAILURE() << "byte " << at << " of " << whole.size() << " was changed unseen";
    }
    std::ofstream(path, std::ios::binary) << whole;
    return damage;
}

TEST(Damage, ofACheckpointIsHarmlessOrFound) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "checkpoints");
    const fs::path path = folder.path() / "checkpoints" / "000003.h5";
    const State state = someState();
    save(path, state);
    ASSERT_EQ(checkCheckpoint(path), "");
    ASSERT_EQ(load(path), state);
    mallopt(M_PERTURB, 165);  // new memory is not zero, so that use of it before it is set is seen
    const Damage damage = flipAll(path, 5, [&] {
        const bool found = !checkCheckpoint(path).empty();
        try {
            const State read = load(path);
            // If the file can be loaded, its values must be those that were written.
            return read == state ? 0 : 2;
        } catch (const Failure&) {
            // Otherwise a restart would stop at this file instead of skipping it.
            return found ? 1 : 2;
        }
    });
    EXPECT_GT(damage.found, 300);
    EXPECT_GT(damage.accepted, 0);  // bytes that HDF5 does not use
    RecordProperty("found", static_cast<int>(damage.found));
    RecordProperty("accepted", static_cast<int>(damage.accepted));
}

// Lists of links and attributes outside the headers of groups are not read: HDF5 1.10 frees memory that it has not set
// where they are damaged.
TEST(Damage, listsOutsideHeadersAreRefused) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "000003.h5";
    const auto spoilt = [&](const auto& spoil) {
        save(path, someState());
        EXPECT_EQ(checkCheckpoint(path), "");
        {
            const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
            checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "format");
            const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose, "file");
            spoil(file);
        }
        return checkCheckpoint(path);
    };
    const auto groupOf = [](hid_t file, const std::string& name, int links) {
        const Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
        for (int k = 0; k < links; ++k)
            Handle(H5Gcreate2(group, numbered("g", static_cast<std::size_t>(k)).c_str(), H5P_DEFAULT, H5P_DEFAULT,
                              H5P_DEFAULT),
                   H5Gclose, name);
    };
    const std::string why = "its lists are not in the headers";
    EXPECT_NE(spoilt([&](hid_t file) { groupOf(file, "data/more", 20); }).find(why), std::string::npos);
    EXPECT_EQ(spoilt([&](hid_t file) { groupOf(file, "data/more", 4); }), "") << "short lists stay in the header";
    EXPECT_NE(spoilt([](hid_t file) {
                  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "creation");
                  checked(H5Pset_attr_phase_change(creation, 0, 0), "attributes");
                  checked(H5Ldelete(file, checkpoint::attributeGroup, H5P_DEFAULT), "group");
                  const Handle group(H5Gcreate2(file, checkpoint::attributeGroup, H5P_DEFAULT, creation, H5P_DEFAULT),
                                     H5Gclose, "group");
                  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "space");
                  Handle(H5Acreate2(group, "time", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "attribute");
              }).find(why),
              std::string::npos);
    const auto linkTo = [](hid_t file, const std::string& target, const std::string& name) {
        checked(H5Lcreate_hard(file, target.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
    };
    const std::string twice = "more than one link leads to a group";
    EXPECT_NE(spoilt([&](hid_t file) {
                  groupOf(file, "data/l0", 0);
                  for (int level = 1; level < 9; ++level) {
                      const std::string group = fmt::format("data/l{}", level);
                      groupOf(file, group, 0);
                      for (int k = 0; k < 8; ++k)
                          linkTo(file, fmt::format("data/l{}", level - 1), fmt::format("{}/g{}", group, k));
                  }
              }).find(twice),
              std::string::npos);
    EXPECT_NE(spoilt([&](hid_t file) { linkTo(file, "data", "data/data"); }).find(twice), std::string::npos);
}

TEST(Damage, ofOneCheckpointLeavesTheOneBefore) {
    const TemporaryFolder folder;
    const fs::path before = folder.path() / "checkpoints" / "000000.h5",
                   last = folder.path() / "checkpoints" / "000001.h5";
    save(before, someState());
    save(last, someState());
    const std::string whole = readFile(last);
    for (const std::string word : {"scheme", "implicit", "step", "contents", "checksum", "place"}) {
        std::string changed = whole;
        const std::size_t at = changed.find(word);
        ASSERT_NE(at, std::string::npos) << word;
        changed[at] ^= 4;
        std::ofstream(last, std::ios::binary) << changed;
        const CheckpointSearch found = latestCheckpoint(MPI_COMM_WORLD, folder.path());
        EXPECT_EQ(found.path, before) << word;
        ASSERT_EQ(found.warnings.size(), 1u) << word;
        EXPECT_NE(found.warnings[0].find("000001.h5"), std::string::npos);
    }
    std::ofstream(before, std::ios::binary) << whole.substr(0, whole.size() / 2);
    try {
        latestCheckpoint(MPI_COMM_WORLD, folder.path());
        FAIL() << "no checkpoint is intact";
    } catch (const Failure& failure) {
        const std::string text = failure.what();
        for (const char* word :
             {"none of the 2 checkpoints is intact", "000000.h5", "000001.h5", "startFrom: firstTime"})
            EXPECT_NE(text.find(word), std::string::npos) << text;
    }
}

PolyData sphereOfFour() {
    PolyData data;
    data.points = {Vec3(0, 0, 0), Vec3(1e-6, 0, 0), Vec3(0, 1e-6, 0), Vec3(0, 0, 1e-6)};
    data.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    data.point.integers["id"] = {0, 1, 2, 3};
    data.point.scalars["spacing"] = {5e-7, 5e-7, 5e-7, 5e-7};
    data.point.vectors["velocity"] = {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9), Vec3(1, 1, 1)};
    data.field = {{"TimeValue", 0}, {"strain", 0}};
    data.texts = {{"cell.edge", "6e-07 m"}, {"cell.shape.type", "spheroid"}};
    return data;
}

TEST(Damage, ofAStartIsHarmlessOrFound) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "rbc.vtp";
    const PolyData before = sphereOfFour();
    writeVtp(path, before);
    ASSERT_TRUE(readVtp(path).verified);
    const std::string whole = dataChecksum(before);
    // The structure of the XML text, which VTK's parser trusts, is covered by tests/fuzz; here bytes of the numbers,
    // names and values are changed.
    const std::string bytes = readFile(path);
    const std::size_t data = bytes.find("<AppendedData");
    const Damage damage = flipAll(path, 1, [&, at = std::size_t{0}]() mutable {
        if (at++ < data + 28) return 1;
        try {
            const PolyData after = readVtp(path);
            return !after.verified || dataChecksum(after) == whole ? 0 : 2;
        } catch (const Failure&) {
            return 1;
        }
    });
    EXPECT_GT(damage.found, 300);
}

TEST(Damage, ofNamesAndValuesChangesTheChecksum) {
    const PolyData before = sphereOfFour();
    const std::string whole = dataChecksum(before);
    EXPECT_EQ(whole.size(), 16u);
    const auto differs = [&](const auto& change) {
        PolyData after = before;
        change(after);
        return dataChecksum(after) != whole;
    };
    EXPECT_TRUE(differs([](PolyData& d) { d.points[2][1] = std::nextafter(d.points[2][1], 1.0); }));
    EXPECT_TRUE(differs([](PolyData& d) { std::swap(d.points[0], d.points[1]); }));
    EXPECT_TRUE(differs([](PolyData& d) { std::swap(d.triangles[0][0], d.triangles[0][1]); }));
    EXPECT_TRUE(differs([](PolyData& d) { d.triangles.pop_back(); }));
    EXPECT_TRUE(differs([](PolyData& d) { d.point.integers["id"][3] = 4; }));
    EXPECT_TRUE(differs([](PolyData& d) { d.point.scalars["spacinf"] = d.point.scalars.extract("spacing").mapped(); }));
    EXPECT_TRUE(differs([](PolyData& d) { d.point.vectors.clear(); }));
    EXPECT_TRUE(differs([](PolyData& d) { d.field["strain"] = 1e-300; }));
    EXPECT_TRUE(differs([](PolyData& d) { d.texts["cell.edge"] = "6e-07 n"; }));
    EXPECT_TRUE(differs([](PolyData& d) { d.texts["cell"] = ""; }));
    EXPECT_FALSE(differs([](PolyData& d) { d.texts["checksum"] = "any"; }));
}

}  // namespace
}  // namespace corpuscle::io
