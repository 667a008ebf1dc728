// MPI_Init, once. A process that no launcher has started runs alone: Open MPI then starts no daemon and makes no session folder, for which
// processes that begin at the same moment, as those of a parameter study do, would contend and fail. Parts of MPI-IO that fail with long paths are
// left out.
#pragma once

namespace corpuscle {

// Whether MPI was started here, and is to be finalised by the caller.
bool startMpi(int& argc, char**& argv);

}  // namespace corpuscle
