// Changes of single entries in the text of a dictionary: the expected text is written out for each layout.
#include "core/dictionaryEdit.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace corpuscle {
namespace {

std::string set(const std::string& text, const std::string& path, const std::string& value) {
    return withEntry(text, {"system/mesh.yaml", path, value});
}
std::string removed(const std::string& text, const std::string& path) {
    return withoutEntry(text, "system/mesh.yaml", path);
}
std::string refusal(const std::function<void()>& change) {
    try {
        change();
    } catch (const Failure& failure) {
        return failure.what();
    }
    return "";
}

const std::string sample =
    "# the box\n"
    "domain: {size: [16 um, 16 um, 12 um], periodic: [true, true, false]}  # periodic in x, y\n"
    "cells:\n"
    "  - name: red   # the first\n"
    "    edge: 0.4 um\n"
    "    # of the shape\n"
    "    shape: {type: sphere, radius: '3 um'}\n"
    "  - {name: \"blue\", edge: 0.5 um}\n"
    "fill:\n"
    "  jitter: 0.1 # of a spacing\n"
    "\n"
    "last: 1\n";

TEST(DictionaryEdit, ReplacesValuesInPlace) {
    std::string wanted = sample;
    const auto change = [&](const std::string& from, const std::string& to) {
        std::string text = wanted;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(set(sample, "/domain/size/2", "20 um"), change("12 um", "20 um"));
    EXPECT_EQ(set(sample, "/domain/size", "[1 um, 2 um, 3 um]"), change("[16 um, 16 um, 12 um]", "[1 um, 2 um, 3 um]"));
    EXPECT_EQ(set(sample, "/cells/0/edge", "0.3 um"), change("0.4 um", "0.3 um"));
    EXPECT_EQ(set(sample, "/cells/0/shape/radius", "4 um"), change("'3 um'", "4 um"));
    EXPECT_EQ(set(sample, "/cells/1/name", "green"), change("\"blue\"", "green"));
    EXPECT_EQ(set(sample, "/fill/jitter", "0"), change("0.1 #", "0 #"));
    EXPECT_EQ(set(sample, "/fill", "{jitter: 0.2}"), change("fill:\n  jitter: 0.1", "fill: {jitter: 0.2}"));
    EXPECT_EQ(set(sample, "/last", "2"), change("last: 1", "last: 2"));
    EXPECT_EQ(set("a:\n  b: 1\n  # of c\n  c: 2\nd: 3\n", "/a", "{b: 5}"), "a: {b: 5}\n  # of c\nd: 3\n");
}

TEST(DictionaryEdit, AddsEntriesInTheWayOfTheTable) {
    EXPECT_EQ(set("a: 1\n", "/b", "2 um"), "a: 1\nb: 2 um\n");
    EXPECT_EQ(set("a: 1", "/b", "2"), "a: 1\nb: 2\n");
    EXPECT_EQ(set("", "/a", "1"), "a: 1\n");
    EXPECT_EQ(set("# nothing yet\n", "/a", "1"), "# nothing yet\na: 1\n");
    EXPECT_EQ(set("a: {b: 1}\n", "/a/c", "2"), "a: {b: 1, c: 2}\n");
    EXPECT_EQ(set("a: {}  # empty\n", "/a/c", "2"), "a: {c: 2}  # empty\n");
    EXPECT_EQ(set("a:\n  b: 1   # one\nz: 3\n", "/a/c", "2"), "a:\n  b: 1   # one\n  c: 2\nz: 3\n");
    EXPECT_EQ(set("a:\n  b: [1,\n      2]  # long\nz: 3\n", "/a/c", "2"),
              "a:\n  b: [1,\n      2]  # long\n  c: 2\nz: 3\n");
    EXPECT_EQ(set("kernel: lucy\n", "/kernel/support", "3 dx"), "kernel: {type: lucy, support: 3 dx}\n");
    EXPECT_EQ(set("a:\n", "/a/b/c", "1"), "a: {b: {c: 1}}\n");
    EXPECT_EQ(set("a: 1\n", "/write/strain", "0.5"), "a: 1\nwrite: {strain: 0.5}\n");
    EXPECT_EQ(set("list:\n  - {a: 1}\n  - b: 2\n", "/list/1/c", "3"), "list:\n  - {a: 1}\n  - b: 2\n    c: 3\n");
    EXPECT_EQ(set("a: 1\r\nb: 2\r\n", "/c", "3"), "a: 1\r\nb: 2\r\nc: 3\r\n");
}

TEST(DictionaryEdit, TakesEntriesOut) {
    EXPECT_EQ(removed("a: 1\nb: 2  # two\nc: 3\n", "/b"), "a: 1\nc: 3\n");
    EXPECT_EQ(removed("a: {b: 1, c: 2}  # both\n", "/a/b"), "a: {c: 2}  # both\n");
    EXPECT_EQ(removed("a: {b: 1, c: 2}\n", "/a/c"), "a: {b: 1}\n");
    EXPECT_EQ(removed("a: {b: 1}\n", "/a/b"), "a: {}\n");
    EXPECT_EQ(removed("a:\n  b: 1\nc: 2\n", "/a/b"), "a: {}\nc: 2\n");
    EXPECT_EQ(removed("a:\n  b: 1\n  c:\n    d: 3\n    e: 4\nf: 5\n", "/a/c"), "a:\n  b: 1\nf: 5\n");
    EXPECT_EQ(removed("a: [1, 2, 3]\n", "/a/1"), "a: [1, 3]\n");
    EXPECT_EQ(removed("a: [1, 2, 3]\n", "/a/2"), "a: [1, 2]\n");
    EXPECT_EQ(removed("a:\n  - x: 1\n    y: 2\n  - {x: 3}\n", "/a/0"), "a:\n  - {x: 3}\n");
    EXPECT_EQ(removed("a:\n  - x: 1\n    y: 2\n", "/a/0/x"), "a:\n  - y: 2\n");
    EXPECT_EQ(removed("a: 1\n# of b\nb: 2\n", "/b"), "a: 1\n# of b\n");
    EXPECT_EQ(removed("a:\n  - x: 1  # one\n    # of y\n    y: 2\n", "/a/0/x"), "a:\n  - # of y\n    y: 2\n");
    EXPECT_EQ(removed("stop:\n  # agreed\n  file: stop  # name\nb: 1\n", "/stop/file"),
              "stop: {}  # name\n  # agreed\nb: 1\n");
    EXPECT_EQ(removed("a: 1\n", "/a"), "");
}

TEST(DictionaryEdit, IsNotMisledByTextThatLooksLikeStructure) {
    EXPECT_EQ(set("a: {b: \"}, c: 1\", c: 2}  # }\n", "/a/c", "3"), "a: {b: \"}, c: 1\", c: 3}  # }\n");
    EXPECT_EQ(set("a: {b: 'it''s }', c: 2}\n", "/a", "5"), "a: 5\n");
    EXPECT_EQ(set("a: {b: 1, # } not here\n    c: 2}\nd: 4\n", "/a", "5"), "a: 5\nd: 4\n");
    EXPECT_EQ(set("\"a:b\": {c: 1}\n", "/a:b", "2"), "\"a:b\": 2\n");
    EXPECT_EQ(set("\xEF\xBB\xBF"
                  "a: 1\n",
                  "/a", "2"),
              "\xEF\xBB\xBF"
              "a: 2\n");
    EXPECT_EQ(set("a: \xC2\xB5 x  # \xC2\xB5\nb: {c: \xC2\xB5, d: 1}\n", "/b/d", "2"),
              "a: \xC2\xB5 x  # \xC2\xB5\nb: {c: \xC2\xB5, d: 2}\n");
    EXPECT_EQ(removed("a: {b: \",\", c: 2}\n", "/a/b"), "a: {c: 2}\n");
}

TEST(DictionaryEdit, RefusesWhatItCannotDo) {
    EXPECT_NE(refusal([] {
                  removed(sample, "/fil");
              }).find("there is no 'fil'; there are domain, cells, fill, last. Did you mean 'fill'?"),
              std::string::npos);
    EXPECT_NE(refusal([] { removed(sample, "/cells/7"); }).find("its items are 0 to 1"), std::string::npos);
    EXPECT_NE(refusal([] { removed(sample, "/last/x"); }).find("this is the number '1'"), std::string::npos);
    EXPECT_NE(refusal([] { set(sample, "/cells/2/edge", "1 um"); }).find("'2' is not an item of this list"),
              std::string::npos);
    EXPECT_NE(refusal([] { set(sample, "/last", "[1, 2"); }).find("cannot read the value"), std::string::npos);
    EXPECT_NE(refusal([] { set("a: {b: 1}\n", "/a/b", "1, c: 2"); }).find("a/b"), std::string::npos);  // would add c
    EXPECT_NE(refusal([] { removed(sample, "/"); }).find("the whole file"), std::string::npos);
    EXPECT_NE(refusal([] { set("a: [1\n", "/a", "1"); }), "");
}

TEST(DictionaryEdit, FindsDifferencesByValue) {
    Problems problems;
    const Node first = parseDictionary("a: 1\nb: {c: 2, d: [1, 2]}\ne: {type: lucy}\n", "x", problems);
    const Node second = parseDictionary("b:\n  d: [1, 3]\n  c: 2  # same\nf: 4\ne: lucy\n", "x", problems);
    const auto found = differences(first, second);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0].path + found[0].first + "," + found[0].second, "/a1,");
    EXPECT_EQ(found[1].path + " " + found[1].first + "," + found[1].second, "/b/d/1 2,3");
    EXPECT_EQ(found[2].path + found[2].first + "," + found[2].second, "/e{type: lucy},lucy");
    EXPECT_EQ(found[3].path + found[3].first + "," + found[3].second, "/f,4");
    EXPECT_TRUE(differences(first, first).empty());
}

// The paths of a node and of all nodes below it.
void addPaths(const Node& node, const std::string& path, std::vector<std::string>& all) {
    if (!path.empty()) all.push_back(path);
    for (const auto& [key, value] : node.entries) addPaths(value, path + "/" + key, all);
    for (std::size_t i = 0; i < node.items.size(); ++i) addPaths(node.items[i], path + "/" + std::to_string(i), all);
}

std::vector<std::string> comments(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find(" #"); at != std::string::npos) all.push_back(line.substr(at));
    return all;
}

// Every entry of every dictionary of the tutorials can be changed and removed. Other values stay, and so do comments,
// except those of the entry itself.
TEST(DictionaryEdit, UnderstandsEveryDictionaryOfTheTutorials) {
    std::size_t files = 0, changes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(TUTORIALS)) {
        if (entry.path().extension() != ".yaml") continue;
        std::ifstream stream(entry.path());
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        Problems problems;
        const Node root = parseDictionary(text, "x", problems);
        std::vector<std::string> paths;
        addPaths(root, "", paths);
        ++files;
        for (const std::string& path : paths) {
            ++changes;
            const Node& node = *entryAt(root, path);
            SCOPED_TRACE(entry.path().string() + ":" + path);
            std::string changed;
            ASSERT_NO_THROW(changed = withEntry(text, {"x", path, "changed"}));
            const auto differ = differences(root, parseDictionary(changed, "x", problems));
            ASSERT_EQ(differ.size(), 1u);
            EXPECT_EQ(differ[0].path, path);
            if (node.kind == Node::Kind::scalar) {
                EXPECT_EQ(comments(changed), comments(text));
                EXPECT_EQ(withEntry(changed, {"x", path, emitInLine(node)}), text);
            }
            ASSERT_NO_THROW(changed = withoutEntry(text, "x", path));
            EXPECT_FALSE(entryAt(parseDictionary(changed, "x", problems), path) && node.kind == Node::Kind::scalar &&
                         path.back() > '9');
        }
        EXPECT_TRUE(problems.empty());
    }
    EXPECT_GT(files, 100u);
    EXPECT_GT(changes, 1000u);
}

}  // namespace
}  // namespace corpuscle
