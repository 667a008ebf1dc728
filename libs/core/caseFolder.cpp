#include "core/caseFolder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/caseLock.hpp"
#include "core/error.hpp"

namespace corpuscle {

namespace fs = std::filesystem;

namespace {

constexpr const char* bytecode = "__pycache__";  // left by scripts in Python, at any depth

void copyWithoutBytecode(const fs::path& from, const fs::path& to) {
    if (!fs::is_directory(from)) {
        fs::copy(from, to);
        return;
    }
    fs::create_directory(to, from);
    for (const auto& entry : fs::directory_iterator(from))
        if (entry.path().filename() != bytecode) copyWithoutBytecode(entry.path(), to / entry.path().filename());
}

}  // namespace

bool isCase(const fs::path& folder) {
    return fs::is_regular_file(folder / "system" / "control.yaml") ||
           fs::is_regular_file(folder / "system" / "relax.yaml");
}

bool isOutput(const fs::path& path) {
    const std::string name = path.filename().string();
    const std::vector<std::string> written{"0",          "results",          "postProcessing", "checkpoints",
                                           "runs",       "run.json",         "used.yaml",      "stop",
                                           "sweep.json", CaseLock::fileName, bytecode};
    if (name.starts_with('.') || name.starts_with("log.") ||
        std::find(written.begin(), written.end(), name) != written.end())
        return true;
    std::error_code ignored;  // the cases of a study
    if (fs::is_directory(path, ignored))
        for (const auto& entry : fs::directory_iterator(path, ignored))
            if (fs::exists(entry.path() / "sweep.json", ignored)) return true;
    return false;
}

void requireCase(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw Failure(ExitCode::io, fmt::format("{}: there is no such directory.", folder.string()));
    if (isCase(folder)) return;
    std::vector<std::string> below;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory() && isCase(entry.path())) below.push_back(entry.path().string());
    std::sort(below.begin(), below.end());
    throw Failure(ExitCode::invalidCase,
                  fmt::format("{} is not a case: it has neither system/control.yaml nor system/relax.yaml.{}",
                              folder.string(), below.empty() ? "" : " Cases in it: " + joinWords(below) + "."));
}

CopiedCase copyCase(const fs::path& from, const fs::path& to, const std::string& excluded) {
    requireCase(from);
    if (fs::exists(to) && !(fs::is_directory(to) && fs::is_empty(to)))
        throw Failure(ExitCode::io,
                      fmt::format("{} exists already and is not an empty directory: give another name, or "
                                  "remove it first.",
                                  to.string()));
    const fs::path inner = fs::weakly_canonical(to).lexically_relative(fs::weakly_canonical(from));
    if (!inner.empty() && *inner.begin() != ".." && inner.begin()->string() != excluded)
        throw Failure(ExitCode::usage,
                      fmt::format("{} lies in {}: a case cannot be copied into itself.", to.string(), from.string()));
    CopiedCase names;
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from)) {
        const std::string name = entry.path().filename().string();
        if (isOutput(entry.path()) || name == excluded) {
            if (!name.starts_with('.')) names.left.push_back(name);
            continue;
        }
        copyWithoutBytecode(entry.path(), to / name);
        names.copied.push_back(name);
    }
    std::sort(names.copied.begin(), names.copied.end());
    std::sort(names.left.begin(), names.left.end());
    return names;
}

namespace {

bool isEditorsCopy(const std::string& name) {
    const auto ends = [&](const char* ending) { return name.ends_with(ending); };
    return name.starts_with('.') || name.starts_with('#') || ends("~") || ends(".tmp") || ends(".bak") ||
           ends(".orig") || ends(".swp");
}

}  // namespace

std::vector<std::string> dataFilesOf(const fs::path& caseDir, const std::string& excluded) {
    const std::vector<std::string> dictionaries = dictionariesOf(caseDir);
    std::vector<std::string> files;
    for (const auto& top : fs::directory_iterator(caseDir)) {
        const std::string name = top.path().filename().string();
        if (isOutput(top.path()) || name == excluded) continue;
        const auto add = [&](const fs::path& file) {
            const std::string path = file.lexically_relative(caseDir).string(), ending = file.extension().string();
            const bool isAtTop = file.parent_path() == caseDir;
            const bool isOther =
                ending == ".md" || ending == ".png" || ending == ".pyc" ||
                (isAtTop && (ending.empty() || ending == ".yaml" || ending == ".gp" || ending == ".py"));
            if (!isOther && !isEditorsCopy(file.filename().string()) &&
                std::find(dictionaries.begin(), dictionaries.end(), path) == dictionaries.end())
                files.push_back(path);
        };
        if (top.is_regular_file()) add(top.path());
        if (top.is_directory())
            for (const auto& entry : fs::recursive_directory_iterator(top.path()))
                if (entry.is_regular_file()) add(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::string> dictionariesOf(const fs::path& caseDir) {
    std::vector<std::string> files;
    for (const char* folder : {"system", "constant", "constant/cells"})
        if (fs::is_directory(caseDir / folder))
            for (const auto& entry : fs::directory_iterator(caseDir / folder))
                if (entry.is_regular_file() && entry.path().extension() == ".yaml" &&
                    !entry.path().filename().string().starts_with('.'))
                    files.push_back(std::string(folder) + "/" + entry.path().filename().string());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace corpuscle
