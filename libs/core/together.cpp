#include "core/together.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <new>

#include "core/machineMemory.hpp"

namespace corpuscle {

Failure memoryFailure() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    constexpr double kibibyte = 1024;
    const AvailableMemory memory = availableMemory();
    const MemoryLimit& least = memory.own.bytes < memory.shared.bytes ? memory.own : memory.shared;
    return {ExitCode::io,
            fmt::format("no memory is left: this process had up to {}, asked for more, and was refused ({} left: {}). "
                        "Take a larger "
                        "spacing or a smaller box, more machines, or raise the limit; checkCase says what a run needs",
                        formatBytes(kibibyte * static_cast<double>(usage.ru_maxrss)), formatBytes(least.bytes),
                        least.name)};
}

Failure fileFailure(const std::filesystem::filesystem_error& error) {
    std::string files = error.path1().string();
    if (!error.path2().empty()) files += " and " + error.path2().string();
    return {ExitCode::io, fmt::format("{}: {}", files, error.code().message())};
}

std::string wordsFor(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error)) return memoryFailure().what();
    if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
        return fileFailure(*file).what();
    return error.what();
}

int firstFailed(MPI_Comm comm, bool failed, std::string& text) {
    int rank = 0, size = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    const int mine = failed ? rank : size;
    int first = size;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
    if (first == size) return -1;
    int length = static_cast<int>(text.size());
    MPI_Bcast(&length, 1, MPI_INT, first, comm);
    text.resize(static_cast<std::size_t>(length));
    MPI_Bcast(text.data(), length, MPI_CHAR, first, comm);
    return first;
}

void throwTogether(MPI_Comm comm, bool failed, const std::string& text, ExitCode code) {
    std::string message = text;
    if (firstFailed(comm, failed, message) >= 0) throw Failure(code, message);
}

}  // namespace corpuscle
