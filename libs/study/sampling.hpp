// Family of samplings: how the values of several parameters are combined into cases.
//
// A parameter has n levels, which are numbered from 0, or it is continuous (n = 0). A case is a point: for each
// parameter a number u in [0, 1), which stands for the level floor(u n), or for the fraction u of a continuous range.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/registry.hpp"

namespace corpuscle::study {

class Sampling {
  public:
    static constexpr const char* familyName = "sampling";
    virtual ~Sampling() = default;

    // One point for each case, with one number for each parameter. `levels`: n of each parameter, for which refusal()
    // is empty.
    virtual std::vector<std::vector<double>> points(const std::vector<std::size_t>& levels) const = 0;
    // Why these parameters cannot be sampled in this way; empty: they can.
    virtual std::string refusal(const std::vector<std::string>& names,
                                const std::vector<std::size_t>& levels) const = 0;
    // Whether cases are named after their values; otherwise cases are numbered.
    virtual bool namesByValues() const = 0;

  protected:
    static double middle(std::size_t level, std::size_t levels) {
        return (static_cast<double>(level) + 0.5) / static_cast<double>(levels);
    }
    // refusal() of samplings that need levels.
    static std::string continuousRefusal(const std::vector<std::string>& names, const std::vector<std::size_t>& levels);
};

}  // namespace corpuscle::study
