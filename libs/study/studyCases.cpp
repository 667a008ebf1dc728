#include "study/studyCases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "core/dictionaryEdit.hpp"

namespace corpuscle::study {
namespace {

constexpr std::size_t longestName = 80;

// A value as part of a file name, without the characters that a shell would treat as special.
std::string fileText(const std::string& value) {
    std::string text;
    for (std::size_t k = 0; k < value.size(); ++k) {
        const char c = value[k];
        if (std::isalnum(static_cast<unsigned char>(c)) || std::string_view(".+-_").find(c) != std::string_view::npos)
            text += c;
        else if ((c == '/' || c == ',' || (c == ' ' && k + 1 < value.size() && std::isdigit(value[k + 1]) != 0)) &&
                 !text.ends_with('_'))
            text += '_';  // "10 1/s" is 10_1_s
    }
    return text;
}

void nameByNumber(std::vector<StudyCase>& cases) {
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(cases.size()).size());
    for (std::size_t k = 0; k < cases.size(); ++k) cases[k].name = fmt::format("case{:0{}}", k + 1, digits);
}

void nameByValues(std::vector<StudyCase>& cases, const StudySettings& study) {
    std::set<std::string> names;
    bool isClear = true;
    for (StudyCase& one : cases) {
        for (const auto& [parameter, value] : one.values)
            if (!study.parameters.at(parameter).with)
                one.name += (one.name.empty() ? "" : "-") + parameter + fileText(value);
        isClear = isClear && one.name.size() <= longestName && names.insert(one.name).second;
    }
    if (!isClear) nameByNumber(cases);
}

}  // namespace

std::vector<StudyCase> casesOf(const StudySettings& study, const std::vector<std::string>& order) {
    std::vector<std::size_t> levels;
    std::map<std::string, std::size_t> axis;  // index in `levels` of each parameter
    for (const std::string& name : order)
        if (const ParameterSettings& p = study.parameters.at(name); !p.with) {
            axis[name] = levels.size();
            levels.push_back(p.levels());
        }
    for (const auto& [name, p] : study.parameters)
        if (p.with) axis[name] = axis.at(*p.with);
    std::vector<StudyCase> cases;
    for (const std::vector<double>& point : study.sampling->points(levels)) {
        StudyCase one;
        for (const std::string& change : study.set) one.settings.push_back(parseOverride(change));
        for (const std::string& name : order) {
            const ParameterSettings& p = study.parameters.at(name);
            one.values.emplace_back(name, p.value(point[axis.at(name)]));
            for (const std::string& key : p.allKeys())
                one.settings.push_back(parseOverride(key + "=" + one.values.back().second));
        }
        cases.push_back(std::move(one));
    }
    if (study.sampling->namesByValues())
        nameByValues(cases, study);
    else
        nameByNumber(cases);
    return cases;
}

std::map<std::string, std::string> dictionariesWith(const std::filesystem::path& templateCase,
                                                    const std::vector<Override>& settings) {
    std::map<std::string, std::string> files;
    for (const Override& change : settings) {
        const std::string file = std::filesystem::path(change.file).lexically_normal().string();
        if (!files.contains(file)) {
            const std::vector<std::string> known = dictionariesOf(templateCase);
            if (std::find(known.begin(), known.end(), file) == known.end())
                throw Failure(
                    ExitCode::invalidCase,
                    fmt::format("{}:{}: the template {} has no such file.{} It has {}.", change.file, change.path,
                                templateCase.string(), didYouMean(change.file, known), joinWords(known)));
            files[file] = readFile(templateCase / file);
        }
        files[file] = withEntry(files[file], change);
    }
    return files;
}

std::vector<std::string> programsOf(const std::filesystem::path& templateCase,
                                    const std::map<std::string, std::string>& dictionaries) {
    const auto has = [&](const char* file) { return std::filesystem::is_regular_file(templateCase / file); };
    const auto read = [&](const char* file) {
        Problems problems;
        const auto changed = dictionaries.find(file);
        Node node = parseDictionary(changed == dictionaries.end() ? readFile(templateCase / file) : changed->second,
                                    file, problems);
        problems.throwIfAny();
        return node;
    };
    if (!has("system/control.yaml")) return {"membraneRelax"};
    const Node control = read("system/control.yaml");
    const Node mesh = has("system/mesh.yaml") ? read("system/mesh.yaml") : Node();
    std::vector<std::string> programs;
    if (has("system/pack.yaml")) programs.emplace_back("cellPack");
    if (mesh.find("cells") || mesh.find("bodies")) programs.emplace_back("membraneMesh");
    programs.emplace_back("particleFill");
    const Node* application = control.find("application");
    programs.push_back(application && !application->scalar.empty() ? application->scalar : "dmpFlow");
    return programs;
}

}  // namespace corpuscle::study
