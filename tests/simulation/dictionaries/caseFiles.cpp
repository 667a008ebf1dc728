#include "simulation/caseFiles.hpp"

#include <gtest/gtest.h>

namespace corpuscle::simulation {
namespace {

const std::vector<std::string> good{
    "system/",          "constant/",           "system/control.yaml", "system/numerics.yaml",
    "system/mesh.yaml", "constant/fluid.yaml", "constant/flow.yaml"};

struct Outcome {
    std::vector<Problem> problems;
    std::set<std::string> meant;
    std::string text;
};

Outcome with(const std::vector<std::string>& more, const std::vector<std::string>& without = {}) {
    std::vector<std::string> files;
    for (const std::string& f : good)
        if (std::find(without.begin(), without.end(), f) == without.end()) files.push_back(f);
    files.insert(files.end(), more.begin(), more.end());
    Problems problems;
    Outcome outcome;
    outcome.meant = checkFiles(files, problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        outcome.problems = error.problems();
        outcome.text = error.what();
    }
    return outcome;
}

TEST(CaseFiles, whatBelongsThereAndWhatIsPassedOver) {
    EXPECT_EQ(with({}).text, "");
    EXPECT_EQ(
        with({"system/observers.yaml", "system/relax.yaml", "constant/membranes.yaml", "constant/bodies.yaml"}).text,
        "");
    EXPECT_EQ(with({"system/.mesh.yaml.swp", "system/mesh.yaml~", "system/#mesh.yaml#", "system/mesh.yaml.orig",
                    "system/mesh.yaml.bak", "system/README", "system/README.md", "constant/NOTES.txt",
                    "constant/cell.stl", "constant/stressFree.vtp", "constant/inflow.csv", "constant/old/",
                    "system/sketch.png", "constant/LICENSE", "constant/.DS_Store", "constant/shape.off"})
                  .text,
              "");
    // In the case folder itself any file is allowed.
    EXPECT_EQ(with({"used.yaml", "study.yaml", "notes.txt", "Allrun", "results/", "run.json", "plot.py"}).text, "");
}

TEST(CaseFiles, misspeltDictionariesNameTheOneMeant) {
    const auto expect = [](const std::string& file, const std::string& meant, const std::string& words) {
        const std::vector<std::string> without = meant.empty() ? std::vector<std::string>{} : std::vector{meant};
        const Outcome o = with({file}, without);
        ASSERT_EQ(o.problems.size(), 1u) << file << "\n" << o.text;
        EXPECT_EQ(o.problems[0].mark.text(), file);
        EXPECT_NE(o.text.find(words), std::string::npos) << file << "\n" << o.text;
        EXPECT_EQ(o.meant, meant.empty() ? std::set<std::string>{} : std::set{meant}) << file;
    };
    expect("system/observer.yaml", "system/observers.yaml", "Did you mean 'system/observers.yaml'?");
    expect("system/Observers.yaml", "system/observers.yaml", "Did you mean 'system/observers.yaml'?");
    expect("system/observers.yml", "system/observers.yaml", "Rename it to system/observers.yaml");
    expect("system/observers.yaml.txt", "system/observers.yaml", "Rename it to system/observers.yaml");
    expect("system/observers", "system/observers.yaml", "Rename it to system/observers.yaml");
    expect("system/controlDict", "system/control.yaml", "Did you mean 'system/control.yaml'?");
    expect("constant/membrane.yaml", "constant/membranes.yaml", "Did you mean 'constant/membranes.yaml'?");
    expect("system/membranes.yaml", "constant/membranes.yaml", "move it to constant/membranes.yaml");
    expect("constant/mesh.yaml", "system/mesh.yaml", "move it to system/mesh.yaml");
    expect("control.yaml", "system/control.yaml", "move it to system/control.yaml");
    expect("system/fvSchemes", "", "no program reads this file. Dictionaries of system/: control, numerics");
    expect("system/probes.yaml", "", "no program reads this file");
    expect("system/mesh.yml", "", "since system/mesh.yaml is there");
    expect("system/mesh_old.yaml", "", "may end with '.bak'");
}

TEST(CaseFiles, oneMessageForAFolder) {
    const std::vector<std::string> system{"system/", "system/control.yaml", "system/numerics.yaml", "system/mesh.yaml"};
    const Outcome o = with({"System/", "constants/"}, system);
    ASSERT_EQ(o.problems.size(), 1u) << o.text;
    EXPECT_NE(o.text.find("System/: no program reads this folder. Did you mean 'system/'?"), std::string::npos)
        << o.text;
    EXPECT_TRUE(o.meant.contains("system/control.yaml"));
    EXPECT_FALSE(o.meant.contains("constant/fluid.yaml"));
}

}  // namespace
}  // namespace corpuscle::simulation
