#include "simulation/retreat.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "core/communicator.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/resultsWriter.hpp"

namespace corpuscle::simulation {

using coupling::Cell;
using coupling::Scene;

namespace {
constexpr long implicitInterval = 5, explicitInterval = 50;  // steps between two states kept
constexpr long explicitLook = 10;                            // steps between two looks at the state
constexpr long goodStepsToRelax = 10;                        // past a fault
constexpr double surroundings = 5;                           // supports
constexpr auto patience = std::chrono::seconds(10);          // for ranks on their way with the same failure
}  // namespace

Retreat::Retreat(const Case& input, Scene& scene, Time& time, Integrator& integrator, Schedule& schedule, Log& log)
    : input_(input),
      scene_(scene),
      time_(time),
      integrator_(integrator),
      schedule_(schedule),
      log_(log),
      watch_(input, scene),
      meeting_(MPI_COMM_NULL) {
    MPI_Comm_dup(scene.system->comm(), &meeting_);
    schedule_.record().set("performance", "retreats", count_);
}

Retreat::~Retreat() { MPI_Comm_free(&meeting_); }

// Half, a quarter ... of the step that failed first.
double Retreat::longest() const {
    return inRow_ > 0 ? std::ldexp(failed_, -static_cast<int>(inRow_)) : std::numeric_limits<double>::infinity();
}

bool Retreat::advance() {
    const long interval = input_.numerics.isImplicit() ? implicitInterval : explicitInterval;
    if (input_.numerics.retreats > 0 && (good_[0].step < 0 || time_.step >= good_[0].step + interval)) remember();
    const Fault fault = step();
    if (fault) {
        report(fault);
        return false;
    }
    if (inRow_ > 0 && time_.t > faultTime_ && ++goodSteps_ >= goodStepsToRelax) {
        --inRow_, goodSteps_ = 0;
        integrator_.shorten(longest(), inRow_ > 1);
    }
    return true;
}

// What is wrong after one; nothing where all is well.
Fault Retreat::step() {
    tried_ = time_.dt;
    try {
        integrator_.advance(scene_, time_);
    } catch (const Failure& failure) {
        if (failure.code() != ExitCode::numerics || !allFailed()) throw;
        return {failure.what(), Watch::suspect(scene_)};
    }
    if (!input_.numerics.isImplicit() && time_.step % explicitLook != 0) return {};
    return watch_.find(scene_, time_);
}

// A rank that failed alone leaves the others waiting within the step: then there is no way back, and the failure goes on to end the run.
bool Retreat::allFailed() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(meeting_, &request);
    const auto start = std::chrono::steady_clock::now();
    for (int met = 0; std::chrono::steady_clock::now() - start < patience;) {
        MPI_Test(&request, &met, MPI_STATUS_IGNORE);
        if (met) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

void Retreat::remember() {
    std::swap(good_[0], good_[1]);
    Good& good = good_[0];
    simulation::remember(good.state, input_, scene_, time_, {.integrator = integrator_.state(time_), .observers = {}});
    good.schedule = schedule_.remember();
    good.t = time_.t, good.step = time_.step;
}

void Retreat::goBack(Good& good) {
    const RunState state = recall(good.state, input_, scene_, time_);
    integrator_.goBack(state.integrator, time_);
    restoreCoupling(state, scene_);
    integrator_.shorten(longest(), inRow_ > 1);
    time_.dt = std::min(time_.dt, longest());
    schedule_.goBack(good.schedule, scene_, time_);
    watch_.take(scene_);
    goodSteps_ = 0;
}

void Retreat::report(const Fault& fault) {
    faultTime_ = inRow_ > 0 ? std::max(faultTime_, time_.t) : time_.t;
    if (inRow_ == 0) failed_ = tried_;
    const long most = input_.numerics.retreats;
    if (inRow_ < most && !fault.isGeometric) {
        ++inRow_, ++count_;
        schedule_.record().set("performance", "retreats", count_);
        if (inRow_ > 2 && good_[1].step >= 0) std::swap(good_[0], good_[1]), good_[1].step = -1;
        log_.warning("{}. Back to step {}, t = {:.6g} s, and on with 1/{} of the step{}", fault.text, good_[0].step,
                     good_[0].t, 1L << inRow_, inRow_ > 1 && integrator_.implicitStep() ? ", by backward Euler" : "");
        goBack(good_[0]);
        return;
    }
    writeSurroundings(fault);
    std::string where = "; its surroundings are in results/fault.pvd";
    if (most > 0) {
        goBack(good_[0]);
        schedule_.saveCheckpoint(scene_, time_);
        where += fmt::format(", and a checkpoint of the last good state, t = {:.6g} s, is written", time_.t);
        where += fault.isGeometric
                     ? ". A shorter step would not help"
                     : fmt::format(". {} retreats with steps down to 1/{} did not help", most, 1L << most);
    }
    schedule_.record().set("fault", "text", fault.text);
    schedule_.record().set("fault", "time_s", faultTime_);
    schedule_.record().set("fault", "place_m", std::vector<double>(fault.place.data(), fault.place.data() + 3));
    if (fault.isGeometric)
        throw Failure(ExitCode::numerics, fault.text + where + ": place cells further apart, or end the run earlier");
    throw Failure(ExitCode::numerics,
                  fault.text + where +
                      fmt::format(": take a smaller '{}' in system/numerics.yaml, or a finer mesh or spacing",
                                  input_.numerics.isImplicit() ? "implicit.step" : "safety"));
}

void Retreat::writeSurroundings(const Fault& fault) {
    const MPI_Comm comm = scene_.system->comm();
    const auto& s = scene_.store();
    const double radius = surroundings * input_.support();
    io::PolyData near;
    auto &id = near.point.integers["id"], &kind = near.point.integers["kind"];
    auto& velocity = near.point.vectors["velocity"];
    auto& density = near.point.scalars["density"];
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec3 x = s.position(i);
        if (!(scene_.system->box().minimumImage(x - fault.place).norm() <= radius)) continue;
        near.points.push_back(x);
        id.push_back(s.id[i]), kind.push_back(s.kind[i]);
        velocity.push_back(s.velocity(i)), density.push_back(s.density[i]);
    }
    io::VtkSeries(comm, input_.directory, "fault", 0, 0).write(time_.t, time_.strain(), near);
    for (const Cell& cell : scene_.cells) {
        const bool writer = lowestHolder(scene_, cell) == Communicator(comm).rank();
        io::VtkSeries(comm, input_.directory, "fault_" + cell.membrane.name, 0, 0)
            .write(time_.t, time_.strain(), cellPiece(scene_, cell, writer));
    }
}

}  // namespace corpuscle::simulation
