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
    // Shared file pointers, which HDF5 does not use: one of these components would keep them in that folder, and both
    // put the path of the file into 256 characters without looking, which ends the program where a case lies deep (Open
    // MPI 4.1.4). What the user has set stays.
    setenv("OMPI_MCA_sharedfp", "^sm,lockedfile", 0);
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    return true;
}

void leaveMpiOpen() { staysOpen = true; }
bool mpiStaysOpen() { return staysOpen; }

}  // namespace corpuscle
