#include "core/schemaJson.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/reference.hpp"

namespace corpuscle {
namespace {

struct Shape {
    static constexpr const char* familyName = "test shape";
    virtual ~Shape() = default;
};
struct Group : Shape {  // a family that contains itself
    Choice<Shape> of;
    static const Schema<Group>& schema() {
        static const Schema<Group> s = Schema<Group>("group", "").model("of", &Group::of, "what it holds");
        return s;
    }
};
CORPUSCLE_REGISTER(Shape, Group, "group", "holds another shape");
struct Ball : Shape {
    double d = 0;
    static const Schema<Ball>& schema() {
        static const Schema<Ball> s =
            Schema<Ball>("ball", "")
                .quantity("d", &Ball::d, unit::metre, "diameter", {.fallback = "1 um", .range = positive});
        return s;
    }
};
CORPUSCLE_REGISTER(Shape, Ball, "ball", "a ball");

struct Domain {
    double porosity = 0;
    Vec3 size = Vec3::Zero();
    std::optional<double> Ca, shearRate;
    Choice<Shape> shape;
    std::map<std::string, Ball> balls;
    static const Schema<Domain>& schema() {
        static const Schema<Domain> s =
            Schema<Domain>("domain", "the box")
                .quantity("porosity", &Domain::porosity, unit::none, "a number", {.range = between(0, 1)})
                .vector("size", &Domain::size, unit::metre, "its size")
                .quantity("Ca", &Domain::Ca, unit::none, "capillary number")
                .quantity("shearRate", &Domain::shearRate, unit::perSecond, "a|b")
                .exactlyOneOf({"Ca", "shearRate"})
                .modelOr("none", "shape", &Domain::shape, "its shape", {.fallback = "none"})
                .map("balls", &Domain::balls, "all balls", {.fallback = "{}"});
        return s;
    }
};

TEST(JsonSchema, tellsTypesLimitsAndRules) {
    const auto json = jsonSchema(Domain::schema().info());
    EXPECT_EQ(json["properties"]["porosity"]["maximum"], 1);
    EXPECT_EQ(json["required"], (std::vector<std::string>{"porosity", "size"}));
    EXPECT_EQ(json["additionalProperties"], false);
    // Without shearRate, Ca is required; both together are refused.
    EXPECT_EQ(json["allOf"].size(), 2u);
    EXPECT_EQ(json["allOf"][0]["then"]["required"][0], "Ca");
    EXPECT_EQ(json["allOf"][1]["not"]["required"].size(), 2u);
    const auto& shape = json["properties"]["shape"];
    EXPECT_EQ(shape["then"]["enum"], (std::vector<std::string>{"none", "ball"}));  // group needs more than a word
    EXPECT_EQ(shape["else"]["$ref"], "#/definitions/test%20shape");
    EXPECT_EQ(shape["default"], "none");
    EXPECT_EQ(shape["description"], "its shape");
    const auto& family = json["definitions"]["test shape"];
    EXPECT_EQ(family["properties"]["type"]["enum"], (std::vector<std::string>{"ball", "group"}));
    ASSERT_EQ(family["allOf"].size(), 2u);
    EXPECT_EQ(family["allOf"][0]["if"]["properties"]["type"]["const"], "ball");
    EXPECT_EQ(family["allOf"][1]["then"]["properties"]["of"]["else"]["$ref"], "#/definitions/test%20shape");
    EXPECT_EQ(family["allOf"][0]["then"]["additionalProperties"], false);
}

TEST(JsonSchema, quantitiesHaveTheirDimension) {
    const auto size = jsonSchema(Domain::schema().info())["properties"]["size"];
    EXPECT_EQ(size["minItems"], 3);
    const std::string pattern = size["items"]["pattern"];
    EXPECT_NE(pattern.find("]?m"), std::string::npos) << pattern;
    EXPECT_EQ(pattern.find("Pa"), std::string::npos) << pattern;
    EXPECT_LT(pattern.size(), 200u) << pattern;  // it appears in the messages of other programs
}

TEST(JsonSchema, dictionariesAsJson) {
    Problems problems;
    const auto json = toJson(
        parseDictionary("a: 1\nb: 1.5\nc: true\nd: 8 um\ne: [1 um, 2 um]\nf: [1, x]\ng: '1'\nh: 012\n", "f", problems));
    EXPECT_EQ(json.dump(), R"({"a":1,"b":1.5,"c":true,"d":"8 um","e":["1 um","2 um"],"f":[1,"x"],"g":"1","h":12})");
}

TEST(Reference, listsEveryKeyOfFilesAndModels) {
    const std::string page = referencePage({{"system/domain.yaml", Domain::schema().info()}});
    for (const char* part :
         {"## system/domain.yaml", "| `porosity` | a number without unit, 0 to 1 | required | a number |",
          "Exactly one of `Ca`, `shearRate`", "[test shape](#test-shape), or none", "a\\|b", "## test shape",
          "### ball", "| `d` | a quantity in m, greater than 0 | `1 um` | diameter |",
          "### system/domain.yaml balls.<name>"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

}  // namespace
}  // namespace corpuscle
