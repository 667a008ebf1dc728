#include "io/earlierRun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <limits>
#include <set>

#include "core/atomicFile.hpp"
#include "core/error.hpp"
#include "core/together.hpp"
#include "io/checkpointFile.hpp"
#include "io/publish.hpp"
#include "io/vtkSeries.hpp"

namespace corpuscle::io {

namespace {

constexpr double slack = 1e-8;  // relative to the start: the entry at that time is the earlier run's, and stays

// "<stream>_000012", as a stream names its entries.
bool isEntryOf(const std::string& stem, const std::string& stream) {
    return stem.size() > stream.size() + 1 && stem.starts_with(stream + "_") &&
           std::all_of(stem.begin() + static_cast<long>(stream.size()) + 1, stem.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// Removes all numbered entries of a stream's folder except `kept`, also the pieces of an interrupted write, which are
// in no index.
void removeAllBut(const std::set<std::string>& kept, const std::filesystem::path& folder, const std::string& stream) {
    std::error_code ignored;
    for (const std::filesystem::path& path : entriesOf(folder)) {
        const std::string stem = path.stem().string();
        if (isEntryOf(stem, stream) && !kept.contains(stem)) std::filesystem::remove_all(path, ignored);
    }
    if (entriesOf(folder).empty()) std::filesystem::remove(folder, ignored);
}

// What a killed program was writing by writeFileAtomically: `isOwn` says for which files.
template <class IsOwn>
void removeUnfinished(const std::filesystem::path& folder, IsOwn&& isOwn) {
    std::error_code ignored;
    for (const std::filesystem::path& path : entriesOf(folder))
        if (const std::filesystem::path file = fileOfTemporary(path); !file.empty() && isOwn(file))
            std::filesystem::remove(path, ignored);
}

void removeUnfinished(const std::filesystem::path& caseDir) {
    removeUnfinished(caseDir, [](const std::filesystem::path& file) {
        return file.filename() == "run.json" || file.filename() == "used.yaml";
    });
    const std::filesystem::path results = caseDir / "results";
    removeUnfinished(results, [](const std::filesystem::path& file) { return file.extension() == ".pvd"; });
    for (const std::filesystem::path& folder : entriesOf(results))
        removeUnfinished(folder, [&](const std::filesystem::path& file) {
            return file.extension() == ".pvtp" && isEntryOf(file.stem().string(), folder.filename().string());
        });
}

void clearStream(const std::filesystem::path& index, double last, bool all, ClearedOutput& cleared) {
    const std::string stream = index.stem().string();
    std::vector<SeriesEntry> entries;
    try {
        entries = readPvd(index);
    } catch (const Failure&) {
        if (!all) throw;
    }
    const auto isOwn = [&](const SeriesEntry& entry) {
        return entry.file.parent_path().filename() == stream && isEntryOf(entry.file.stem().string(), stream);
    };
    if (!std::all_of(entries.begin(), entries.end(), isOwn)) return;  // a collection not written by Corpuscle
    std::vector<SeriesEntry> kept;
    if (!all)
        std::copy_if(entries.begin(), entries.end(), std::back_inserter(kept),
                     [&](const SeriesEntry& entry) { return entry.time <= last; });
    if (const auto gone = static_cast<long>(entries.size() - kept.size()); gone > 0) {
        cleared.times += gone;
        cleared.streams.push_back(stream);
    }
    // First the index, so that it never names a file that is gone.
    std::set<std::string> names;
    for (const SeriesEntry& entry : kept) names.insert(entry.file.stem().string());
    if (kept.empty())
        std::filesystem::remove(index);
    else if (kept.size() < entries.size())
        writePvd(index, kept);
    removeAllBut(names, index.parent_path() / stream, stream);
}

}  // namespace

std::string ClearedOutput::text() const {
    std::string text;
    if (times > 0) text = fmt::format("{} time{} of {} in results/", times, times > 1 ? "s" : "", joinWords(streams));
    if (checkpoints > 0)
        text += fmt::format("{}{} checkpoint{}", text.empty() ? "" : " and ", checkpoints, checkpoints > 1 ? "s" : "");
    return text;
}

ClearedOutput clearAfter(MPI_Comm comm, const std::filesystem::path& caseDir, std::optional<double> start) {
    ClearedOutput cleared;
    onRoot(comm, [&] {
        const double last = start ? *start * (1 + slack) : -std::numeric_limits<double>::infinity();
        removeUnfinished(caseDir);
        cleared.checkpoints = removeCheckpoints(caseDir, start ? std::optional<double>(last) : std::nullopt);
        for (const std::filesystem::path& path : entriesOf(caseDir / "results"))
            if (path.extension() == ".pvd") clearStream(path, last, !start, cleared);
    });
    return cleared;
}

}  // namespace corpuscle::io
