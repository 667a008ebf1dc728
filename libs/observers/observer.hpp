// Family of observers: what is measured while a case runs, from system/observers.yaml.
//
//     deformation: {type: shape, every: 0.02 strain}
//
// An Observer holds what the case gives: its settings, constant and shared, and the tables that it writes, each column
// with unit and meaning. begin() gives an Observation, the running part: it returns rows, and keeps what must be
// remembered from one output to the next. An Observation never changes the scene, knows neither files nor intervals
// (observers.hpp has both), and its rows are the same on every rank.
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

// One file. Its first two columns, time_s and strain, are not in `columns`.
struct Table {
    std::string file;  // without .csv
    std::vector<io::Column> columns;
};

// The first two columns of every table.
const std::vector<io::Column>& timeColumns();

// Adds the columns name_x, name_y, name_z, with the meanings "x <meaning>" and so on; meaning: "component of the
// velocity".
void addVector(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
               const std::string& meaning);

// The properties of a scene that decide which tables and columns there are.
struct SceneParts {
    std::vector<std::string> cells, bodies, walls;  // names of types of cells, of bodies and of walls
    bool shear = false, bodyForce = false, givenBodies = false, viscousMembranes = false, rupture = false,
         budget = false, slidingImages = false, conductance = false;
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

    // Rows for the present state. Collective.
    virtual std::vector<Row> observe(const Scene& scene, const Time& time) = 0;

    // Called after every step, if watchesSteps(): for what happens between two outputs. Collective.
    virtual bool watchesSteps() const { return false; }
    virtual std::vector<Row> afterStep(const Scene&, const Time&) { return {}; }

    // Whether its rows may have NaN where there is nothing to measure: a bin without particles, the section of an open
    // cell.
    virtual bool leavesGaps() const { return false; }

    // The summary at the end of a run; empty: none. Collective.
    virtual std::optional<Summary> summary(const Scene& scene, const Time& time);

    // What a restart needs to continue like an uninterrupted run; the same on all ranks. restore() throws
    // Failure(ExitCode::io) for a state of another length.
    virtual std::vector<double> state() const { return {}; }
    void restore(std::span<const double> state);

  protected:
    virtual void setState(std::span<const double>) {}

  private:
    std::vector<Table> tables_;
};

// What a case has that observers can measure, known before it runs.
struct Subject {
    bool cells = false, planeWalls = false;
    double shearRate = 0;  // gammadot [1/s]; 0: the flow has none
    bool bodies = false;   // rigid bodies
    bool solute = false;   // carried by the fluid
    bool channel = false;  // a flow along x between walls at rest
};

struct ObserverSettings {
    Interval every;
    static const Schema<ObserverSettings>& schema();
};

class Observer : public ObserverSettings {
  public:
    static constexpr const char* familyName = "observer";
    virtual ~Observer() = default;
    // Why this observer cannot be used for the subject, and what to do, in plain words; empty: it can.
    virtual std::string whyNot(const Subject&) const { return {}; }
    // Whether the scene is to keep its budget of energy and momentum (sph/budget.hpp).
    virtual bool wantsBudget(bool /*slidingImages*/) const { return false; }
    // The tables that it writes for a scene with these parts.
    virtual std::vector<Table> tables(const SceneParts& parts) const = 0;
    virtual std::unique_ptr<Observation> begin(const Scene& scene) const = 0;

  protected:
    // whyNot() of an observer of cells, empty when there are some.
    static std::string needsCells(const Subject& subject);
};

}  // namespace corpuscle::observers
