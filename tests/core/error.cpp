#include "core/error.hpp"

#include <gtest/gtest.h>

namespace corpuscle {
namespace {

TEST(NearestWord, findsTypingErrorsAndNothingElse) {
    const std::vector<std::string> words{"viscosity", "density", "soundSpeed"};
    EXPECT_EQ(nearestWord("viscosty", words), "viscosity");
    EXPECT_EQ(nearestWord("vsicosity", words), "viscosity");  // a transposition counts once
    EXPECT_EQ(nearestWord("SOUNDSPEED", words), "soundSpeed");
    EXPECT_EQ(nearestWord("pressure", words), "");
    EXPECT_EQ(nearestWord("b", {"a"}), "");
    EXPECT_EQ(nearestWord("mu", {"m", "mm", "um"}), "um");  // of equally near words, the one with the same letters
    EXPECT_EQ(didYouMean("densty", words), " Did you mean 'density'?");
    EXPECT_EQ(didYouMean("walls", words), "");
}

TEST(Failure, showsWordsOfDamagedFilesWithoutControlCharacters) {
    using std::string_literals::operator""s;
    const auto shown = [](const std::string& word) {
        return std::string(Failure(ExitCode::io, "unknown word '" + word + "': \u00b5m\n\tnext line").what());
    };
    for (const std::string& word : {"a\0b"s, "a\033b"s, "a\177b"s, "a\rb"s})
        EXPECT_EQ(shown(word), "unknown word 'a?b': \u00b5m\n\tnext line");
    EXPECT_EQ(shown("a b"), "unknown word 'a b': \u00b5m\n\tnext line");
}

TEST(Problems, areThrownTogetherInTheOrderOfTheFiles) {
    Problems problems;
    problems.throwIfAny();
    problems.add({"b.yaml", 2, 1}, "k", "second");
    problems.add({"a.yaml", 9, 4}, "cells[0].edge", "first");
    problems.add({"-set", 0, 0}, "", "from the command line");
    try {
        problems.throwIfAny();
        FAIL();
    } catch (const CaseError& e) {
        EXPECT_EQ(e.code(), ExitCode::invalidCase);
        ASSERT_EQ(e.problems().size(), 3u);
        EXPECT_EQ(e.problems()[0].text(), "-set: from the command line");
        EXPECT_EQ(e.problems()[1].text(), "a.yaml:9:4: cells[0].edge: first");
        EXPECT_NE(std::string(e.what()).find("b.yaml:2:1: k: second"), std::string::npos);
    }
}

}  // namespace
}  // namespace corpuscle
