// Progress of a study on the terminal: a table of all cases that is redrawn in place or, if the output is not a
// terminal, one line with date and time for each event. With -json these lines go to standard error.
#pragma once
#include <string>
#include <vector>

#include "core/log.hpp"
#include "study/sweep.hpp"

namespace corpuscle {

class LiveTable {
  public:
    enum class Output { text, json, quiet };
    LiveTable(Log& log, Output output);
    // Shows the state of all cases, at most twice a second while nothing has changed.
    void show(const std::vector<study::CaseStatus>& cases, bool changed);
    // Shows the final state.
    void finish(const std::vector<study::CaseStatus>& cases);

  private:
    void draw(const std::vector<study::CaseStatus>& cases);
    void tell(const std::vector<study::CaseStatus>& cases);

    Log& log_;
    Output output_;
    bool isTerminal_;
    std::size_t drawnLines_ = 0;
    std::chrono::steady_clock::time_point drawn_;
    std::vector<std::string> told_;  // for each case, the state that was last reported
};

}  // namespace corpuscle
