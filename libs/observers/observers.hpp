// The observers of a run: system/observers.yaml, a table of free names, each with a model of the family observer.
//
//     deformation: {type: shape, every: 0.02 strain}
//     balance: {type: conservation, every: 0.1 strain}
//
// Each writes postProcessing/<name>/<file>.csv (io/csvSeries.hpp), first columns time_s and strain; files are opened at
// the first run(), where a run from t = 0 writes them anew, removes tables that earlier runs have left, and begins with
// a row at t = 0. A restart goes on in the same files; its first row is that of the next due time, so that each row is
// there once. Rows stand at the multiples of an interval exactly, unless it is shorter than a step. Observers may be
// added, removed or changed between a run and its restart.
//
//     Observers observers(settings, scene, time, caseDir);
//         // settings without models, or Observers(): none, at no cost
//     observers.restore(saved);                                // from a checkpoint
//     observers.run(scene, time);                              // before the first step and after each
#pragma once
#include <filesystem>
#include <map>
#include <optional>

#include "observers/observer.hpp"

namespace corpuscle::observers {

// system/observers.yaml
struct ObserversSettings {
    std::map<std::string, Choice<Observer>> models;
    static const Schema<ObserversSettings>& schema();
    // Adds a problem for each observer that does not suit the subject, at its place in `dictionary`, from which these
    // were read.
    void check(const Node& dictionary, const Subject& subject, Problems& problems) const;
    bool wantBudget(bool slidingImages) const;  // whether any does
};

class Observers {
  public:
    Observers() = default;
    // The settings suit the scene (check). Throws CaseError when two files of one observer would have the same name.
    Observers(const ObserversSettings& settings, const Scene& scene, const Time& start, std::filesystem::path caseDir);

    bool empty() const { return running_.empty(); }

    // Lets look those that are due. Collective.
    void run(const Scene& scene, const Time& time);

    // What the user is to know of the tables that earlier runs have left, on rank 0, after the first run().
    const std::vector<std::string>& notes() const { return notes_; }
    // When those look next whose interval is not shorter than a step. The others look after the first step past each of
    // their times.
    void addEvents(const Time& time, std::vector<Event>& events) const;

    // Of those that have something to say at the end, by name. Collective.
    std::vector<std::pair<std::string, Summary>> summaries(const Scene& scene, const Time& time);

    // What those that remember something need for a restart; the same on all ranks. Observers that the state does not
    // know begin anew, what it knows of others is passed over.
    std::vector<double> state() const;
    void restore(const std::vector<double>& state);

    // To look at the same times again, from a state of this run kept in memory: rows after `time` are taken out of the
    // files.
    struct Memory {
        std::vector<Ticker> tickers;
        std::vector<double> state;
    };
    Memory remember() const;
    void goBack(const Memory& memory, const Scene& scene, const Time& time);

  private:
    struct Running {
        std::string name, type;
        Choice<Observer> model;
        Ticker ticker;
        std::unique_ptr<Observation> observation;
        std::vector<io::CsvSeries> files;  // one for each table
        std::string key() const { return type + " " + name; }
    };
    void openFiles(const Scene& scene);
    static void write(Running& observer, const Time& time, const std::vector<Row>& rows);

    std::vector<Running> running_;
    std::filesystem::path caseDir_;
    std::optional<double> restart_;  // the time of the start; none: from t = 0
    bool filesOpen_ = false;
    std::vector<std::string> notes_;
};

}  // namespace corpuscle::observers
