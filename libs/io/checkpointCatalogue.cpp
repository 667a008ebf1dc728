#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/communicator.hpp"
#include "core/together.hpp"
#include "core/units.hpp"
#include "io/checkpointAccess.hpp"
#include "io/checkpointFile.hpp"
#include "io/publish.hpp"

namespace corpuscle::io {
namespace {

std::filesystem::path folderOf(const std::filesystem::path& caseDir) { return caseDir / "checkpoints"; }

// The files named <digits>.h5, by number.
std::vector<std::pair<int, std::filesystem::path>> numberedFiles(const std::filesystem::path& caseDir) {
    std::vector<std::pair<int, std::filesystem::path>> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folderOf(caseDir), ignored)) {
        const std::string stem = entry.path().stem().string();
        const bool digits =
            !stem.empty() && std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
        if (digits && entry.path().extension() == ".h5") files.emplace_back(std::atoi(stem.c_str()), entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::filesystem::path> leftovers(const std::filesystem::path& caseDir) {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folderOf(caseDir), ignored)) {
        if (isTemporaryName(entry.path())) files.push_back(entry.path());
    }
    return files;
}

// Together with the files that Open MPI keeps beside a file while several ranks write to it: .000012.h5.part.data.1
void removeLeftovers(const std::filesystem::path& caseDir) {
    std::error_code ignored;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folderOf(caseDir), ignored)) {
        const std::string name = entry.path().filename().string();
        if (isTemporaryName(entry.path()) || (name.starts_with(".") && name.find(".h5.part.") != std::string::npos))
            files.push_back(entry.path());
    }
    for (const auto& path : files) std::filesystem::remove(path, ignored);
}

}  // namespace

std::filesystem::path nextCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir) {
    int next = 0;
    onRoot(comm, [&] {
        makeFolder(folderOf(caseDir));
        const auto files = numberedFiles(caseDir);
        next = files.empty() ? 0 : files.back().first + 1;
    });
    MPI_Bcast(&next, 1, MPI_INT, 0, comm);
    return folderOf(caseDir) / fmt::format("{:06d}.h5", next);
}

std::string checkCheckpoint(const std::filesystem::path& path) {
    try {
        CheckpointAccess(path).verify();
        return {};
    } catch (const Failure& failure) {
        return failure.what();
    }
}

std::vector<CheckpointInfo> listCheckpoints(const std::filesystem::path& caseDir) {
    std::vector<CheckpointInfo> list;
    for (const auto& [number, path] : numberedFiles(caseDir)) {
        try {
            list.push_back({path, number, CheckpointAccess(path).attribute<double>("time")});
        } catch (const Failure&) {
            continue;  // latestCheckpoint names those that cannot be read
        }
    }
    return list;
}

CheckpointSearch latestCheckpoint(MPI_Comm comm, const std::filesystem::path& caseDir) {
    CheckpointSearch search;
    onRoot(comm, [&] {
        for (const auto& path : leftovers(caseDir)) {
            search.warnings.push_back(
                fmt::format("{} is an incomplete checkpoint of a killed run and is passed over.", path.string()));
        }
        auto files = numberedFiles(caseDir);
        for (auto file = files.rbegin(); file != files.rend() && search.path.empty(); ++file) {
            const std::string problem = checkCheckpoint(file->second);
            if (problem.empty())
                search.path = file->second;
            else
                search.warnings.push_back(problem + " It is passed over.");
        }
        if (!files.empty() && search.path.empty())
            throw Failure(ExitCode::io,
                          fmt::format("{}: none of the {} checkpoint{} is intact:\n{}\nStart from the beginning with "
                                      "'startFrom: firstTime' in system/control.yaml, or bring back a copy.",
                                      folderOf(caseDir).string(), files.size(), files.size() == 1 ? "" : "s",
                                      joinWords(search.warnings, "\n")));
    });
    search.path = Communicator(comm).broadcast(search.path.string());
    int count = static_cast<int>(search.warnings.size());
    MPI_Bcast(&count, 1, MPI_INT, 0, comm);
    search.warnings.resize(static_cast<std::size_t>(count));
    for (auto& warning : search.warnings) warning = Communicator(comm).broadcast(warning);
    return search;
}

CheckpointInfo findCheckpoint(const std::filesystem::path& caseDir, double time) {
    const auto all = listCheckpoints(caseDir);
    const auto distance = [&](const CheckpointInfo* info) { return std::abs(info->time - time); };
    const CheckpointInfo *meant = nullptr, *before = nullptr;
    for (const CheckpointInfo& info : all) {
        if (info.time <= time && (!before || info.time >= before->time)) before = &info;
        if (!meant || distance(&info) <= distance(meant)) meant = &info;
    }
    if (meant && distance(meant) <= checkpointSlack * time) return *meant;
    if (before) return *before;
    std::vector<std::string> times;
    times.reserve(all.size());
    for (const auto& info : all) times.push_back(formatQuantity(info.time, unit::second, 9));
    throw Failure(ExitCode::io,
                  fmt::format("{}: there is no checkpoint at {} or before; {}", folderOf(caseDir).string(),
                              formatQuantity(time, unit::second, 9),
                              times.empty() ? "there is none at all. Start from firstTime"
                                            : fmt::format("there are: {}. Give one of these times, or start from "
                                                          "firstTime",
                                                          joinWords(times))));
}

long removeCheckpoints(const std::filesystem::path& caseDir, std::optional<double> last) {
    std::vector<std::filesystem::path> gone;
    if (last) {
        for (const CheckpointInfo& info : listCheckpoints(caseDir))
            if (info.time > *last) gone.push_back(info.path);
    } else {
        for (const auto& [number, path] : numberedFiles(caseDir)) gone.push_back(path);
    }
    removeLeftovers(caseDir);
    for (const auto& path : gone) std::filesystem::remove(path);
    return static_cast<long>(gone.size());
}

void keepCheckpoints(MPI_Comm comm, const std::filesystem::path& caseDir, int keep) {
    onRoot(comm, [&] {
        std::error_code ignored;
        removeLeftovers(caseDir);
        const auto files = numberedFiles(caseDir);
        const int surplus = keep > 0 ? static_cast<int>(files.size()) - keep : 0;
        for (int i = 0; i < surplus; ++i) std::filesystem::remove(files[static_cast<std::size_t>(i)].second, ignored);
    });
}

}  // namespace corpuscle::io
