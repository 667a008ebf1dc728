// cloneCase: copies a case without the output of its runs, so that the copy starts afresh.
//
// Copied: system/, constant/, and everything beside them (Allrun, README.md, surfaces) except what programs write (0/,
// results/, postProcessing/, checkpoints/, runs/, log.*, run.json, used.yaml, stop) and hidden files. Changes given by
// -set are written into the dictionaries of the copy, whose comments are kept (core/dictionaryEdit.hpp).
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/application.hpp"
#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "core/dictionaryEdit.hpp"
#include "core/error.hpp"
#include "simulation/dictionaries.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

// The dictionaries that -set changes: new text, by path in the case.
std::map<std::string, std::string> changedFiles(const Application& app, const fs::path& from) {
    std::map<std::string, std::string> files;
    for (const Override& change : app.overrides()) {
        const std::string name = fs::path(change.file).lexically_normal().string();
        const auto [found, isNew] = files.try_emplace(name);
        if (isNew) found->second = readFile(from / name);
        found->second = withEntry(found->second, change);
    }
    Problems problems;
    for (const auto& [name, text] : files) simulation::addNewProblems(name, readFile(from / name), text, problems);
    problems.throwIfAny();
    return files;
}

// The case itself, or the one among the installed files that the path names: tutorials/rbcShear/Ca0.02.
std::string installedOr(const std::string& from) {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path installed = program.parent_path().parent_path() / "share" / "corpuscle" / from;
    return !fs::exists(from, ignored) && fs::is_directory(installed, ignored) ? installed.string() : from;
}

// The case to which -set applies is the first argument: passes it on as -case.
std::vector<char*> withCase(int argc, char** argv) {
    static char option[] = "-case";
    static std::string from;
    std::vector<char*> words(argv, argv + argc);
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "-case" || word == "--case") break;
        if (word == "-set" || word == "--set") {
            ++i;
        } else if (!word.starts_with('-')) {
            from = installedOr(word);
            words[static_cast<std::size_t>(i)] = from.data();
            words.push_back(option);
            words.push_back(from.data());
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
        const auto changes = changedFiles(app, from);
        const CopiedCase names = copyCase(from, to);
        for (const auto& [file, text] : changes) writeFileAtomically(to / file, text);

        app.log().info("{}: {}{}", to.string(), joinWords(names.copied),
                       names.left.empty() ? "" : fmt::format("; left behind: {}", joinWords(names.left)));
        for (const Override& change : app.overrides())
            app.log().info("{}: {} is {}", change.file, change.path.substr(1), change.value);
        if (app.json())
            fmt::print("{}\n",
                       nlohmann::json{{"case", to.string()}, {"copied", names.copied}, {"left", names.left}}.dump(2));
        return ExitCode::done;
    });
}
