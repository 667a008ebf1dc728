// One program at a time writes in a case. It holds the file `case.lock` there, which says who it is, and removes it
// when it ends.
//
// The program keeps an exclusive lock of the system (flock) on the file. The system lets go of it when the process
// ends, however it ends, so that on one machine it decides: a file that nobody holds is stale, left by a process that
// was killed or by a machine that was switched off, and is taken over with a line in the log. Where the file system has
// no such locks, the number of the process decides. A file of another host is believed, since nothing can be known of
// its process: the message says how to look, and what to remove. A file that was copied along with its case (another
// inode than it notes) means nothing.
#pragma once
#include <filesystem>
#include <string>

#include "core/communicator.hpp"
#include "core/log.hpp"

namespace corpuscle {

class CaseLock {
  public:
    static constexpr const char* fileName = "case.lock";

    // Collective; the root does the work. Throws Failure(ExitCode::io) on all ranks where another program is at work,
    // naming it, its host, its process and since when, and where the file cannot be written.
    CaseLock(const std::filesystem::path& caseDir, const std::string& program, const Communicator& communicator,
             Log& log);
    ~CaseLock();
    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

    // For a rank that is about to end all the others (MPI_Abort): removes the file. Not collective.
    void abandon() const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;  // of the root
};

}  // namespace corpuscle
