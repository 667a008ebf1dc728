#include "core/wallClock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iterator>

namespace corpuscle {
namespace {

volatile std::sig_atomic_t caught = 0;

constexpr int handled[] = {SIGTERM, SIGINT, SIGUSR1};
using Handler = void (*)(int);
// The previous handlers, which a second signal calls: that of caseLock.cpp, or the default, which ends the program.
Handler before[std::size(handled)] = {};

void giveBack(int number) {
    for (std::size_t k = 0; k < std::size(handled); ++k)
        if (handled[k] == number) std::signal(number, before[k]);
}

void onSignal(int number) {
    caught = number;
    giveBack(number);
}

const char* nameOf(long number) { return number == SIGTERM ? "SIGTERM" : number == SIGINT ? "SIGINT" : "SIGUSR1"; }

double since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

StopControl::StopControl(Settings settings, const Communicator& communicator)
    : settings_(std::move(settings)), communicator_(communicator), start_(Clock::now()) {
    caught = 0;
    for (std::size_t k = 0; k < std::size(handled); ++k) {
        const Handler was = std::signal(handled[k], onSignal);
        if (was != onSignal) before[k] = was == SIG_ERR ? SIG_DFL : was;
    }
}

StopControl::~StopControl() {
    for (int number : handled) giveBack(number);
}

bool StopControl::requested(long step) {
    if (!reason_.empty()) return true;
    if (lastCheck_ && step < nextCheck_) return false;

    const bool root = communicator_.isRoot();
    const bool fileThere = root && !settings_.file.empty() && std::filesystem::exists(settings_.file);
    const auto agreed =
        communicator_.max({root ? since(start_) : 0.0, static_cast<double>(caught), fileThere ? 1.0 : 0.0});
    const double before = elapsed_;
    elapsed_ = agreed[0];
    if (agreed[1] > 0) {
        reason_ = fmt::format("signal {}", nameOf(std::lround(agreed[1])));
    } else if (agreed[2] > 0) {
        reason_ = fmt::format("the file '{}' appeared", settings_.file.filename().string());
        std::error_code ignored;
        if (root) std::filesystem::remove(settings_.file, ignored);
    } else if (settings_.wallClock && elapsed_ >= *settings_.wallClock) {
        reason_ = fmt::format("the wall-clock limit of {}", formatDuration(*settings_.wallClock));
    }

    // The gap may only double, so that a few fast steps at the start do not hide a stop request for long.
    long gap = 1;
    if (lastCheck_) {
        const long last = std::max(1L, step - *lastCheck_);
        const double perStep = std::max((elapsed_ - before) / static_cast<double>(last), 1e-9);
        gap = std::clamp(static_cast<long>(1.0 / perStep), 1L, 2 * last);
    }
    lastCheck_ = step;
    nextCheck_ = step + gap;
    return !reason_.empty();
}

bool WallTicker::due(const StopControl& clock) {
    if (!interval_ || clock.elapsed() < next_) return false;
    next_ = clock.elapsed() + *interval_;
    return true;
}

void WallTicker::change(std::optional<double> interval, const StopControl& clock) {
    if (interval == interval_) return;
    interval_ = interval;
    next_ = clock.elapsed() + interval.value_or(0);
}

Progress::Progress(Log& log, const Time& start, double every)
    : log_(log),
      every_(every),
      start_(Clock::now()),
      last_(start_),
      lastStep_(start.step),
      startFraction_(start.fraction()) {}

void Progress::report(const Time& time) {
    const double pause = since(last_);
    if (pause < every_) return;
    const double speed = static_cast<double>(time.step - lastStep_) / pause;
    const double done = time.fraction() - startFraction_;
    std::string line = fmt::format("step {}  t {}", time.step, formatQuantity(time.t, unit::second, 5));
    if (time.shearRate != 0) line += fmt::format("  strain {:.4g}", time.strain());
    line += fmt::format("  dt {}  {:.1f} %  {:.3g} steps/s", formatQuantity(time.dt, unit::second, 3),
                        100 * time.fraction(), speed);
    if (done > 0) line += "  left " + formatDuration(since(start_) * (1 - time.fraction()) / done);
    log_.info("{}", line);
    last_ = Clock::now();
    lastStep_ = time.step;
}

std::string formatDuration(double seconds) {
    if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
    if (!(seconds < 3600e9)) return fmt::format("{:.3g} h", seconds / 3600);  // more than an integer may hold
    const long s = std::lround(seconds);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

}  // namespace corpuscle
