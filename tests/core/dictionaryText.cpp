#include "core/dictionaryText.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "core/dictionary.hpp"
#include "core/settings.hpp"

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

void expectOne(const std::string& text, const std::string& words) {
    const std::string found = faults(text);
    EXPECT_NE(found.find(words), std::string::npos) << text.substr(0, 80) << " -> " << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << text.substr(0, 80) << " -> " << found;
}

std::string repeated(const std::string& text, std::size_t n) {
    std::string all;
    for (std::size_t i = 0; i < n; ++i) all += text;
    return all;
}

TEST(DictionaryText, byteOrderMarkAndLineEndings) {
    for (const std::string text : {"\xEF\xBB\xBF"
                                   "a: 1\nb: 2\n",
                                   "a: 1\r\nb: 2\r\n", "a: 1\rb: 2\r", "a: 1\nb: 2"}) {
        Problems problems;
        const Node root = parseDictionary(text, "f.yaml", problems);
        EXPECT_TRUE(problems.empty()) << faults(text);
        ASSERT_EQ(root.entries.size(), 2u);
        EXPECT_EQ(root.entries[0].key, "a");
        EXPECT_EQ(root.entries[0].value.scalar, "1");
        EXPECT_EQ(root.entries[1].value.keyMark.text(), "f.yaml:2:1");
    }
}

TEST(DictionaryText, whatIsNoTextIsSaidOnce) {
    expectOne(std::string("\xFF\xFE"
                          "a\0:\0 \0"
                          "1\0",
                          10),
              "UTF-16");
    expectOne(std::string("\xFE\xFF\0a\0:\0 \0"
                          "1",
                          10),
              "UTF-16");
    expectOne(std::string("a\0:\0 \0"
                          "1\0\n\0",
                          10),
              "UTF-16");
    expectOne(std::string("a: 1\n\0\0\0\0", 9), "f.yaml:2:1: control character 0x00");
    expectOne("a: 1\nb: \xE4\n", "f.yaml:2:4: byte 0xE4 is not UTF-8");
    expectOne("a: \xC3", "not UTF-8");
    expectOne("a: \x1B[31m\n", "control character 0x1B");
    expectOne("\x89PNG\r\n\x1A\n", "0x89");
    expectOne(repeated("a: 1\n", 1000000), "at most 4 MB");
    expectOne(repeated("\ta: 1\n", 10000), "a tab");
}

TEST(DictionaryText, deepNesting) {
    for (const std::string open : {"[", "{a: ", "- ", "{", "? "}) expectOne("a: " + repeated(open, 10000), "");
    expectOne("a: " + repeated("[", 10000) + repeated("]", 10000), "nested more than 64 levels");
    std::string blocks;
    for (std::size_t i = 0; i < 500; ++i) blocks += std::string(2 * i, ' ') + "a:\n";
    expectOne(blocks, "nested more than 64 levels");
    EXPECT_EQ(faults("a: " + repeated("[", 60) + repeated("]", 60)), "");
}

struct Few {
    double a = 0;
    static const Schema<Few>& schema() {
        static const Schema<Few> s =
            Schema<Few>("few", "").quantity("alpha", &Few::a, unit::metre, "a", {.fallback = "1 m"});
        return s;
    }
};

// The time for 40,000 faults of any kind is proportional to the length of the text.
TEST(DictionaryText, manyFaultsTakeLittleTimeAndFewLines) {
    const auto start = std::chrono::steady_clock::now();
    std::string unknown, same, ordered;
    for (int i = 0; i < 40000; ++i) {
        unknown += "alpha" + std::to_string(i) + ": 1 m\n";
        same += "key: 1\n";
    }
    for (const std::string& text : {unknown, same}) {
        Problems problems;
        const Node node = parseDictionary(text, "f.yaml", problems);
        if (problems.empty()) read<Few>(node, problems);
        try {
            problems.throwIfAny();
            ADD_FAILURE();
        } catch (const CaseError& error) {
            EXPECT_EQ(error.problems().size(), Problems::mostShown);
            EXPECT_GE(error.total(), 39999u);
            EXPECT_EQ(error.problems().front().mark.line, text == unknown ? 1 : 2);
            EXPECT_NE(std::string(error.what()).find("and 399"), std::string::npos);
        }
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(DictionaryText, longTextsAreShortenedInMessages) {
    Problems problems;
    read<Few>(parseDictionary("alpha: " + std::string(1000000, 'x') + "\n" + std::string(900, 'k') + ": 1\n", "f.yaml",
                              problems),
              problems);
    try {
        problems.throwIfAny();
        ADD_FAILURE();
    } catch (const CaseError& error) {
        for (const Problem& p : error.problems()) EXPECT_LT(p.text().size(), 1000u);
    }
    EXPECT_EQ(shortened("abcdef", 6), "abcdef");
    EXPECT_EQ(shortened("\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4", 6), "\xC3\xA4 ... \xC3\xA4");
}

TEST(DictionaryText, habitsOfOtherFormats) {
    expectOne("density:1000 kg/m^3\nviscosity: 1\n",
              "f.yaml:1:1: a blank is missing after the ':': write 'density: 1000 kg/m^3'");
    expectOne("a: 1\nb:2\nc: 3\n", "f.yaml:2:1: a blank is missing");
    expectOne("a: {b:1}\n", "write 'b: 1'");
    expectOne("a = 1\nb = 2\n", "'=' in place of ':': write 'a: 1'");
    expectOne("a 1;\nb 2;\n", "do not end with ';'");
    expectOne("// text\na: 1\n", "a comment starts with '#', not with '//'");
    expectOne("kernel\n{\n  type x;\n}\n", "'kernel:'");
    expectOne("#include \"other\"\na: 1\n", "'#include' has no effect");
    EXPECT_EQ(faults("# include is a word\n#includes\na: http://x\nb: a=b\n"), "");
}

}  // namespace
}  // namespace corpuscle
