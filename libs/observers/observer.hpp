// Family of observers: what is measured while a case runs, from system/observers.yaml.
//
//     deformation: {type: shape, every: 0.02 strain}
//
// An Observer is what the case says: settings, const and shared, and the tables it writes, each column with unit and
// meaning. begin() gives an Observation, the running part: rows, and whatever it has to remember between two looks. An
// Observation never changes the scene, knows no file and no interval (observers.hpp has both), and its rows are the
// same on every rank.
//
// Adding an observer is adding one .cpp with a struct of the settings (schema() includes ObserverSettings), its
// Observation and CORPUSCLE_REGISTER; wallStress.cpp is the pattern.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "core/time.hpp"
#include "coupling/scene.hpp"
#include "io/csvSeries.hpp"

namespace corpuscle::observers {

using coupling::Scene;

// One file. Its first two columns, time_s and strain, are not listed.
struct Table {
    std::string file;  // without .csv
    std::vector<io::Column> columns;
};

// The first two columns of every table.
const std::vector<io::Column>& timeColumns();

// name_x, name_y, name_z, "x <meaning>" and so on; meaning: "component of the velocity".
void addVector(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
               const std::string& meaning);

// Of a scene, what decides which tables and columns there are.
struct SceneParts {
    std::vector<std::string> cells, bodies, walls;  // names of the types of cells, and of the others
    bool shear = false, bodyForce = false, givenBodies = false, viscousMembranes = false, rupture = false,
         budget = false, slidingImages = false;
    static SceneParts of(const Scene& scene);
    // Everything, with types of cells, bodies and walls "<cell>", "<body>" and "<wall>": for the documentation.
    static SceneParts all();
};

struct Row {
    std::size_t table;
    std::vector<double> values;  // one for each column of the table, SI
};

struct Summary;  // summary.hpp

class Observation {
  public:
    explicit Observation(std::vector<Table> tables) : tables_(std::move(tables)) {}
    virtual ~Observation() = default;
    const std::vector<Table>& tables() const { return tables_; }

    // What is to be seen now. Collective.
    virtual std::vector<Row> observe(const Scene& scene, const Time& time) = 0;

    // After every step, only where watchesSteps(): for what happens between two looks. Collective.
    virtual bool watchesSteps() const { return false; }
    virtual std::vector<Row> afterStep(const Scene&, const Time&) { return {}; }

    // Whether its rows may have NaN where there is nothing to be seen: a bin without particles, the section of an open
    // cell.
    virtual bool leavesGaps() const { return false; }

    // At the end of a run; empty: nothing to say. Collective.
    virtual std::optional<Summary> summary(const Scene& scene, const Time& time);

    // What a restart needs to go on without a seam; the same on all ranks. restore() throws Failure(ExitCode::io) for a
    // state of another length.
    virtual std::vector<double> state() const { return {}; }
    void restore(std::span<const double> state);

  protected:
    virtual void setState(std::span<const double>) {}

  private:
    std::vector<Table> tables_;
};

// What a case has to look at, known before it runs.
struct Subject {
    bool cells = false, planeWalls = false;
    double shearRate = 0;  // gammadot [1/s]; 0: the flow has none
    bool bodies = false;   // rigid ones
};

struct ObserverSettings {
    Interval every;
    static const Schema<ObserverSettings>& schema();
};

class Observer : public ObserverSettings {
  public:
    static constexpr const char* familyName = "observer";
    virtual ~Observer() = default;
    // Why this subject cannot be observed so, and what to do, in plain words; empty: it can.
    virtual std::string whyNot(const Subject&) const { return {}; }
    // Whether the scene is to keep its budget of energy and momentum (sph/budget.hpp).
    virtual bool wantsBudget(bool /*slidingImages*/) const { return false; }
    // What it writes of a scene with these parts.
    virtual std::vector<Table> tables(const SceneParts& parts) const = 0;
    virtual std::unique_ptr<Observation> begin(const Scene& scene) const = 0;

  protected:
    // whyNot() of an observer of cells, empty when there are some.
    static std::string needsCells(const Subject& subject);
};

}  // namespace corpuscle::observers
