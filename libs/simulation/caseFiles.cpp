#include "simulation/caseFiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "simulation/dictionaries.hpp"

namespace corpuscle::simulation {
namespace {

bool isOneOf(const std::string& word, const std::vector<std::string>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string lowered(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

// Whether a file is ignored: its name is in upper case with any ending (README.md, LICENSE, NOTES.txt), or it is
// hidden, or an editor's copy.
bool isPassedOver(const std::string& name) {
    static const std::vector<std::string> copies{".swp", ".swo", ".bak", ".orig", ".rej", ".old", ".tmp", ".save"};
    if (name.front() == '.' || name.front() == '#' || name.back() == '~') return true;
    const std::filesystem::path path(name);
    if (isOneOf(lowered(path.extension().string()), copies)) return true;
    const std::string stem = path.stem().string();
    const bool isLoud = std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return !std::islower(c); });
    const bool isYaml = isOneOf(lowered(path.extension().string()), {".yaml", ".yml"});
    return (isLoud && !isYaml) || isOneOf(stem, {"Allrun", "Allclean", "Readme"});
}

std::string folderOf(const std::string& file) { return file.substr(0, file.find('/') + 1); }
std::string stemOf(const std::string& file) {
    std::filesystem::path name = std::filesystem::path(file).filename();
    while (name.has_extension()) name = name.stem();
    return name.string();
}

// For a file that seems to be meant as a dictionary but is none: which one, and a message. Empty for other files.
struct Finding {
    std::string meant;  // "system/observers.yaml"; may be ""
    std::string message;
};

Finding find(const std::string& file, const std::vector<std::string>& absent) {
    const std::string folder = folderOf(file), stem = stemOf(file);
    const std::string ending = lowered(std::filesystem::path(file).extension().string());
    const bool isYaml = isOneOf(ending, {".yaml", ".yml"});
    std::vector<std::string> here;  // stems of this folder's dictionaries
    for (const std::string& d : dictionaryFiles()) {
        if (folderOf(d) == folder) here.push_back(stemOf(d));
        if (stemOf(d) == stem && folderOf(d) != folder && isYaml)
            return {d, fmt::format("this dictionary belongs in {0}; move it to {1}", folderOf(d), d)};
    }
    if (folder.empty()) return {};
    // Tables and surfaces may have any name; a file without an ending is taken for a dictionary.
    const bool isLike = isYaml || isOneOf(ending, {"", ".json", ".txt", ".dict", ".in"});
    if (!isLike) return {};
    if (isOneOf(stem, here)) {
        const std::string right = folder + stem + ".yaml";
        if (isOneOf(right, absent))
            return {right,
                    fmt::format("no program reads this file: dictionaries end with '.yaml'. Rename it to {}", right)};
        return {
            "",
            fmt::format(
                "no program reads this file, since {} is there; remove it, or add '.bak' to its name to keep a copy",
                right)};
    }
    std::vector<std::string> missing;
    for (const std::string& d : absent)
        if (folderOf(d) == folder) missing.push_back(stemOf(d));
    std::string nearest = nearestWord(stem, missing);
    if (nearest.empty() && !isYaml && !ending.empty()) return {};
    const std::string meant = nearest.empty() ? "" : folder + nearest + ".yaml";
    if (const std::string there = nearestWord(stem, here); nearest.empty() && !there.empty())
        return {"", fmt::format("no program reads this file; '{}{}.yaml', which its name is near to, is there too. "
                                "Remove it, or add '.bak' to its name to keep a copy",
                                folder, there)};
    return {meant,
            fmt::format("no program reads this file.{} Dictionaries of {}: {}. A copy to keep may end with '.bak'",
                        meant.empty() ? "" : fmt::format(" Did you mean '{}'?", meant), folder, joinWords(here))};
}

}  // namespace

const std::vector<std::string>& dictionaryFiles() {
    static const std::vector<std::string> files = [] {
        std::vector<std::string> names;
        for (const auto& [file, info] : dictionaries()) names.push_back(file);
        return names;
    }();
    return files;
}

std::set<std::string> checkFiles(const std::vector<std::string>& files, Problems& problems) {
    std::set<std::string> meant;
    std::vector<std::string> absent;
    for (const std::string& d : dictionaryFiles())
        if (!isOneOf(d, files)) absent.push_back(d);
    for (const std::string folder : {"system/", "constant/"}) {
        if (isOneOf(folder, files)) continue;
        for (const std::string& other : files) {
            const bool isFolder = other.back() == '/' && other.find('/') == other.size() - 1;
            if (!isFolder || nearestWord(other, {folder}).empty()) continue;
            problems.add({other, 0, 0}, "", fmt::format("no program reads this folder. Did you mean '{}'?", folder));
            for (const std::string& d : absent)
                if (folderOf(d) == folder) meant.insert(d);
            break;
        }
    }
    for (const std::string& file : files) {
        if (file.back() == '/' || isOneOf(file, dictionaryFiles())) continue;
        if (isPassedOver(std::filesystem::path(file).filename().string())) continue;
        const Finding finding = find(file, absent);
        if (finding.message.empty()) continue;
        problems.add({file, 0, 0}, "", finding.message);
        if (!finding.meant.empty()) meant.insert(finding.meant);
    }
    return meant;
}

std::set<std::string> checkFiles(const Application& app, Problems& problems) {
    // Only the root looks at the disk.
    std::string all;
    if (app.communicator().isRoot())
        for (const std::string folder : {"", "system/", "constant/"}) {
            std::error_code none;  // a folder that is missing or unreadable is noticed when its files are read
            for (const auto& entry : std::filesystem::directory_iterator(app.path(folder), none))
                all += folder + entry.path().filename().string() + (entry.is_directory(none) ? "/\n" : "\n");
        }
    all = app.communicator().broadcast(all);
    std::vector<std::string> files;
    std::istringstream lines(all);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) files.push_back(line);
    std::sort(files.begin(), files.end());
    return checkFiles(files, problems);
}

}  // namespace corpuscle::simulation
