// The effect of a changed setting on a run that continues: settings are compared by value, not by spelling, and a
// change whose effect is not declared is never silent.
#include "core/settingsChange.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/registry.hpp"

namespace corpuscle {
namespace {

struct Shade {
    static constexpr const char* familyName = "shade of a test";
    virtual ~Shade() = default;
};
struct Red : Shade {
    double depth = 0;
    static const Schema<Red>& schema() {
        static const Schema<Red> s = Schema<Red>("red", "red").quantity("depth", &Red::depth, unit::metre, "of it");
        return s;
    }
};
struct Plain : Shade {
    static const Schema<Plain>& schema() {
        static const Schema<Plain> s("plain", "plain");
        return s;
    }
};
CORPUSCLE_REGISTER(Shade, Red, "red", "red");
CORPUSCLE_REGISTER(Shade, Plain, "plain", "plain");

struct Item {
    std::string name;
    std::optional<double> size;
    std::string label = "a";
    static const Schema<Item>& schema() {
        static const Schema<Item> s = Schema<Item>("item", "one of several")
                                          .name("name", &Item::name, "of it")
                                          .quantity("size", &Item::size, unit::metre, "of it")
                                          .text("label", &Item::label, "shown", {.fallback = "a"})
                                          .atRestart(AtRestart::noted, {"label"});
        return s;
    }
};

struct Sample {
    double spacing = 0, end = 0, modulus = 0;
    Length support;
    Vec3 centre = Vec3::Zero();
    std::vector<Item> items;
    std::map<std::string, Item> named;
    Choice<Shade> shade;
    long forgotten = 0;
    static const Schema<Sample>& schema() {
        static const Schema<Sample> s =
            Schema<Sample>("sample", "a dictionary")
                .quantity("spacing", &Sample::spacing, unit::metre, "dx", {.fallback = "0.5 um"})
                .quantity("end", &Sample::end, unit::second, "of the run", {.fallback = "1 s"})
                .quantity("modulus", &Sample::modulus, unit::newtonPerMetre, "k", {.fallback = "5 uN/m"})
                .length("support", &Sample::support, "H_s", {.fallback = "3 dx"})
                .vector("centre", &Sample::centre, unit::metre, "place", {.fallback = "[0 m, 0 m, 0 m]"})
                .list("items", &Sample::items, "several", {.fallback = "[]"})
                .map("named", &Sample::named, "by name", {.fallback = "{}"})
                .model("shade", &Sample::shade, "one of a family", {.fallback = "plain"})
                .integer("forgotten", &Sample::forgotten, "declares no policy", {.fallback = "1"})
                .atRestart(AtRestart::fixed, {"spacing", "support", "centre", "items", "named", "shade"})
                .atRestart(AtRestart::free, {"end"})
                .atRestart(AtRestart::noted, {"modulus"});
        return s;
    }
};

Node effective(const std::string& text) {
    Problems problems;
    const Sample sample = read<Sample>(parseDictionary(text, "sample.yaml", problems), problems);
    problems.throwIfAny();
    return write(sample);
}
const FieldInfo& dictionary() {
    static const FieldInfo field = dictionaryField([] { return Sample::schema().info(); });
    return field;
}
std::string changes(const std::string& before, const std::string& now, Spacings spacings = {5e-7, 5e-7}) {
    std::string text;
    for (const SettingChange& c : settingChanges(dictionary(), effective(before), effective(now), spacings))
        text += c.key + ": " + nameOf(c.policy) + ", " + c.before + " -> " + c.now + "\n";
    return text;
}

TEST(SettingChanges, ComparesValuesNotTheirSpelling) {
    for (const auto& [before, now] : std::vector<std::pair<std::string, std::string>>{
             {"spacing: 11 um\n", "spacing: 0.011 mm\n"},
             {"spacing: 1.1e-5 m\n", "spacing: 11000 nm\n"},
             {"support: 3 dx\n", "support: 1.5 um\n"},
             {"support: 1500 nm\n", "support: 3.0 dx\n"},
             {"centre: [1 um, 2 um, 3 um]\n", "centre: [0.001 mm, 2000 nm, 3e-6 m]\n"},
             {"shade: plain\n", "shade: {type: plain}\n"},
             {"items: [{name: a, size: 0.3 um}]\n", "items:\n  - name: a\n    size: 300 nm\n    label: a\n"},
             {"modulus: 5 uN/m\n", ""}})
        EXPECT_EQ(changes(before, now), "") << before << now;
}

TEST(SettingChanges, NamesEachWithItsPolicy) {
    for (const auto& [before, now, expected] : std::vector<std::tuple<std::string, std::string, std::string>>{
             {"spacing: 11 um\n", "spacing: 12 um\n", "spacing: fixed, 11 um -> 12 um\n"},
             {"end: 1 s\n", "end: 2 s\n", "end: free, 1 s -> 2 s\n"},
             {"modulus: 5 uN/m\n", "modulus: 6 uN/m\n", "modulus: noted, 5 uN/m -> 6 uN/m\n"},
             {"forgotten: 1\n", "forgotten: 2\n", "forgotten: fixed, 1 -> 2\n"},
             {"shade: {type: red, depth: 1 um}\n", "shade: {type: red, depth: 2 um}\n",
              "shade.depth: fixed, 1 um -> 2 um\n"},
             {"shade: plain\n", "shade: {type: red, depth: 2 um}\n",
              "shade: fixed, plain -> {type: red, depth: 2 um}\n"},
             {"items: [{name: a}]\n", "items: [{name: a}, {name: b}]\n",
              "items[1]: fixed, nothing -> {name: b, label: a}\n"},
             {"items: [{name: a}, {name: b}]\n", "items: [{name: b}, {name: a}]\n",
              "items[0].name: fixed, a -> b\nitems[1].name: fixed, b -> a\n"},
             {"items: [{name: a}]\n", "items: [{name: a, size: 1 um, label: b}]\n",
              "items[0].size: fixed, nothing -> 1 um\nitems[0].label: noted, a -> b\n"},
             {"named: {x: {name: a, size: 1 um}}\n", "named: {x: {name: a, size: 3 um}}\n",
              "named.x.size: fixed, 1 um -> 3 um\n"},
             {"centre: [0 um, 0 um, 0 um]\n", "centre: [2 um, 0 um, 0 um]\n",
              "centre: fixed, [0 m, 0 m, 0 m] -> [2 um, 0 m, 0 m]\n"}})
        EXPECT_EQ(changes(before, now), expected) << before << now;
}

TEST(SettingChanges, ALengthInSpacingsIsAnotherOneAtAnotherSpacing) {
    EXPECT_EQ(changes("support: 3 dx\n", "support: 3 dx\n", {5e-7, 6e-7}), "support: fixed, 3 dx -> 3 dx\n");
    EXPECT_EQ(changes("support: 3 dx\n", "support: 2.5 dx\n", {5e-7, 6e-7}), "");
}

TEST(SettingChanges, KeysOfAnotherVersionAreFixed) {
    Node before = effective(""), now = before;
    before.entries.emplace_back("gone", Node::word("1"));
    const auto found = settingChanges(dictionary(), before, now, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].key, "gone");
    EXPECT_EQ(found[0].policy, AtRestart::fixed);
    EXPECT_EQ(found[0].now, "nothing");
}

TEST(SettingChanges, DropsWhatIsFreeAndKeepsTheRest) {
    const Node kept = withoutFree(dictionary(), effective(""));
    EXPECT_EQ(kept.find("end"), nullptr);
    for (const char* key : {"spacing", "modulus", "forgotten"}) EXPECT_NE(kept.find(key), nullptr) << key;
}

TEST(DeclaredSettings, WalksTablesListsMapsAndModels) {
    std::map<std::string, AtRestart> all;
    for (const DeclaredSetting& setting : declaredSettings(dictionary())) all[setting.key] = setting.policy;
    EXPECT_EQ(all.at("spacing"), AtRestart::fixed);
    EXPECT_EQ(all.at("items[].label"), AtRestart::noted);
    EXPECT_EQ(all.at("items[].size"), AtRestart::fixed);
    EXPECT_EQ(all.at("named.<name>.size"), AtRestart::fixed);
    EXPECT_EQ(all.at("shade.red.depth"), AtRestart::fixed);
    EXPECT_EQ(all.at("forgotten"), AtRestart::undeclared);
    EXPECT_EQ(all.size(), 14u);
}

TEST(DeclaredSettings, APolicyOfAnUnknownKeyIsAFaultOfTheProgram) {
    for (const char* key : {"spacings", "", "items[]"})
        EXPECT_THROW(Schema<Sample>("wrong", "").atRestart(AtRestart::fixed, {key}), std::logic_error) << key;
}

}  // namespace
}  // namespace corpuscle
