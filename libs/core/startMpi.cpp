#include "core/startMpi.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace corpuscle {

namespace {

bool staysOpen = false;

bool isLaunched() {
    constexpr const char* signs[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMI_RANK", "SLURM_STEP_ID"};
    return std::any_of(std::begin(signs), std::end(signs), [](const char* name) { return std::getenv(name); });
}

}  // namespace

bool startMpi(int& argc, char**& argv) {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised) return false;
    if (!isLaunched()) {
        setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
        setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    }
    // Disables two components for shared file pointers, which HDF5 does not use: one of them would keep these pointers
    // in the session folder, and both copy the path of the file into 256 characters without a check, which crashes the
    // program for a case deep in the directory tree (Open MPI 4.1.4). A value set by the user is kept.
    setenv("OMPI_MCA_sharedfp", "^sm,lockedfile", 0);
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    return true;
}

void leaveMpiOpen() { staysOpen = true; }
bool mpiStaysOpen() { return staysOpen; }

}  // namespace corpuscle
