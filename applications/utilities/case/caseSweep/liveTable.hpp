// How far a study is, on the terminal: a table of all cases that is drawn anew in its place, or, where the output is no
// terminal, a line whenever something happens.
#pragma once
#include <string>
#include <vector>

#include "core/log.hpp"
#include "study/sweep.hpp"

namespace corpuscle {

class LiveTable {
  public:
    LiveTable(Log& log, bool quiet);
    // Shows the state of all cases; at most twice a second where nothing has changed.
    void show(const std::vector<study::CaseStatus>& cases, bool changed);
    // The last time.
    void finish(const std::vector<study::CaseStatus>& cases);

  private:
    void draw(const std::vector<study::CaseStatus>& cases);
    void tell(const std::vector<study::CaseStatus>& cases);

    Log& log_;
    bool isTerminal_;
    std::size_t drawnLines_ = 0;
    std::chrono::steady_clock::time_point drawn_;
    std::vector<std::string> told_;  // of each case, what was said of it last
};

}  // namespace corpuscle
