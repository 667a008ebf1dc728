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
    std::vector<int> counts, starts;
    std::size_t total = 0;
    for (long length : lengths) {
        counts.push_back(count(static_cast<std::size_t>(length)));
        starts.push_back(count(total));
        total += static_cast<std::size_t>(length);
    }
    std::string all(isRoot() ? total : 0, ' ');
    MPI_Gatherv(text.data(), count(text.size()), MPI_CHAR, all.data(), counts.data(), starts.data(), MPI_CHAR, 0,
                handle_);
    std::vector<std::string> texts;
    if (isRoot())
        for (std::size_t r = 0; r < lengths.size(); ++r)
            texts.push_back(all.substr(static_cast<std::size_t>(starts[r]), static_cast<std::size_t>(lengths[r])));
    return texts;
}

}  // namespace corpuscle
