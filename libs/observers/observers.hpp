// The observers of a run: system/observers.yaml, a table with free names as keys, each with a model of the family
// observer.
//
//     deformation: {type: shape, every: 0.02 strain}
//     balance: {type: conservation, every: 0.1 strain}
//
// Each observer writes postProcessing/<name>/<file>.csv (io/csvSeries.hpp), with the first columns time_s and strain.
// Files are opened at the first run(): a run from t = 0 writes them anew, removes tables that earlier runs have left,
// and begins with a row at t = 0. A restart continues the same files; its first row is that of the next due time, so
// that no row is repeated. Rows are exactly at the multiples of an interval, unless it is shorter than a step.
// Observers may be added, removed or changed between a run and its restart.
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
    // settings were read.
    void check(const Node& dictionary, const Subject& subject, Problems& problems) const;
    bool wantBudget(bool slidingImages) const;  // whether any observer wants the budget
};

class Observers {
  public:
    Observers() = default;
    // The settings must suit the scene (check). Throws CaseError when two files of one observer would have the same
    // name.
    Observers(const ObserversSettings& settings, const Scene& scene, const Time& start, std::filesystem::path caseDir);

    bool empty() const { return running_.empty(); }

    // Runs the observers that are due and writes their rows. Collective.
    void run(const Scene& scene, const Time& time);

    // Notes for the user on the tables that earlier runs have left; on rank 0, after the first run().
    const std::vector<std::string>& notes() const { return notes_; }
    // Adds the next times of the observers whose interval is not shorter than a step. The others run after the first
    // step past each of their times.
    void addEvents(const Time& time, std::vector<Event>& events) const;

    // Summaries of the observers that have one, by name. Collective.
    std::vector<std::pair<std::string, Summary>> summaries(const Scene& scene, const Time& time);

    // The states of observers that keep one, for a restart; the same on all ranks. Observers that are not in the state
    // start anew; entries of other observers are ignored.
    std::vector<double> state() const;
    void restore(const std::vector<double>& state);

    // For a rollback to a state of this run that is kept in memory: goBack() removes rows after `time` from the files,
    // and the same times are then observed again.
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
    std::optional<double> restart_;  // the time at the start of a restart [s]; none: from t = 0
    bool filesOpen_ = false;
    std::vector<std::string> notes_;
};

}  // namespace corpuscle::observers
