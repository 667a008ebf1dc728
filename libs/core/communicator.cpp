#include "core/communicator.hpp"

#include <limits>

#include "core/error.hpp"

namespace corpuscle {
namespace {

template <class T>
MPI_Datatype datatype();
template <>
MPI_Datatype datatype<double>() {
    return MPI_DOUBLE;
}
template <>
MPI_Datatype datatype<long>() {
    return MPI_LONG;
}
template <>
MPI_Datatype datatype<int>() {
    return MPI_INT;
}

int count(std::size_t n) {
    if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw Failure(ExitCode::numerics, "a message of more than 2^31 entries");
    return static_cast<int>(n);
}

template <class T>
T reduced(T value, MPI_Op operation, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, datatype<T>(), operation, comm);
    return value;
}

template <class T>
std::vector<T> reduced(std::vector<T> values, MPI_Op operation, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), datatype<T>(), operation, comm);
    return values;
}

template <class T>
std::vector<T> gatheredAll(T value, MPI_Comm comm, int size) {
    std::vector<T> all(static_cast<std::size_t>(size));
    MPI_Allgather(&value, 1, datatype<T>(), all.data(), 1, datatype<T>(), comm);
    return all;
}

// Offset of each part, and after the last one the end.
std::vector<int> startsOf(const std::vector<int>& lengths) {
    std::vector<int> starts(lengths.size() + 1, 0);
    std::size_t total = 0;
    for (std::size_t r = 0; r < lengths.size(); ++r)
        total += static_cast<std::size_t>(lengths[r]), starts[r + 1] = count(total);
    return starts;
}

template <class T>
std::vector<std::vector<T>> exchanged(const std::vector<std::vector<T>>& forRank, MPI_Comm comm) {
    std::vector<int> sent(forRank.size()), received(forRank.size());
    std::vector<T> out;
    for (std::size_t r = 0; r < forRank.size(); ++r) {
        sent[r] = count(forRank[r].size());
        out.insert(out.end(), forRank[r].begin(), forRank[r].end());
    }
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm);
    const std::vector<int> from = startsOf(sent), to = startsOf(received);
    std::vector<T> in(static_cast<std::size_t>(to.back()));
    MPI_Alltoallv(out.data(), sent.data(), from.data(), datatype<T>(), in.data(), received.data(), to.data(),
                  datatype<T>(), comm);
    std::vector<std::vector<T>> parts;
    parts.reserve(received.size());
    for (std::size_t r = 0; r < received.size(); ++r) parts.emplace_back(in.begin() + to[r], in.begin() + to[r + 1]);
    return parts;
}

}  // namespace

Communicator::Communicator(MPI_Comm handle) : handle_(handle) {
    MPI_Comm_rank(handle_, &rank_);
    MPI_Comm_size(handle_, &size_);
}

void Communicator::barrier() const { MPI_Barrier(handle_); }

double Communicator::sum(double value) const { return reduced(value, MPI_SUM, handle_); }
double Communicator::min(double value) const { return reduced(value, MPI_MIN, handle_); }
double Communicator::max(double value) const { return reduced(value, MPI_MAX, handle_); }
long Communicator::sum(long value) const { return reduced(value, MPI_SUM, handle_); }
long Communicator::min(long value) const { return reduced(value, MPI_MIN, handle_); }
long Communicator::max(long value) const { return reduced(value, MPI_MAX, handle_); }
std::vector<double> Communicator::sum(std::vector<double> values) const {
    return reduced(std::move(values), MPI_SUM, handle_);
}
std::vector<double> Communicator::min(std::vector<double> values) const {
    return reduced(std::move(values), MPI_MIN, handle_);
}
std::vector<double> Communicator::max(std::vector<double> values) const {
    return reduced(std::move(values), MPI_MAX, handle_);
}
std::vector<long> Communicator::sum(std::vector<long> values) const {
    return reduced(std::move(values), MPI_SUM, handle_);
}

void Communicator::addUp(std::span<double> values) const {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), MPI_DOUBLE, MPI_SUM, handle_);
}
void Communicator::takeLargest(std::span<double> values) const {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), count(values.size()), MPI_DOUBLE, MPI_MAX, handle_);
}
bool Communicator::allTrue(bool value) const { return min(value ? 1L : 0L) == 1; }
bool Communicator::anyTrue(bool value) const { return max(value ? 1L : 0L) == 1; }

double Communicator::broadcast(double value) const {
    MPI_Bcast(&value, 1, MPI_DOUBLE, 0, handle_);
    return value;
}

long Communicator::broadcast(long value) const {
    MPI_Bcast(&value, 1, MPI_LONG, 0, handle_);
    return value;
}

std::string Communicator::broadcast(std::string text) const {
    text.resize(static_cast<std::size_t>(broadcast(static_cast<long>(text.size()))));
    MPI_Bcast(text.data(), count(text.size()), MPI_CHAR, 0, handle_);
    return text;
}

std::vector<long> Communicator::gatherAll(long value) const { return gatheredAll(value, handle_, size_); }
std::vector<double> Communicator::gatherAll(double value) const { return gatheredAll(value, handle_, size_); }

std::vector<std::string> Communicator::gather(const std::string& text) const {
    const std::vector<long> lengths = gatherAll(static_cast<long>(text.size()));
    std::vector<int> counts;
    counts.reserve(lengths.size());
    for (const long length : lengths) counts.push_back(count(static_cast<std::size_t>(length)));
    const std::vector<int> starts = startsOf(counts);
    std::string all(isRoot() ? static_cast<std::size_t>(starts.back()) : 0, ' ');
    MPI_Gatherv(text.data(), count(text.size()), MPI_CHAR, all.data(), counts.data(), starts.data(), MPI_CHAR, 0,
                handle_);
    std::vector<std::string> texts;
    if (isRoot())
        for (std::size_t r = 0; r < lengths.size(); ++r)
            texts.push_back(all.substr(static_cast<std::size_t>(starts[r]), static_cast<std::size_t>(lengths[r])));
    return texts;
}

std::vector<std::vector<double>> Communicator::exchange(const std::vector<std::vector<double>>& forRank) const {
    return exchanged(forRank, handle_);
}
std::vector<std::vector<int>> Communicator::exchange(const std::vector<std::vector<int>>& forRank) const {
    return exchanged(forRank, handle_);
}

}  // namespace corpuscle
