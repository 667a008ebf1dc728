// Collective failure: an error on one rank must be thrown on all of them, or the others would wait forever.
#pragma once
#include <mpi.h>

#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace corpuscle {

// What std::bad_alloc and errors of std::filesystem mean, as a Failure with a text for users.
Failure memoryFailure();
Failure fileFailure(const std::filesystem::filesystem_error& error);
// Text of any error; that of the Failures above for these two kinds.
std::string wordsFor(const std::exception& error);

// Collective. Returns the lowest rank that has failed, -1: none. `text` then becomes that rank's text on all ranks.
int firstFailed(MPI_Comm comm, bool failed, std::string& text);

// Collective. If `failed` anywhere, every rank throws Failure(code) with the lowest failing rank's text.
void throwTogether(MPI_Comm comm, bool failed, const std::string& text, ExitCode code = ExitCode::io);

// Collective. Runs work() on every rank; if it throws anywhere, every rank throws.
template <class Work>
void together(MPI_Comm comm, Work&& work) {
    bool failed = false;
    std::string text;
    try {
        std::forward<Work>(work)();
    } catch (const std::exception& error) {
        failed = true;
        text = wordsFor(error);
    }
    throwTogether(comm, failed, text);
}

// Collective. Runs work() on rank 0; if it throws there, every rank throws.
template <class Work>
void onRoot(MPI_Comm comm, Work&& work) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    together(comm, [&] {
        if (rank == 0) work();
    });
}

}  // namespace corpuscle
