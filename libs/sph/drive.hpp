// Family of drives: how what drives a flow changes with time t. A drive is a factor f(t), by which a flow multiplies
// its body force, its pressure drop, its flow rate, or the velocities of its walls. Time counts from the start of the
// run, restarts included.
#pragma once
#include <filesystem>
#include <limits>

#include "core/registry.hpp"

namespace corpuscle::sph {

class Drive {
  public:
    static constexpr const char* familyName = "drive";
    virtual ~Drive() = default;

    // Reads what the drive needs; paths are relative to the case. Throws Failure.
    virtual void prepare(const std::filesystem::path& /*caseDirectory*/) const {}

    virtual double factor(double t) const = 0;  // f
    virtual double largest() const = 0;         // largest |f| at any time
    // The shortest time in which f changes by `largest`, at its fastest: 1/omega for a sine [s].
    virtual double changesIn() const { return std::numeric_limits<double>::infinity(); }
    bool isSteady() const { return changesIn() == std::numeric_limits<double>::infinity(); }
};

}  // namespace corpuscle::sph
