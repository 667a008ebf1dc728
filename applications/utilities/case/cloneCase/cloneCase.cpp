// cloneCase: copies a case without what its runs have left, so that the copy starts anew.
//
// Copied: system/, constant/, and whatever else is beside them (Allrun, README.md, surfaces), but for what programs
// write: 0/, results/, postProcessing/, checkpoints/, runs/, log.*, run.json, used.yaml, stop, and hidden files.
// Changes by -set are written into the dictionaries of the copy, in place of the old value, so that comments stay.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/atomicFile.hpp"
#include "core/caseLock.hpp"
#include "core/error.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

bool isCase(const fs::path& folder) {
    return fs::is_regular_file(folder / "system" / "control.yaml") ||
           fs::is_regular_file(folder / "system" / "relax.yaml");
}

bool isOutput(const fs::path& path) {
    const std::string name = path.filename().string();
    const std::vector<std::string> written{"0",        "results",   "postProcessing", "checkpoints",     "runs",
                                           "run.json", "used.yaml", "stop",           CaseLock::fileName};
    return name.starts_with('.') || name.starts_with("log.") ||
           std::find(written.begin(), written.end(), name) != written.end();
}

void requireCase(const fs::path& from) {
    if (!fs::is_directory(from))
        throw Failure(ExitCode::io, fmt::format("{}: there is no such directory.", from.string()));
    if (isCase(from)) return;
    std::vector<std::string> below;
    for (const auto& entry : fs::directory_iterator(from))
        if (entry.is_directory() && isCase(entry.path())) below.push_back(entry.path().string());
    std::sort(below.begin(), below.end());
    throw Failure(ExitCode::invalidCase,
                  fmt::format("{} is not a case: it has neither system/control.yaml nor system/relax.yaml.{}",
                              from.string(), below.empty() ? "" : " Cases in it: " + joinWords(below) + "."));
}

void requireFree(const fs::path& from, const fs::path& to) {
    if (fs::exists(to) && !(fs::is_directory(to) && fs::is_empty(to)))
        throw Failure(ExitCode::io,
                      fmt::format("{} exists already and is not an empty directory: give another name, or "
                                  "remove it first.",
                                  to.string()));
    const fs::path inner = fs::weakly_canonical(to).lexically_relative(fs::weakly_canonical(from));
    if (!inner.empty() && *inner.begin() != "..")
        throw Failure(ExitCode::usage,
                      fmt::format("{} lies in {}: a case cannot be copied into itself.", to.string(), from.string()));
}

const Node* nodeAt(const Node& root, const std::string& path) {
    const Node* node = &root;
    for (std::size_t begin = 1; node && begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string word = path.substr(begin, end - begin);
        if (node->kind == Node::Kind::list) {
            const bool number = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
            node = number && word.size() < 6 && std::stoul(word) < node->items.size() ? &node->items[std::stoul(word)]
                                                                                      : nullptr;
        } else {
            node = node->find(word);
        }
        begin = end + 1;
    }
    return node;
}

// Where a value that begins at `begin` ends: a list or table in brackets at its closing one, a word where it was read
// to.
std::size_t endOf(const std::string& text, std::size_t begin, const Node& value) {
    if (text[begin] == '[' || text[begin] == '{') {
        int depth = 0;
        for (std::size_t i = begin; i < text.size(); ++i) {
            if (text[i] == '[' || text[i] == '{') ++depth;
            if ((text[i] == ']' || text[i] == '}') && --depth == 0) return i + 1;
        }
        return std::string::npos;
    }
    if (value.kind != Node::Kind::scalar) return std::string::npos;
    return begin + value.scalar.size() + (value.quoted ? 2 : 0);
}

std::string changed(const std::string& text, const Override& change) {
    Problems problems;
    const Node before = parseDictionary(text, change.file, problems);
    Node wanted = before;
    applyOverride(wanted, change, problems);
    problems.throwIfAny();
    const Node* old = nodeAt(before, change.path);
    if (old && old->mark.line > 0 && !old->isNothing()) {
        std::size_t begin = 0;
        for (int line = 1; line < old->mark.line; ++line) begin = text.find('\n', begin) + 1;
        begin += static_cast<std::size_t>(old->mark.column - 1);
        const std::size_t end = endOf(text, begin, *old);
        if (end <= text.size()) {
            std::string result = text.substr(0, begin) + change.value + text.substr(end);
            Problems ignored;
            if (emit(parseDictionary(result, change.file, ignored)) == emit(wanted) && ignored.empty()) return result;
        }
    }
    throw Failure(
        ExitCode::invalidCase,
        fmt::format("-set {}:{}={}: only a value that stands in the file can be replaced; nothing was copied. "
                    "Copy without this -set and write it into {} by hand.",
                    change.file, change.path, change.value, change.file));
}

// The dictionaries that -set changes, by their path in the case.
std::vector<std::pair<fs::path, std::string>> changedFiles(const Application& app, const fs::path& from) {
    std::vector<std::pair<fs::path, std::string>> files;
    for (const Override& change : app.overrides()) {
        const fs::path name = fs::path(change.file).lexically_normal();
        auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
        if (found == files.end()) found = files.insert(files.end(), {name, readFile(from / name)});
        found->second = changed(found->second, change);
    }
    return files;
}

// The case of the option -set is the first argument.
std::vector<char*> withCase(int argc, char** argv) {
    static char option[] = "-case";
    std::vector<char*> words(argv, argv + argc);
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "-case" || word == "--case") break;
        if (word == "-set" || word == "--set") {
            ++i;
        } else if (!word.starts_with('-')) {
            words.push_back(option);
            words.push_back(argv[i]);
            break;
        }
    }
    return words;
}

Usage usage() {
    return {
        .arguments = {{"FROM", "", "The case to copy."}, {"TO", "", "The new case; it must not exist, or be empty."}},
        .samples = {"cloneCase tutorials/rbcShear/Ca0.02 myCell",
                    "cloneCase myCell stiffer -set constant/flow.yaml:/Ca=0.01"}};
}

}  // namespace

int main(int argc, char* argv[]) {
    std::vector<char*> words = withCase(argc, argv);
    words.push_back(nullptr);
    Application app("cloneCase", "Copies a case without its results.", static_cast<int>(words.size()) - 1, words.data(),
                    usage());
    return app.run([&] {
        if (!app.communicator().isRoot()) return ExitCode::done;
        const fs::path from = app.arguments()[0], to = app.arguments()[1];
        requireCase(from);
        requireFree(from, to);
        const auto changes = changedFiles(app, from);

        std::vector<std::string> copied, left;
        fs::create_directories(to);
        for (const auto& entry : fs::directory_iterator(from)) {
            const std::string name = entry.path().filename().string();
            if (isOutput(entry.path())) {
                if (!name.starts_with('.')) left.push_back(name);
                continue;
            }
            fs::copy(entry.path(), to / name, fs::copy_options::recursive);
            copied.push_back(name);
        }
        for (const auto& [file, text] : changes) writeFileAtomically(to / file, text);
        std::sort(copied.begin(), copied.end());
        std::sort(left.begin(), left.end());

        app.log().info("{}: {}{}", to.string(), joinWords(copied),
                       left.empty() ? "" : fmt::format("; left behind: {}", joinWords(left)));
        for (const Override& change : app.overrides())
            app.log().info("{}: {} is {}", change.file, change.path.substr(1), change.value);
        if (app.json())
            fmt::print("{}\n", nlohmann::json{{"case", to.string()}, {"copied", copied}, {"left", left}}.dump(2));
        return ExitCode::done;
    });
}
