// Family of statistics, which a study takes from a table of a case: each makes one number from a series in time.
#pragma once
#include <limits>
#include <span>
#include <string>

#include "core/registry.hpp"

namespace corpuscle::study {

struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();  // standard error; NaN: this statistic has none
    bool isReliable = true;                                   // false: the error is a lower bound
};

class Statistic {
  public:
    static constexpr const char* familyName = "statistic";
    virtual ~Statistic() = default;

    // along: the strain or time of each value, ascending, at least one. The value is NaN where the series does not
    // determine it.
    virtual Estimate of(std::span<const double> along, std::span<const double> values) const = 0;
    virtual bool hasError() const { return false; }
    virtual bool needsEvenSpacing() const { return false; }
    virtual bool isAlong() const { return false; }      // the value is a strain or a time itself
    virtual bool isOfWholeRun() const { return true; }  // where no range is given; false: of its second half
    virtual std::string text() const = 0;               // "mean", "first value below 0.5"
};

}  // namespace corpuscle::study
