// Calls MPI_Init once. A process that was not started by a launcher (mpirun, srun) runs alone: Open MPI then starts no
// daemon and creates no session folder, over which processes that start at the same moment, such as those of a
// parameter study, would conflict and fail. Components of MPI-IO that fail with long paths are disabled.
#pragma once

namespace corpuscle {

// True when MPI was started here; the caller must then finalise it.
bool startMpi(int& argc, char**& argv);

// To be called by a library that could not close a file and would crash within MPI_Finalize, where it tries again (HDF5
// 1.10). Application then ends the program without MPI_Finalize, once all ranks know of the error and everything else
// is in order.
void leaveMpiOpen();
bool mpiStaysOpen();

}  // namespace corpuscle
