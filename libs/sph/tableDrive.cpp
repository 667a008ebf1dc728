// `table`: a drive from a CSV file with the columns time_s and factor, interpolated linearly. With `repeat` the table
// is one period, whose last row has the factor of the first; else the factor stays what it is in the last row.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/csvSeries.hpp"
#include "sph/drive.hpp"

namespace corpuscle::sph {

namespace {

struct TableDrive : Drive {
    std::string file;
    bool repeat = false;
    static const Schema<TableDrive>& schema() {
        static const Schema<TableDrive> s =
            Schema<TableDrive>("table", "a factor from a table, interpolated linearly")
                .text("file", &TableDrive::file,
                      "CSV file with the columns time_s, from 0, and factor, relative to the case")
                .boolean("repeat", &TableDrive::repeat, "the table is one period; else its last factor stays",
                         {.fallback = "false"});
        return s;
    }

    void prepare(const std::filesystem::path& caseDirectory) const override {
        const std::filesystem::path path = caseDirectory / file;
        const io::CsvTable table = io::readCsv(path);
        std::vector<double> times = table.column("time_s"), factors = table.column("factor");
        const auto fail = [&](std::string_view what) {
            throw Failure(ExitCode::invalidCase, fmt::format("{}: {}", path.string(), what));
        };
        if (times.size() < 2) fail(fmt::format("found {} rows, and a table has at least 2", times.size()));
        if (times.front() != 0)
            fail(fmt::format("found {:g} as the first time_s; the table has to begin at 0", times.front()));
        for (std::size_t k = 1; k < times.size(); ++k)
            if (!(times[k] > times[k - 1]))
                fail(
                    fmt::format("found {:g} after {:g} in the column time_s; each time has to be greater than the one "
                                "before it",
                                times[k], times[k - 1]));
        const auto size = [](double f) { return std::abs(f); };
        largest_ = size(
            *std::max_element(factors.begin(), factors.end(), [&](double a, double b) { return size(a) < size(b); }));
        if (!(largest_ > 0 && std::isfinite(largest_))) fail("the column factor has to hold a number other than 0");
        if (repeat && std::abs(factors.back() - factors.front()) > 1e-9 * largest_)
            fail(
                fmt::format("found the factor {:g} in the first row and {:g} in the last; with 'repeat: true' they "
                            "have to be equal, since the table is one period",
                            factors.front(), factors.back()));
        times_ = std::move(times), factors_ = std::move(factors);
    }

    double factor(double t) const override {
        const double period = times_.back(), at = repeat ? t - period * std::floor(t / period) : t;
        const auto next = std::upper_bound(times_.begin(), times_.end(), at);
        if (next == times_.end()) return factors_.back();
        const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, next - times_.begin()));
        const double share = (at - times_[k - 1]) / (times_[k] - times_[k - 1]);
        return factors_[k - 1] + std::max(0.0, share) * (factors_[k] - factors_[k - 1]);
    }
    double largest() const override { return largest_; }
    double changesIn() const override {
        double steepest = 0;
        for (std::size_t k = 1; k < times_.size(); ++k)
            steepest = std::max(steepest, std::abs(factors_[k] - factors_[k - 1]) / (times_[k] - times_[k - 1]));
        return largest_ / steepest;  // infinite where the factor never changes
    }

  private:
    mutable std::vector<double> times_, factors_;  // read by prepare() [s]
    mutable double largest_ = 0;
};

CORPUSCLE_REGISTER(Drive, TableDrive, "table", "from a CSV file");

}  // namespace

}  // namespace corpuscle::sph
