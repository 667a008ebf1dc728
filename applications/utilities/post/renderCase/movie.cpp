#include "movie.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/error.hpp"
#include "study/process.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

bool isOnPath(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

std::string contentsOf(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

Movie::Movie(fs::path file, long picturesPerSecond) : file_(std::move(file)), picturesPerSecond_(picturesPerSecond) {
    if (file_.extension() != ".mp4")
        throw Failure(ExitCode::usage,
                      fmt::format("-movie {}: an MP4 file is written; its name ends in .mp4.", file_.string()));
    if (!isOnPath("ffmpeg"))
        throw Failure(
            ExitCode::io,
            "-movie: ffmpeg is not installed: apt-get install ffmpeg. -series writes the pictures without it.");
    folder_ = fs::absolute(file_).parent_path() / fmt::format(".{}.{}", file_.filename().string(), getpid());
    std::error_code fault;
    fs::create_directories(folder_, fault);
    if (fault) throw Failure(ExitCode::io, fmt::format("{}: cannot be made: {}", folder_.string(), fault.message()));
}

Movie::~Movie() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

fs::path Movie::picture(std::size_t number) const { return folder_ / fmt::format("{:06}.png", number); }

// Video players need even widths and heights, and colours at half the resolution.
void Movie::write() const {
    const fs::path log = folder_ / "log", made = folder_ / "movie.mp4";
    study::Process process({"ffmpeg",
                            "-y",
                            "-nostdin",
                            "-loglevel",
                            "error",
                            "-framerate",
                            std::to_string(picturesPerSecond_),
                            "-i",
                            (folder_ / "%06d.png").string(),
                            "-vf",
                            "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                            "-c:v",
                            "libx264",
                            "-crf",
                            "18",
                            "-pix_fmt",
                            "yuv420p",
                            "-movflags",
                            "+faststart",
                            made.string()},
                           log, study::Environment::ofThisProcess(), {});
    std::optional<int> code;
    while (!(code = process.poll())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (*code != 0)
        throw Failure(ExitCode::io,
                      fmt::format("{}: ffmpeg ended with code {}: {}", file_.string(), *code, contentsOf(log)));
    std::error_code fault;
    fs::rename(made, file_, fault);
    if (fault) throw Failure(ExitCode::io, fmt::format("{}: cannot be written: {}", file_.string(), fault.message()));
}

}  // namespace corpuscle
