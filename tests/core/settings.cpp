#include "core/settings.hpp"

#include <gtest/gtest.h>

#include "core/registry.hpp"

namespace corpuscle {
namespace {

struct Inertia {
    double Re = 0;
    static const Schema<Inertia>& schema() {
        static const Schema<Inertia> s =
            Schema<Inertia>("inertia", "how inertia is set")
                .quantity("Re", &Inertia::Re, unit::none, "Reynolds number", {.range = positive});
        return s;
    }
};

struct Cell {
    std::string name;
    double edge = 0;
    static const Schema<Cell>& schema() {
        static const Schema<Cell> s =
            Schema<Cell>("cell", "one cell")
                .name("name", &Cell::name, "its name")
                .quantity("edge", &Cell::edge, unit::metre, "length of the edges", {.range = positive});
        return s;
    }
};

struct Scheduled {
    Interval every;
    static const Schema<Scheduled>& schema() {
        static const Schema<Scheduled> s =
            Schema<Scheduled>("scheduled", "").interval("every", &Scheduled::every, "when", {.fallback = "10 steps"});
        return s;
    }
};

struct Everything : Scheduled {
    double viscosity = 0;
    std::optional<double> Ca, shearRate, soundSpeed;
    double porosity = 0;
    std::vector<double> forces;
    long steps = 0;
    int threads = 0;
    bool on = false;
    std::string boundary, title, path;
    std::vector<std::string> fields;
    Vec3 size = Vec3::Zero();
    std::optional<Vec3> axis;
    Index3 copies{};
    std::array<bool, 3> periodic{};
    Length support;
    std::optional<Length> skin;
    std::optional<Inertia> inertia;
    Inertia nested;
    std::vector<Cell> cells;
    std::map<std::string, Cell> named;

    static const Schema<Everything>& schema() {
        using E = Everything;
        static const Schema<E> s =
            Schema<E>("everything", "all kinds of fields")
                .include<Scheduled>()
                .quantity("viscosity", &E::viscosity, unit::pascalSecond, "dynamic viscosity", {.range = positive})
                .quantity("Ca", &E::Ca, unit::none, "capillary number", {.range = positive})
                .quantity("shearRate", &E::shearRate, unit::perSecond, "shear rate")
                .exactlyOneOf({"Ca", "shearRate"})
                .quantityOr("auto", "soundSpeed", &E::soundSpeed, unit::metrePerSecond, "speed of sound",
                            {.fallback = "auto"})
                .quantity("porosity", &E::porosity, unit::none, "porosity", {.fallback = "0.5", .range = between(0, 1)})
                .quantities("forces", &E::forces, unit::newton, "forces", {.fallback = "[]"})
                .integer("steps", &E::steps, "steps", {.fallback = "1e3", .range = atLeast(1)})
                .integer("threads", &E::threads, "threads", {.fallback = "2"})
                .boolean("on", &E::on, "switch", {.fallback = "false"})
                .word("boundary", &E::boundary, {"noSlip", "freeSlip"}, "condition", {.fallback = "noSlip"})
                .name("title", &E::title, "title", {.fallback = "run-1"})
                .text("path", &E::path, "path", {.fallback = "\"\""})
                .words("fields", &E::fields, {"velocity", "density"}, "fields", {.fallback = "[velocity]"})
                .vector("size", &E::size, unit::metre, "size", {.fallback = "[1 um, 2 um, 3 um]", .range = positive})
                .vector("axis", &E::axis, unit::none, "axis")
                .integers("copies", &E::copies, "copies", {.fallback = "[1, 1, 1]", .range = atLeast(1)})
                .booleans("periodic", &E::periodic, "periodic", {.fallback = "[true, true, false]"})
                .length("support", &E::support, "support", {.fallback = "3 dx", .range = positive})
                .lengthOr("auto", "skin", &E::skin, "skin", {.fallback = "auto"})
                .tableOr("physical", "inertia", &E::inertia, "inertia", {.fallback = "physical"})
                .table("nested", &E::nested, "nested", {.fallback = "{Re: 2}"})
                .list("cells", &E::cells, "cells", {.fallback = "[]"})
                .map("named", &E::named, "named cells", {.fallback = "{}"})
                .check([](const E& e, const Node& node, Problems& problems) {
                    if (e.porosity > 0.9 && e.on) problems.add(node.mark, "porosity", "the check ran");
                });
        return s;
    }
};

struct Outcome {
    Everything value;
    std::vector<Problem> problems;
    std::string text;
};

Outcome readText(const std::string& yaml) {
    Problems problems;
    Outcome outcome;
    outcome.value = read<Everything>(parseDictionary(yaml, "f.yaml", problems), problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& e) {
        outcome.problems = e.problems();
        outcome.text = e.what();
    }
    return outcome;
}

const std::string base = "viscosity: 1.2 mPa s\nCa: 0.02\n";

TEST(Settings, fallbacks) {
    const Outcome o = readText(base);
    ASSERT_EQ(o.text, "");
    const Everything& e = o.value;
    EXPECT_EQ(e.viscosity, 1.2e-3);
    EXPECT_EQ(e.Ca, 0.02);
    EXPECT_FALSE(e.shearRate || e.soundSpeed || e.axis || e.skin || e.inertia);
    EXPECT_EQ(e.porosity, 0.5);
    EXPECT_EQ(e.steps, 1000);
    EXPECT_EQ(e.threads, 2);
    EXPECT_FALSE(e.on);
    EXPECT_EQ(e.boundary, "noSlip");
    EXPECT_EQ(e.path, "");
    EXPECT_EQ(e.fields, std::vector<std::string>{"velocity"});
    EXPECT_EQ(e.size, Vec3(1e-6, 2e-6, 3e-6));
    EXPECT_EQ(e.periodic, (std::array<bool, 3>{true, true, false}));
    EXPECT_TRUE(e.support.inSpacings);
    EXPECT_EQ(e.support.metres(2e-6), 6e-6);
    EXPECT_EQ(e.every.kind, Interval::Kind::steps);
    EXPECT_EQ(e.every.value, 10);
    EXPECT_EQ(e.nested.Re, 2);
}

TEST(Settings, everyKindIsRead) {
    const Outcome o = readText(
        "viscosity: 1e-3 Pa s\nshearRate: 50 1/s\nsoundSpeed: 0.1 m/s\nporosity: 0.7\nforces: [0 pN, 25 pN]\nsteps: "
        "7\nthreads: 3\n"
        "on: true\nboundary: freeSlip\ntitle: a_b\npath: ../x y\nfields: [density, velocity]\nsize: [4 um, 5 nm, 6 "
        "um]\n"
        "axis: [0, 0, 1]\ncopies: [2, 3, 4]\nperiodic: [false, true, true]\nsupport: 1.5 um\nskin: 0.5 dx\n"
        "inertia: {Re: 0.1}\nnested: {Re: 3}\ncells: [{name: rbc, edge: 0.4 um}]\nnamed: {a: {name: b, edge: 1 um}}\n"
        "every: 0.02 strain\n");
    ASSERT_EQ(o.text, "");
    const Everything& e = o.value;
    EXPECT_EQ(e.shearRate, 50);
    EXPECT_EQ(e.soundSpeed, 0.1);
    EXPECT_EQ(e.forces, (std::vector<double>{0, 25e-12}));
    EXPECT_EQ(e.steps, 7);
    EXPECT_EQ(e.threads, 3);
    EXPECT_TRUE(e.on);
    EXPECT_EQ(e.boundary, "freeSlip");
    EXPECT_EQ(e.title, "a_b");
    EXPECT_EQ(e.path, "../x y");
    EXPECT_EQ(e.fields.size(), 2u);
    EXPECT_EQ(e.size, Vec3(4e-6, 5e-9, 6e-6));
    EXPECT_EQ(*e.axis, Vec3(0, 0, 1));
    EXPECT_EQ(e.copies, (Index3{2, 3, 4}));
    EXPECT_FALSE(e.support.inSpacings);
    EXPECT_EQ(e.support.metres(1), 1.5e-6);
    EXPECT_TRUE(e.skin->inSpacings);
    EXPECT_EQ(e.inertia->Re, 0.1);
    EXPECT_EQ(e.cells.at(0).edge, 0.4e-6);
    EXPECT_EQ(e.named.at("a").name, "b");
    EXPECT_EQ(e.every.kind, Interval::Kind::strain);
    EXPECT_EQ(e.every.value, 0.02);
}

TEST(Settings, intervals) {
    const auto interval = [](const std::string& text) { return readText(base + "every: " + text + "\n").value.every; };
    EXPECT_EQ(interval("1e-3 s").kind, Interval::Kind::time);
    EXPECT_EQ(interval("5 min").value, 300);
    EXPECT_EQ(interval("100 steps").kind, Interval::Kind::steps);
    EXPECT_EQ(interval("1 step").value, 1);
    EXPECT_EQ(interval("never").kind, Interval::Kind::never);
    for (const char* wrong : {"10", "0 s", "-1 strain", "1.5 steps", "1 m", "often", "[1]", "", "strain"})
        EXPECT_EQ(readText(base + "every: " + wrong + "\n").problems.size(), 1u) << wrong;
}

// Each wrong line gives one problem, with its position and the words that help to correct it.
TEST(Settings, faultsNamePlaceAndCure) {
    const auto expect = [](const std::string& line, const std::string& key, const std::vector<std::string>& parts) {
        const Outcome o = readText(base + line + "\n");
        ASSERT_EQ(o.problems.size(), 1u) << line << "\n" << o.text;
        EXPECT_EQ(o.problems[0].key, key) << o.text;
        EXPECT_EQ(o.problems[0].mark.line, 3) << o.text;
        for (const std::string& part : parts) EXPECT_NE(o.text.find(part), std::string::npos) << part << "\n" << o.text;
    };
    expect("soundSpeed: 0.1", "soundSpeed", {"has no unit", "m/s", "1 mm/s"});
    expect("soundSpeed: 8 um", "soundSpeed", {"'8 um' is in m", "m/s"});
    expect("soundSpeed: 8 mm/S", "soundSpeed", {"unknown unit 'mm/S'", "Did you mean 'mm/s'?"});
    expect("soundSpeed: 2 dx", "soundSpeed", {"particle spacings"});
    expect("soundSpeed: [1, 2]", "soundSpeed", {"a list of 2"});
    expect("soundSpeed:", "soundSpeed", {"nothing"});
    // The suggested unit is the nearest one of the right dimension.
    expect("soundSpeed: 8 mm", "soundSpeed", {"'8 mm' is in m"});
    expect("size: [8 uM, 1 um, 1 um]", "size[0]", {"Did you mean 'um'?"});
    expect("forces: [1 pn]", "forces[0]", {"Did you mean 'pN'?"});
    expect("soundSpeed: 8 mm*s^-1/s s", "soundSpeed", {"written in a way that is not read", "Units of m/s"});
    // Values that are not accepted as numbers: non-finite, out of range, not decimal.
    expect("soundSpeed: nan", "soundSpeed", {"not a finite number"});
    expect("soundSpeed: -.inf m/s", "soundSpeed", {"not a finite number"});
    expect("soundSpeed: 1e400 m/s", "soundSpeed", {"between 1e-100 and 1e+100"});
    expect("soundSpeed: 1e-400 m/s", "soundSpeed", {"between 1e-100 and 1e+100"});
    expect("soundSpeed: 0x10 m/s", "soundSpeed", {"only decimal"});
    expect("soundSpeed: 1,5 m/s", "soundSpeed", {"'1.5 m/s'"});
    expect("soundSpeed: none", "soundSpeed", {"does not start with a number", "or auto"});
    expect("steps: 0x10", "steps", {"only decimal"});
    expect("steps: inf", "steps", {"not a finite number"});
    expect("steps: 1e400", "steps", {"is not a whole number"});
    expect("on: 'true'", "on", {"without quotation marks"});
    expect("Viscosity: 1 Pa s", "Viscosity", {"Did you mean 'viscosity'? It is given already in line 1"});
    expect("porosity: 50 um", "porosity", {"has a unit"});
    expect("porosity: 1.5", "porosity", {"0 to 1"});
    expect("steps: 0", "steps", {"at least 1"});
    expect("steps: 2.5", "steps", {"whole number"});
    expect("threads: 3000000000", "threads", {"out of range"});
    expect("on: yes", "on", {"true or false"});
    expect("boundary: noslip", "boundary", {"Did you mean 'noSlip'?", "noSlip, freeSlip"});
    expect("title: 7up", "title", {"is not a name"});
    expect("title: no", "title", {"is not a name", "YAML"});
    expect("fields: [densty]", "fields[0]", {"Did you mean 'density'?"});
    expect("fields: velocity", "fields", {"a list like '[velocity, density]'"});
    expect("fields: [velocity] um", "fields", {"not YAML"});
    expect("size: [1, 2, 3] um", "size", {"'[1, 2, 3] um' is not YAML", "'[1 um, 2 um, 3 um]'", "etc/convertVectors"});
    expect("forces: [1, 2.5] pN", "forces", {"'[1 pN, 2.5 pN]'"});
    expect("size: [1 um, 2 um]", "size", {"a list of 2", "[1 um, 2 um, 3 um]"});
    expect("size: [1 um, 2, 3 um]", "size[1]", {"has no unit"});
    expect("size: [1 um, -2 um, 3 um]", "size[1]", {"greater than 0"});
    expect("axis: [0 um, 0 um, 1 um]", "axis[0]", {"has a unit"});
    expect("copies: [1, 0, 1]", "copies[1]", {"at least 1"});
    expect("periodic: [true, 1, false]", "periodic[1]", {"true or false"});
    expect("support: 3", "support", {"has no unit"});
    expect("support: -1 dx", "support", {"greater than 0"});
    expect("inertia: fysical", "inertia", {"a table is expected"});
    expect("inertia: {re: 0.1}", "inertia.re", {"Did you mean 'Re'?"});
    expect("inertia: {}", "inertia.Re", {"missing", "a number without unit, greater than 0", "Re: 1"});
    expect("cells: {name: a}", "cells", {"a list is expected"});
    expect("cells: [{name: a, edge: 1}]", "cells[0].edge", {"has no unit"});
    expect("named: {a: {name: b}}", "named.a.edge", {"missing", "8 um"});
    expect("named: {1a: {name: b, edge: 1 um}}", "named.1a", {"is not a name"});
    expect("named: {no: {name: b, edge: 1 um}}", "named.no", {"is not a name"});
    expect("named: {name: b, edge: 1 um}", "named", {"name of its own"});
    expect("boundry: noSlip", "boundry", {"unknown key", "Did you mean 'boundary'?", "Allowed: every, viscosity"});
    expect("shearRate: 3 1/s", "shearRate", {"exactly one of 'Ca', 'shearRate'"});
}

TEST(Settings, rangesShowAsFewDigitsAsGiveTheNumber) {
    EXPECT_EQ(between(0, 0.45).text(unit::none), "0 to 0.45");
    EXPECT_EQ(between(0.01, 1).text(unit::none), "0.01 to 1");
    EXPECT_EQ(between(0.1e-6, 250e-6).text(unit::metre), "100 nm to 250 um");
    EXPECT_EQ(atLeast(123456.5).text(unit::pascal), "at least 123.4565 kPa");
    EXPECT_EQ(atLeast(1.0 / 3).text(unit::none), "at least 0.3333333333333333");
}

TEST(Settings, oneFaultOneMessage) {
    // A misspelt required key is not reported as missing as well.
    Outcome o = readText("viscosty: 1 Pa s\nCa: 1\n");
    ASSERT_EQ(o.problems.size(), 1u) << o.text;
    EXPECT_NE(o.text.find("Did you mean 'viscosity'?"), std::string::npos);
    // Missing keys name the unit and an example.
    o = readText("Ca: 1\n");
    ASSERT_EQ(o.problems.size(), 1u) << o.text;
    EXPECT_NE(o.text.find("a quantity in Pa s, greater than 0, for example 'viscosity: 1.2e-3 Pa s'"),
              std::string::npos)
        << o.text;
    o = readText("viscosity: 1 Pa s\n");
    ASSERT_EQ(o.problems.size(), 1u) << o.text;
    EXPECT_NE(o.text.find("'Ca', 'shearRate'"), std::string::npos);
    // All problems are found in one pass.
    o = readText("viscosity: 1\nCa: x\nporosity: 2\nfoo: 1\n");
    EXPECT_EQ(o.problems.size(), 4u) << o.text;
}

TEST(Settings, checksRunOnCleanTablesOnly) {
    EXPECT_NE(readText(base + "porosity: 0.95\non: true\n").text.find("the check ran"), std::string::npos);
    EXPECT_EQ(readText(base + "porosity: 0.95\non: true\nfoo: 1\n").text.find("the check ran"), std::string::npos);
}

TEST(Settings, writtenTableReadsBackToTheSameBits) {
    Everything e =
        readText(base +
                 "size: [0.1 um, 0.2 um, 0.30000000000000004 um]\nskin: 0.1 dx\ninertia: {Re: 0.3333333333333333}\n"
                 "axis: [1, 0, 0]\ncells: [{name: a, edge: 0.7 um}]\nnamed: {x: {name: y, edge: 3 nm}}\nforces: [1 pN, "
                 "2 pN]\n"
                 "path: '#odd: path'\n")
            .value;
    const std::string text = emit(write(e));
    const Outcome back = readText(text);
    ASSERT_EQ(back.text, "") << text;
    EXPECT_EQ(emit(write(back.value)), text);
    EXPECT_EQ(back.value.size, e.size);
    EXPECT_EQ(back.value.skin->value, 0.1);
    EXPECT_EQ(back.value.inertia->Re, e.inertia->Re);
    EXPECT_EQ(back.value.cells[0].edge, e.cells[0].edge);
    EXPECT_EQ(back.value.path, e.path);
    EXPECT_NE(text.find("viscosity: 0.0012 Pa s"), std::string::npos) << text;
    EXPECT_NE(text.find("soundSpeed: auto"), std::string::npos) << text;
    EXPECT_EQ(text.find("shearRate"), std::string::npos) << text;
}

TEST(Settings, infoTellsWhatWasDeclared) {
    const SchemaInfo info = Everything::schema().info();
    EXPECT_EQ(info.fields.front().key, "every");  // from the base struct
    const auto field = [&](const std::string& key) {
        for (const FieldInfo& f : info.fields)
            if (f.key == key) return f;
        return FieldInfo{};
    };
    EXPECT_TRUE(field("viscosity").required);
    EXPECT_FALSE(field("Ca").required);
    EXPECT_EQ(field("soundSpeed").alternative, "auto");
    EXPECT_EQ(field("cells").table().fields.size(), 2u);
    EXPECT_EQ(info.exactlyOne.size(), 1u);
}

}  // namespace
}  // namespace corpuscle
