// MPI_Init, once. A process that no launcher has started runs alone: Open MPI then starts no daemon and makes no
// session folder, for which processes that begin at the same moment, as those of a parameter study do, would contend
// and fail. Parts of MPI-IO that fail with long paths are left out.
#pragma once

namespace corpuscle {

// Whether MPI was started here, and is to be finalised by the caller.
bool startMpi(int& argc, char**& argv);

// To be said by a library that could not close a file and would crash within MPI_Finalize, where it tries again (HDF5
// 1.10): Application then ends the program without that call, once all ranks know of the error and everything else is
// in order.
void leaveMpiOpen();
bool mpiStaysOpen();

}  // namespace corpuscle
