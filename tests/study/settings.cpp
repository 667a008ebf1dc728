// The cases that follow from a study.yaml, and the messages for an invalid one.
#include "study/studySettings.hpp"

#include <gtest/gtest.h>

#include <set>

#include "study/studyCases.hpp"

namespace corpuscle::study {
namespace {

struct Read {
    StudySettings settings;
    std::vector<std::string> order, problems;
};

Read read(const std::string& text) {
    Problems problems;
    const Node node = parseDictionary(text, "study.yaml", problems);
    Read result;
    result.settings = corpuscle::read<StudySettings>(node, problems);
    if (const Node* table = node.find("parameters"))
        for (const auto& [name, value] : table->entries) result.order.push_back(name);
    try {
        problems.throwIfAny();
    } catch (const CaseError& error) {
        for (const Problem& problem : error.problems()) result.problems.push_back(problem.text());
    }
    return result;
}

std::vector<StudyCase> casesFrom(const std::string& text) {
    const Read study = read(text);
    EXPECT_EQ(study.problems, std::vector<std::string>{});
    return casesOf(study.settings, study.order);
}

TEST(Study, NamesCasesByTheirValues) {
    const auto cases = casesFrom(
        "template: .\nparameters:\n"
        "  Ca: {key: constant/flow.yaml:/Ca, values: [0.02, 3]}\n"
        "  spacing: {key: system/numerics.yaml:/spacing, values: [0.5 um, 0.4 um]}\n"
        "  edge: {keys: [system/mesh.yaml:/cells/0/edge, system/mesh.yaml:/cells/1/edge], values: [0.525 um, 0.42 um], "
        "with: spacing}\n"
        "set: [system/control.yaml:/endStrain=6, 'system/mesh.yaml:/domain/size=[1 um, 2 um, 3 um]']\n");
    ASSERT_EQ(cases.size(), 4u);
    EXPECT_EQ(cases[1].name, "Ca0.02-spacing0.4um");
    std::vector<std::string> settings;
    for (const Override& change : cases[1].settings)
        settings.push_back(change.file + ":" + change.path + "=" + change.value);
    EXPECT_EQ(settings, (std::vector<std::string>{
                            "system/control.yaml:/endStrain=6", "system/mesh.yaml:/domain/size=[1 um, 2 um, 3 um]",
                            "constant/flow.yaml:/Ca=0.02", "system/numerics.yaml:/spacing=0.4 um",
                            "system/mesh.yaml:/cells/0/edge=0.42 um", "system/mesh.yaml:/cells/1/edge=0.42 um"}));
}

TEST(Study, ValuesOfAnyKindAndRanges) {
    const auto vectors = casesFrom(
        "template: .\nparameters: {size: {key: a:/b, values: [[1 um, 2 um, 3 um], {type: x, k: 2}, none]}}\n");
    EXPECT_EQ(vectors[0].values[0].second, "[1 um, 2 um, 3 um]");
    EXPECT_EQ(vectors[1].values[0].second, "{type: x, k: 2}");
    EXPECT_EQ(vectors[0].name, "size1um_2um_3um");
    const auto rates =
        casesFrom("template: .\nparameters: {rate: {key: a:/b, logRange: [10 1/s, 1000 1/s], count: 3}}\n");
    EXPECT_EQ(rates[1].values[0].second, "100 1/s");
    EXPECT_EQ(rates[1].name, "rate100_1_s");
    const auto ends = casesFrom("template: .\nparameters: {x: {key: a:/b, range: [1234567.5, 2e7], count: 3}}\n");
    EXPECT_EQ(ends[0].values[0].second + " " + ends[2].values[0].second, "1234567.5 2e7");
    std::set<std::string> narrow;
    for (const StudyCase& one :
         casesFrom("template: .\nparameters: {x: {key: a:/b, logRange: [1, 1.001], count: 5}}\n"))
        narrow.insert(one.values[0].second);
    EXPECT_EQ(narrow.size(), 5u);
    const auto linear = casesFrom("template: .\nparameters: {x: {key: a:/b, range: [-1, 1], count: 5}}\n");
    EXPECT_EQ(linear[1].values[0].second, "-0.5");
    EXPECT_EQ(linear[4].values[0].second, "1");
    const auto many = casesFrom(
        "template: .\nparameters: {x: {key: a:/b, range: [2 um, 4 um]}}\nsampling: {type: latinHypercube, samples: "
        "12}\n");
    ASSERT_EQ(many.size(), 12u);
    EXPECT_EQ(many[6].name, "case007");
    std::set<int> parts;
    for (const StudyCase& one : many) parts.insert(static_cast<int>((std::stod(one.values[0].second) - 2) * 6));
    EXPECT_EQ(parts.size(), 12u);
}

TEST(Study, NumbersCasesWhoseNamesWouldBeTheSame) {
    const auto cases = casesFrom("template: .\nparameters: {x: {key: a:/b, values: ['a b', ab]}}\n");
    EXPECT_EQ(cases[0].name, "case001");
    EXPECT_EQ(cases[1].name, "case002");
}

TEST(Study, SaysWhatIsWrong) {
    const auto only = [](const std::string& text) {
        const auto problems = read(text).problems;
        return problems.size() == 1 ? problems[0] : "problems: " + std::to_string(problems.size());
    };
    const std::string start = "template: .\nparameters:\n  x: ";
    EXPECT_EQ(
        only(start + "{key: flow.yaml/Ca, values: [1]}\n"),
        "study.yaml:3:12: parameters.x.key: found 'flow.yaml/Ca'; write FILE:/path, such as constant/flow.yaml:/Ca or "
        "system/mesh.yaml:/cells/0/edge");
    EXPECT_NE(only(start + "{key: a:/b, values: [1, 2, 1]}\n").find("'1' stands twice"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: []}\n").find("found no values"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, range: [1 um, 2 nm], count: 2}\n").find("in the same unit"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, range: [2, 1], count: 2}\n").find("'2' is not below '1'"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, logRange: [0, 1], count: 2}\n").find("not above zero"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, range: [1, few], count: 2}\n").find("'few' is not a number"),
              std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, range: [1, 2]}\n").find("no 'count'"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1], count: 2}\n").find("beside 'values'"), std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1, 2]}\n  y: {key: a:/c, values: [1], with: x}\n")
                  .find("both need the same number"),
              std::string::npos);
    EXPECT_NE(
        only(start + "{key: a:/b, values: [1, 2]}\n  y: {key: a:/c, values: [1, 2], with: z}\n").find("found 'z'"),
        std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\nresults: {D: {table: a/b, column: c, from: soon}}\n")
                  .find("no time and no strain"),
              std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\nset: [Ca=3]\n").find("expected FILE:/path/to/key=value"),
              std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\n  y: {key: a:/b, values: [2]}\n").find("'a:/b' is set by"),
              std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\n  y: {key: a:/b/c, values: [2]}\n").find("would have no effect"),
              std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\nset: [a:/b=3]\n").find("is set by 'set' too"), std::string::npos);
    EXPECT_NE(
        only(start + "{key: a:/b, values: [1]}\nresults: {x: {table: a/b, column: c}}\n").find("has this name already"),
        std::string::npos);
    EXPECT_NE(only(start + "{key: a:/b, values: [1]}\nsampling: gird\n").find("Did you mean 'grid'?"),
              std::string::npos);
    EXPECT_NE(only("template: .\nparameters: {}\n").find("found none; a study varies at least one"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle::study
