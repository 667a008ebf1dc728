// What each rank of a program sends, by MPI's profiling interface: a library to be put in front by LD_PRELOAD. At
// MPI_Finalize rank 0 writes the greatest of all ranks to the file that the environment variable MESSAGE_COUNTS names,
// a number and its name a line. Bytes of reductions are those of their operand, those of other collectives what the
// rank gives.
#include <mpi.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace {

enum Count { messages, messageBytes, reductions, reducedBytes, largestReduction, collectives, collectiveBytes, memory };
constexpr const char* names[]{"messages",         "messageBytes", "reductions",      "reducedBytes",
                              "largestReduction", "collectives",  "collectiveBytes", "memory_kB"};
long counts[std::size(names)];

long bytesOf(MPI_Datatype type, long count) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return size * count;
}
int ranksOf(MPI_Comm comm) {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    return size;
}
void addMessage(long bytes) { ++counts[messages], counts[messageBytes] += bytes; }
void addCollective(long bytes) { ++counts[collectives], counts[collectiveBytes] += bytes; }

}  // namespace

extern "C" {

int MPI_Allreduce(const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
    const long bytes = bytesOf(type, n);
    ++counts[reductions], counts[reducedBytes] += bytes;
    counts[largestReduction] = std::max(counts[largestReduction], bytes);
    return PMPI_Allreduce(in, out, n, type, op, comm);
}
int MPI_Isend(const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
    addMessage(bytesOf(type, n));
    return PMPI_Isend(data, n, type, to, tag, comm, request);
}
int MPI_Send(const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
    addMessage(bytesOf(type, n));
    return PMPI_Send(data, n, type, to, tag, comm);
}
int MPI_Alltoall(const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm) {
    addCollective(bytesOf(type, n) * ranksOf(comm));
    return PMPI_Alltoall(in, n, type, out, m, other, comm);
}
int MPI_Alltoallv(const void* in, const int* n, const int* first, MPI_Datatype type, void* out, const int* m,
                  const int* firstOut, MPI_Datatype other, MPI_Comm comm) {
    long bytes = 0;
    for (int r = 0; r < ranksOf(comm); ++r) bytes += bytesOf(type, n[r]);
    addCollective(bytes);
    return PMPI_Alltoallv(in, n, first, type, out, m, firstOut, other, comm);
}
int MPI_Allgather(const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm) {
    addCollective(bytesOf(type, n));
    return PMPI_Allgather(in, n, type, out, m, other, comm);
}
int MPI_Bcast(void* data, int n, MPI_Datatype type, int root, MPI_Comm comm) {
    addCollective(bytesOf(type, n));
    return PMPI_Bcast(data, n, type, root, comm);
}
int MPI_Finalize() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    counts[memory] = usage.ru_maxrss;
    long most[std::size(names)];
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    PMPI_Reduce(counts, most, static_cast<int>(std::size(names)), MPI_LONG, MPI_MAX, 0, MPI_COMM_WORLD);
    const char* const path = std::getenv("MESSAGE_COUNTS");
    if (std::FILE* const file = rank == 0 && path ? std::fopen(path, "w") : nullptr) {
        for (std::size_t k = 0; k < std::size(names); ++k) std::fprintf(file, "%ld %s\n", most[k], names[k]);
        std::fclose(file);
    }
    return PMPI_Finalize();
}

}  // extern "C"
