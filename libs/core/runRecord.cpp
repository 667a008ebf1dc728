#include "core/runRecord.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/atomicFile.hpp"
#include "core/buildInfo.hpp"

namespace corpuscle {

namespace {
constexpr long roomToEnd = 1 << 15;  // reserved to record the end of a run on a full disk [bytes]
}

std::string timestamp() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

RunRecord::RunRecord(std::filesystem::path file, const std::string& application, const Communicator& communicator)
    : file_(std::move(file)),
      isRoot_(communicator.isRoot()),
      start_(std::chrono::steady_clock::now()),
      record_(std::make_unique<nlohmann::ordered_json>()) {
    const BuildInfo& build = buildInfo();
    const MachineInfo machine = machineInfo();
    *record_ = {
        {"application", application},
        {"status", "running"},
        {"reason", ""},
        {"start", timestamp()},
        {"end", nullptr},
        {"wallClock_s", nullptr},
        {"version", build.version},
        {"versions", nlohmann::ordered_json::object()},
        {"build",
         {{"git", build.gitDescribe}, {"compiler", build.compiler}, {"flags", build.flags}, {"type", build.type}}},
        {"machine",
         {{"host", machine.host},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"system", machine.system}}},
        {"ranks", communicator.size()}};
    for (const auto& [library, version] : build.libraries) setJson("versions", library, version);
}

RunRecord::~RunRecord() = default;

void RunRecord::put(const std::string& section, const std::string& key, const Value& value) {
    setJson(section, key, std::visit([](const auto& v) { return nlohmann::ordered_json(v); }, value));
}

void RunRecord::setJson(const std::string& section, const std::string& key, const nlohmann::ordered_json& value) {
    (section.empty() ? *record_ : (*record_)[section])[key] = value;
}

// The library writes numbers that are not finite as null.
std::string RunRecord::text() const {
    return record_->dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void RunRecord::write() const {
    if (isRoot_) writeFileAtomically(file_, text(), roomToEnd);
}

void RunRecord::print() const {
    if (isRoot_) fmt::print("{}", text());
}

void RunRecord::close(ExitCode code, const std::string& reason) {
    set("", "status", code == ExitCode::done ? "done" : code == ExitCode::stopped ? "stopped" : "failed");
    set("", "reason", reason);
    set("", "end", timestamp());
    set("", "wallClock_s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
    finished_ = true;
}

void RunRecord::finish(ExitCode code, const std::string& reason) {
    close(code, reason);
    write();
}

void RunRecord::fail(ExitCode code, const std::string& reason) noexcept {
    try {
        close(code, reason);
        try {
            writeFileAtomically(file_, text());
        } catch (const Failure&) {
            overwriteFile(file_, text());
        }
    } catch (const std::exception&) {
        return;  // the reason has been printed on the terminal
    }
}

void writeUsed(const std::filesystem::path& file, const std::vector<Node::Entry>& dictionaries,
               const Communicator& communicator) {
    if (!communicator.isRoot()) return;
    Node all;
    all.entries = dictionaries;
    writeFileAtomically(file, fmt::format("# The effective settings of the last run, written by Corpuscle {}.\n{}",
                                          buildInfo().version, emit(all)));
}

}  // namespace corpuscle
