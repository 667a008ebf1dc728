// Errors and exit codes.
//
// An error in the case (wrong key, wrong unit, missing file) is a Problem with its place; problems are collected while
// a case is read and thrown together as one CaseError, so that a user sees all of them at once. Everything else is a
// Failure with the exit code that the program ends with.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace corpuscle {

enum class ExitCode : int {
    done = 0,
    usage = 1,        // wrong command line
    invalidCase = 2,  // the case cannot be run as it stands
    numerics = 3,     // the computation failed (NaN, runaway density, no convergence)
    io = 4,           // reading or writing failed
    stopped = 5       // stopped early on request, checkpoint written
};

// The text with '?' in place of control characters other than line ends and tabs. Words of a damaged file, quoted in a
// message, may contain any byte; at a zero byte what() would end.
std::string printable(std::string text);

class Failure : public std::runtime_error {
  public:
    Failure(ExitCode code, const std::string& text) : std::runtime_error(printable(text)), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// A place in a case: "system/mesh.yaml:4:7", or "-set" for a value given on the command line.
struct Mark {
    std::string file;
    int line = 0;    // 1-based; 0: no place
    int column = 0;  // 1-based
    std::string text() const;
};

struct Problem {
    Mark mark;
    std::string key;           // full key with its path, "cells[0].shape.d"
    std::string message;       // what was found, what is allowed, the nearest valid word, what to do
    std::string text() const;  // "path:line:column: key: message"
};

class CaseError : public Failure {
  public:
    // `more`: number of problems beyond those listed.
    explicit CaseError(std::vector<Problem> problems, std::size_t more = 0);
    const std::vector<Problem>& problems() const { return problems_; }
    std::size_t more() const { return more_; }
    std::size_t total() const { return problems_.size() + more_; }

  private:
    std::vector<Problem> problems_;
    std::size_t more_;
};

// A file that is not a dictionary can give any number of problems of any length. Keys and messages are therefore
// shortened in the middle, the first mostShown problems are reported, and the others are only counted.
class Problems {
  public:
    static constexpr std::size_t mostShown = 50;
    void add(Mark mark, std::string key, std::string message);
    // Adds problems that another collection has counted without keeping them.
    void addUncounted(std::size_t more) { more_ += more; }
    bool empty() const { return count() == 0; }
    std::size_t count() const { return list_.size() + more_; }
    // Throws CaseError with everything collected so far, sorted by file and line, if there is anything.
    void throwIfAny() const;

  private:
    std::vector<Problem> list_;
    std::size_t more_ = 0;  // counted but not kept
};

// The text, or its beginning and end with "..." between them, never cutting a character of several bytes.
std::string shortened(const std::string& text, std::size_t longest);

// The word of `allowed` nearest to `word` by edit distance (Damerau), empty when none is near (distance above 1 +
// length/3).
std::string nearestWord(const std::string& word, const std::vector<std::string>& allowed);

// " Did you mean 'x'?" or nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& allowed);

// "a, b, c" for messages.
std::string joinWords(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace corpuscle
