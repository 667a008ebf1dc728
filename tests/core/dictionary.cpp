#include "core/dictionary.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

std::string faults(const std::string& text) {
    Problems problems;
    parseDictionary(text, "f.yaml", problems);
    try {
        problems.throwIfAny();
    } catch (const CaseError& e) {
        return e.what();
    }
    return "";
}

Node clean(const std::string& text) {
    Problems problems;
    Node node = parseDictionary(text, "f.yaml", problems);
    EXPECT_TRUE(problems.empty()) << faults(text);
    return node;
}

TEST(Dictionary, keepsTextPlacesAndPaths) {
    const Node root = clean(
        "# a comment\n"
        "octal: 012\n"
        "word: no\n"
        "cells: [{name: rbc, shape: {type: kuchelFackerell, d: 8 um}}]\n"
        "quoted: '7'\n");
    EXPECT_EQ(root.find("octal")->scalar, "012");
    EXPECT_EQ(root.find("word")->scalar, "no");
    EXPECT_TRUE(root.find("quoted")->quoted);
    const Node& d = *root.find("cells")->items[0].find("shape")->find("d");
    EXPECT_EQ(d.scalar, "8 um");
    EXPECT_EQ(d.path, "cells[0].shape.d");
    EXPECT_EQ(d.mark.text(), "f.yaml:4:55");
    EXPECT_EQ(d.keyMark.text(), "f.yaml:4:52");
    EXPECT_EQ(root.find("nothing"), nullptr);
}

// This is not YAML, but the reader has to recognise it to suggest the correction.
TEST(Dictionary, unitAfterAList) {
    const Node root = clean(
        "domain: {size: [20, 16, 16] um, periodic: [true, true, false]}  # [1, 2] um\n"
        "centre: [0, 0, 0] um  # here\n"
        "forces: [0, 25,\n"
        "  50] pN\n"
        "plain: see [1] m\n"
        "text: \"[1, 2] m\"\n"
        "micro: [1, 2, 3] \xC2\xB5m\n"
        "after: {a: [1] um, b: 2}\n");
    EXPECT_EQ(root.find("domain")->find("size")->unit, "um");
    EXPECT_EQ(root.find("domain")->find("periodic")->unit, "");
    EXPECT_EQ(root.find("domain")->find("periodic")->mark.column, 43);
    EXPECT_EQ(root.find("centre")->unit, "um");
    EXPECT_EQ(root.find("forces")->unit, "pN");
    EXPECT_EQ(root.find("plain")->scalar, "see [1] m");
    EXPECT_EQ(root.find("text")->scalar, "[1, 2] m");
    EXPECT_EQ(root.find("micro")->unit, "\xC2\xB5m");
    EXPECT_EQ(root.find("after")->find("a")->unit, "um");
    EXPECT_EQ(root.find("after")->find("b")->mark.column, 23);
}

TEST(Dictionary, faultsOfForm) {
    const auto expect = [](const std::string& text, const std::string& place, const std::string& message) {
        const std::string found = faults(text);
        EXPECT_NE(found.find("f.yaml:" + place), std::string::npos) << text << " -> " << found;
        EXPECT_NE(found.find(message), std::string::npos) << text << " -> " << found;
    };
    expect("a: 1\nb: 2\na: 3\n", "3:1", "stands twice, first in line 1");
    expect("a: {b: 1, b: 2}\n", "1:11", "stands twice");
    expect("a: &x 1\n", "1:", "anchor");
    expect("a: &x 1\nb: *x\n", "2:", "alias");
    expect("a: !!str 1\n", "1:", "tag");
    expect("a: !mine {b: 1}\n", "1:", "tag");
    expect("\ta: 1\n", "1:1", "tab");
    expect("a:\t1\n", "1:3", "tab");
    expect("<<: {a: 1}\n", "1:1", "merge");
    expect("a: 1\n---\nb: 2\n", "1:", "more than one document");
    expect("- a\n- b\n", "1:1", "a list of 2");
    expect("a: [1, 2\nb: 3\n", "", "");
    expect("[1, 2]: 3\n", "1:1", "as a key");
    expect("a: 1\nviscosity 3\nb: 2\n", "", "");
    EXPECT_EQ(faults("# \t a tab in a comment\n"), "");
    EXPECT_EQ(faults(""), "");
    EXPECT_TRUE(clean("# only comments\n").entries.empty());
}

TEST(Dictionary, missingFileIsAProblem) {
    Problems problems;
    readDictionary("/nowhere/system/control.yaml", "system/control.yaml", problems);
    EXPECT_EQ(problems.count(), 1u);
}

TEST(Dictionary, emittedTextGivesTheSameTree) {
    const std::string text =
        "a: 1 um\n"
        "b:\n"
        "  c: [1 um, 2 um, 3 um]\n"
        "  d: {}\n"
        "list:\n"
        "- {name: one, shape: {type: disc}}\n"
        "- {name: two}\n"
        "empty: []\n"
        "negative: -3 um\n"
        "odd: \"# no comment: \\\"x\\\"\"\n"
        "flow: [\"a, b\", c]\n";
    const Node once = clean(text);
    const std::string emitted = emit(once);
    EXPECT_EQ(emit(clean(emitted)), emitted);
    EXPECT_EQ(clean(emitted).find("odd")->scalar, "# no comment: \"x\"");
    EXPECT_EQ(clean(emitted).find("flow")->items[0].scalar, "a, b");
    EXPECT_EQ(clean(emitted).find("b")->find("c")->items[1].scalar, "2 um");
    EXPECT_EQ(clean(emitted).find("list")->items[0].find("shape")->find("type")->scalar, "disc");
}

TEST(Override, isReadFromTheCommandLine) {
    const Override o = parseOverride("system/control.yaml:/write/strain=0.5");
    EXPECT_EQ(o.file, "system/control.yaml");
    EXPECT_EQ(o.path, "/write/strain");
    EXPECT_EQ(o.value, "0.5");
    EXPECT_EQ(parseOverride("a.yaml:/b=c=d").value, "c=d");
    for (const char* wrong : {"", "a.yaml", "a.yaml:/b", "a.yaml:b=1", ":/b=1", "a.yaml:/=1"})
        EXPECT_THROW(parseOverride(wrong), Failure) << wrong;
}

TEST(Override, changesAddsAndComplains) {
    Node root = clean("kernel: lucy\ncells: [{edge: 1 um}, {edge: 2 um}]\nsize: [1 um, 2 um, 3 um]\n");
    Problems problems;
    const auto set = [&](const std::string& change) {
        applyOverride(root, parseOverride("f.yaml:" + change), problems);
    };
    set("/cells/1/edge=3 um");
    set("/write/strain=0.5");
    set("/kernel/support=3 dx");
    set("/size=[4 um, 5 um, 6 um]");
    set("/size/0=7 um");
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(root.find("cells")->items[1].find("edge")->scalar, "3 um");
    EXPECT_EQ(root.find("cells")->items[1].find("edge")->mark.text(), "-set");
    EXPECT_EQ(root.find("cells")->items[1].find("edge")->path, "cells[1].edge");
    EXPECT_EQ(root.find("cells")->items[0].find("edge")->scalar, "1 um");
    EXPECT_EQ(root.find("write")->find("strain")->scalar, "0.5");
    EXPECT_EQ(root.find("kernel")->find("type")->scalar, "lucy");
    EXPECT_EQ(root.find("kernel")->find("support")->scalar, "3 dx");
    EXPECT_EQ(root.find("size")->items[0].scalar, "7 um");
    set("/cells/2/edge=1 um");
    set("/cells/x=1");
    set("/bad=[1, 2");
    set("/kernel//x=1");
    EXPECT_EQ(problems.count(), 4u);
}

}  // namespace
}  // namespace corpuscle
