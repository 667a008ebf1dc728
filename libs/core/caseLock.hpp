// Lock of a case: only one program at a time writes in it. The program holds the file `case.lock` in the case, which
// identifies the program, and removes it when it ends.
//
// The program keeps an exclusive lock of the operating system (flock) on the file. The system releases this lock when
// the process ends, however it ends, so that on one machine the lock decides: a file that no process has locked is
// stale, left by a process that was killed or by a machine that was switched off. It is taken over with a line in the
// log. Where the file system does not support such locks, the process number decides. A file written on another host is
// taken as valid, since nothing can be known of its process: the message says how to check, and what to remove. A file
// that was copied along with its case (its inode is not the one noted in it) is stale too.
#pragma once
#include <filesystem>
#include <string>

#include "core/communicator.hpp"
#include "core/log.hpp"

namespace corpuscle {

class CaseLock {
  public:
    static constexpr const char* fileName = "case.lock";

    // Collective; the root does the work. Throws Failure(ExitCode::io) on all ranks when another program is running in
    // the case, naming it, its host, its process and since when, and when the file cannot be written.
    CaseLock(const std::filesystem::path& caseDir, const std::string& program, const Communicator& communicator,
             Log& log);
    ~CaseLock();
    CaseLock(const CaseLock&) = delete;
    CaseLock& operator=(const CaseLock&) = delete;

    // For a rank that is about to end all the others (MPI_Abort): removes the file. Not collective.
    void abandon() const;

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;  // open on the root only
};

}  // namespace corpuscle
