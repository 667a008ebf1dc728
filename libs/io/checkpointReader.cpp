#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/together.hpp"
#include "io/checkpointAccess.hpp"
#include "io/checkpointFile.hpp"

namespace corpuscle::io {

struct CheckpointReader::File {
    MPI_Comm comm;
    int rank = 0, size = 1;
    std::filesystem::path path;
    std::optional<CheckpointAccess> access;

    File(MPI_Comm c, const std::filesystem::path& p) : comm(c), path(p) {
        MPI_Comm_rank(comm, &rank);
        MPI_Comm_size(comm, &size);
        guarded([&] { access.emplace(path); });
    }

    // Runs work() on all ranks; a failure on any rank is thrown on all, with the checkpoint to restart from instead.
    template <class Work>
    void guarded(Work&& work) {
        try {
            together(comm, work);
        } catch (const Failure& failure) {
            const std::string advice = rank == 0 ? adviceOnOlder() : "";
            throwTogether(comm, rank == 0, fmt::format("{} {}", failure.what(), advice));
            throw;
        }
    }

    std::string adviceOnOlder() const {
        const auto all = listCheckpoints(path.parent_path().parent_path());
        const auto found = std::find_if(all.rbegin(), all.rend(), [&](const CheckpointInfo& info) {
            return info.path.filename() < path.filename() && checkCheckpoint(info.path).empty();
        });
        if (found != all.rend())
            return fmt::format("The newest intact one before it is {}: restart with -restart {:.9g}.",
                               found->path.string(), found->time);
        return "There is no intact one before it: start from the beginning.";
    }

    template <class T>
    std::vector<T> distributed(const std::string& name, int components) {
        std::vector<T> values;
        std::uint64_t expected = 0, mine = 0, sum = 0;
        guarded([&] {
            const auto dataset = access->open(name);
            access->require<T>(dataset, components);
            const auto [first, count] = access->share(dataset, rank, size);
            values = access->slab<T>(dataset, first, count, mine);
            expected = dataset.sum;
        });
        MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, comm);
        guarded([&] {
            if (sum != expected) throw access->corrupt(name);
        });
        return values;
    }

    template <class T>
    std::vector<T> replicated(const std::string& name) {
        std::vector<T> values;
        guarded([&] {
            const auto dataset = access->open(name);
            access->require<T>(dataset, 1);
            values = access->whole<T>(dataset);
        });
        return values;
    }
};

CheckpointReader::CheckpointReader(MPI_Comm comm, const std::filesystem::path& path)
    : file_(std::make_unique<File>(comm, path)) {}
CheckpointReader::~CheckpointReader() = default;

template <class T>
std::vector<T> CheckpointReader::readDistributed(const std::string& name, int components) {
    return file_->distributed<T>(name, components);
}
template <class T>
std::vector<T> CheckpointReader::readReplicated(const std::string& name) {
    return file_->replicated<T>(name);
}
template <class T>
T CheckpointReader::attribute(const std::string& name) {
    T value{};
    file_->guarded([&] { value = file_->access->attribute<T>(name); });
    return value;
}
bool CheckpointReader::has(const std::string& name) const {
    const auto& names = file_->access->names();
    return std::binary_search(names.begin(), names.end(), name);
}
bool CheckpointReader::sameRanks() const { return file_->access->ranksWritten() == file_->size; }

template std::vector<double> CheckpointReader::readDistributed(const std::string&, int);
template std::vector<std::int64_t> CheckpointReader::readDistributed(const std::string&, int);
template std::vector<double> CheckpointReader::readReplicated(const std::string&);
template std::vector<std::int64_t> CheckpointReader::readReplicated(const std::string&);
template double CheckpointReader::attribute(const std::string&);
template std::int64_t CheckpointReader::attribute(const std::string&);
template std::string CheckpointReader::attribute(const std::string&);

}  // namespace corpuscle::io
