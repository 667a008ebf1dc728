#include "core/together.hpp"

namespace corpuscle {

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
