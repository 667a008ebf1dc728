#include "core/registry.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

struct SpringLaw {
    static constexpr const char* familyName = "spring law";
    virtual ~SpringLaw() = default;
    virtual double force(double stretch) const = 0;
};

struct Linear : SpringLaw {
    double k = 0;
    double force(double stretch) const override { return -k * stretch; }
    static const Schema<Linear>& schema() {
        static const Schema<Linear> s =
            Schema<Linear>("linear", "F = -k s")
                .quantity("k", &Linear::k, unit::newtonPerMetre, "spring constant", {.range = positive});
        return s;
    }
};
CORPUSCLE_REGISTER(SpringLaw, Linear, "linear", "linear spring");

struct Slack : SpringLaw {
    double force(double) const override { return 0; }
    static const Schema<Slack>& schema() {
        static const Schema<Slack> s = Schema<Slack>("slack", "no force");
        return s;
    }
};
CORPUSCLE_REGISTER(SpringLaw, Slack, "slack", "no force at all");

struct Membrane {
    Choice<SpringLaw> bonds, tether;
    static const Schema<Membrane>& schema() {
        static const Schema<Membrane> s =
            Schema<Membrane>("membrane", "one membrane")
                .model("bonds", &Membrane::bonds, "law of the bonds")
                .modelOr("none", "tether", &Membrane::tether, "law of the tether", {.fallback = "none"});
        return s;
    }
};

struct AllBonds {
    std::map<std::string, Choice<SpringLaw>> bonds;
    static const Schema<AllBonds>& schema() {
        static const Schema<AllBonds> s =
            Schema<AllBonds>("bonds.yaml", "all").models("*", &AllBonds::bonds, "one law for each name");
        return s;
    }
};

template <class T>
std::pair<T, std::string> readText(const std::string& yaml) {
    Problems problems;
    T value = read<T>(parseDictionary(yaml, "f.yaml", problems), problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& e) {
        return {value, e.what()};
    }
    return {value, ""};
}

TEST(Registry, modelsAreChosenByTableOrByBareName) {
    const auto [m, text] = readText<Membrane>("bonds: {type: linear, k: 2 N/m}\ntether: slack\n");
    ASSERT_EQ(text, "");
    EXPECT_EQ(m.bonds.name, "linear");
    EXPECT_EQ(m.bonds->force(0.5), -1);
    EXPECT_EQ(m.tether->force(0.5), 0);
    EXPECT_FALSE(readText<Membrane>("bonds: slack\n").first.tether);
}

TEST(Registry, faultsGiveOneMessageWithTheKnownNames) {
    const auto message = [](const std::string& yaml) { return readText<Membrane>(yaml).second; };
    EXPECT_EQ(message("bonds: {type: liner, k: 2}\n"),
              "f.yaml:1:15: bonds.type: unknown spring law 'liner'. Did you mean 'linear'? Known: linear, slack");
    EXPECT_EQ(message("bonds: liner\n"),
              "f.yaml:1:8: bonds: unknown spring law 'liner'. Did you mean 'linear'? Known: linear, slack");
    EXPECT_NE(message("bonds: {k: 2 N/m}\n").find("f.yaml:1:1: bonds: 'type' is missing"), std::string::npos);
    EXPECT_NE(message("tether: none\n").find("f.yaml:1:1: bonds: missing: law of the bonds. Expected a spring law"),
              std::string::npos);
    EXPECT_NE(message("bonds: linear\n").find("bonds.k: missing"), std::string::npos);
    EXPECT_NE(message("bonds: {type: slack, k: 1 N/m}\n").find("bonds.k: unknown key 'k'. No key is allowed here"),
              std::string::npos);
    EXPECT_NE(message("bonds: [slack]\n").find("a list of 1"), std::string::npos);
    EXPECT_NE(message("bonds:\n").find("nothing"), std::string::npos);
}

TEST(Registry, freeNames) {
    const auto [all, text] = readText<AllBonds>("left: slack\nright: {type: linear, k: 3 N/m}\n");
    ASSERT_EQ(text, "");
    EXPECT_EQ(all.bonds.size(), 2u);
    EXPECT_EQ(all.bonds.at("right")->force(1), -3);
    EXPECT_EQ(emit(write(all)), "left: slack\nright:\n  type: linear\n  k: 3 N/m\n");
    EXPECT_TRUE(readText<AllBonds>("").first.bonds.empty());
}

TEST(Registry, writtenChoicesReadBack) {
    const std::string text = emit(write(readText<Membrane>("bonds: {type: linear, k: 2 mN/m}\n").first));
    EXPECT_EQ(text, "bonds:\n  type: linear\n  k: 0.002 N/m\ntether: none\n");
    EXPECT_EQ(emit(write(readText<Membrane>(text).first)), text);
}

TEST(Registry, catalogueListsFamiliesModelsAndSettings) {
    ASSERT_TRUE(families().contains("spring law"));
    const std::vector<ModelInfo> models = families()["spring law"].models();
    ASSERT_EQ(models.size(), 2u);
    EXPECT_EQ(models[0].name, "linear");
    EXPECT_EQ(models[0].text, "linear spring");
    EXPECT_EQ(models[0].settings.fields.at(0).key, "k");
    EXPECT_EQ(Membrane::schema().info().fields[0].family, "spring law");
}

}  // namespace
}  // namespace corpuscle
