#include "study/caseRecord.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/atomicFile.hpp"
#include "core/caseFolder.hpp"
#include "io/checksum.hpp"

namespace corpuscle::study {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

Json toJson(const CaseRecord::Ended& ended) {
    Json json{{"program", ended.program}, {"code", ended.code}, {"seconds", ended.seconds}};
    if (!ended.logEnd.empty()) json["logEnd"] = ended.logEnd;
    return json;
}

CaseRecord::Ended toEnded(const Json& json) {
    return {.program = json.at("program"),
            .code = json.at("code"),
            .seconds = json.at("seconds"),
            .logEnd = json.value("logEnd", "")};
}

}  // namespace

double CaseRecord::seconds() const {
    double sum = stoppedSeconds + (failed ? failed->seconds : 0);
    for (const Ended& ended : done) sum += ended.seconds;
    return sum;
}

void CaseRecord::write(const fs::path& caseDir) const {
    Json json{{"study", study}};
    for (const auto& [name, value] : values) json["values"][name] = value;
    json["files"] = files;
    json["done"] = Json::array();
    for (const Ended& ended : done) json["done"].push_back(toJson(ended));
    if (failed) json["failed"] = toJson(*failed);
    json["stoppedSeconds"] = stoppedSeconds;
    writeFileAtomically(caseDir / fileName, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<CaseRecord> CaseRecord::read(const fs::path& caseDir) {
    const fs::path path = caseDir / fileName;
    if (!fs::is_regular_file(path)) return std::nullopt;
    try {
        const Json json = Json::parse(readFile(path));
        CaseRecord record;
        record.study = json.at("study");
        if (json.contains("values"))
            for (const auto& [name, value] : json.at("values").items()) record.values.emplace_back(name, value);
        record.files = json.at("files").get<std::map<std::string, std::string>>();
        for (const Json& ended : json.at("done")) record.done.push_back(toEnded(ended));
        if (json.contains("failed")) record.failed = toEnded(json.at("failed"));
        record.stoppedSeconds = json.at("stoppedSeconds");
        return record;
    } catch (const Json::exception&) {
        throw Failure(ExitCode::invalidCase, fmt::format("{} is damaged: remove {}, and the case is made anew.",
                                                         path.string(), caseDir.string()));
    }
}

std::map<std::string, std::string> otherFiles(const fs::path& caseDir, const std::string& excluded) {
    std::map<std::string, std::string> files;
    for (const std::string& file : dataFilesOf(caseDir, excluded))
        files[file] = fmt::format("{:016x}", io::checksum(std::string_view(readFile(caseDir / file))));
    return files;
}

}  // namespace corpuscle::study
