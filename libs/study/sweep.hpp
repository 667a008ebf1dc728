// Runs the cases of a study, several at a time, and continues where an earlier run of the study was stopped or killed.
//
// A case is made under a hidden name and renamed once it is complete. In each case the programs run one after the
// other, with their output in log.caseSweep; a program that has ended with 0 does not run again. A lock on the hidden
// file .NAME.lock beside a case lasts as long as one of its programs runs, so that several runs of one study, on one
// machine or on several, share its cases between them.
//
//     new -> waiting -> running -> done
//                               -> failed      a program ended with another code than 0 and 5: the others go on
//                               -> stopped     on request; waiting again when the study is run again
#pragma once
#include <chrono>
#include <functional>
#include <memory>

#include "study/caseRecord.hpp"
#include "study/process.hpp"

namespace corpuscle::study {

// What is done with a case that differs from the one that the study would now make from the template.
enum class Differing {
    refuse,  // an error names the case and the entries; nothing is run
    keep,    // it stays as it is
    update,  // changes of system/control.yaml and system/observers.yaml are written into it, and its solver continues
    fresh,   // it is removed and made anew; so is a case that failed
};

struct SweepOptions {
    std::filesystem::path base;  // folder of study.yaml
    std::string studyFile;       // its name, for records
    std::filesystem::path templateCase, cases;
    std::filesystem::path programFolder;  // searched for programs before PATH
    long jobs = 1, ranks = 1;
    Differing differing = Differing::refuse;
    bool retry = false;     // run cases again that have failed
    bool readOnly = false;  // cases are only inspected: nothing is written, and nothing is run
};

enum class CaseState { waiting, running, elsewhere, done, failed, stopped };
const char* nameOf(CaseState state);

// A case and its progress.
struct CaseStatus {
    StudyCase what;
    CaseState state = CaseState::waiting;
    bool retries = false;              // a recorded failure is ignored once
    Differing plan = Differing::keep;  // update or fresh: what is done with it before its programs run
    CaseRecord record = {};
    std::string program = {};   // the program that runs, ran last or comes next
    std::string progress = {};  // "34.1 %", where the program reports it
    double seconds = 0;         // of run time so far
};

class Sweep {
  public:
    // Reads the cases that exist. Throws Failure where cases differ (Differing::refuse), which names all of them.
    Sweep(SweepOptions options, std::vector<StudyCase> cases, Environment environment);
    ~Sweep();
    Sweep(const Sweep&) = delete;
    Sweep& operator=(const Sweep&) = delete;

    const std::vector<CaseStatus>& cases() const { return cases_; }
    std::filesystem::path folder(const StudyCase& one) const { return options_.cases / one.name; }

    // Notices which programs have ended and starts as many cases as `jobs` allows; returns whether something has
    // changed. Call it several times a second until isEnded().
    bool advance();
    bool isEnded() const;
    // Asks the running programs to stop, and starts no others.
    void stop();
    bool isStopping() const { return isStopping_; }

  private:
    struct Run;

    struct Changes {
        std::vector<std::string> texts;  // "FILE:/path is ... and would be ..."
        bool areOfTheRun = true;         // of system/control.yaml and system/observers.yaml alone: the solver can go on
    };
    void inspect(CaseStatus& one, std::vector<std::string>& different);
    void takeState(CaseStatus& one) const;
    Changes changesOf(const StudyCase& one, const CaseRecord& record) const;
    std::string wantedText(const StudyCase& one, const std::string& file) const;
    void make(CaseStatus& one) const;
    void update(CaseStatus& one) const;
    bool begin(std::size_t k);
    void startNext(std::size_t k);
    void settle(std::size_t k, int code);
    void note(std::size_t k, int code);
    bool isToBeFresh(const CaseStatus& one) const;
    void fail(CaseStatus& one, const std::string& reason) const;
    std::vector<std::string> wordsFor(const std::string& program) const;

    SweepOptions options_;
    std::vector<CaseStatus> cases_;
    std::vector<std::unique_ptr<Run>> runs_;  // one for each case; null unless it runs
    Environment environment_;
    std::map<std::string, std::string> files_;  // checksums of the template's files other than dictionaries
    std::string inTemplate_;                    // the folder of the cases, if it lies in the template
    bool isStopping_ = false;
    std::chrono::steady_clock::time_point looked_;
};

}  // namespace corpuscle::study
