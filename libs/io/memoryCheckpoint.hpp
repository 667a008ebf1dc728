// Counterpart of CheckpointWriter and CheckpointReader in the memory of each rank: a state for rollback within a run.
// No function is collective. The number of ranks is the same at writing and reading, and replicated data must be the
// same on all ranks.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace corpuscle::io {

class MemoryCheckpoint {
  public:
    // The number of components matters for files only.
    void writeDistributed(const std::string& name, std::span<const double> values, int = 1) { keep(name, values); }
    void writeDistributed(const std::string& name, std::span<const std::int64_t> values, int = 1) {
        keep(name, values);
    }
    void writeReplicated(const std::string& name, std::span<const double> values) { keep(name, values); }
    void writeReplicated(const std::string& name, std::span<const std::int64_t> values) { keep(name, values); }
    void attribute(const std::string& name, double value) {
        keep(attributeKey(name), std::span<const double>(&value, 1));
    }
    void attribute(const std::string& name, std::int64_t value) {
        keep(attributeKey(name), std::span<const std::int64_t>(&value, 1));
    }

    // Throw std::out_of_range for a name that was not written, std::bad_variant_access for another type.
    template <class T>
    const std::vector<T>& readDistributed(const std::string& name, int = 1) const {
        return std::get<std::vector<T>>(values_.at(name));
    }
    template <class T>
    const std::vector<T>& readReplicated(const std::string& name) const {
        return std::get<std::vector<T>>(values_.at(name));
    }
    template <class T>
    T attribute(const std::string& name) const {
        return std::get<std::vector<T>>(values_.at(attributeKey(name))).front();
    }
    bool has(const std::string& name) const { return values_.contains(name); }
    static constexpr bool sameRanks() { return true; }

  private:
    static std::string attributeKey(const std::string& name) { return "@" + name; }
    template <class T>
    void keep(const std::string& name, std::span<const T> values) {
        using Vector = std::vector<T>;
        auto& kept = values_[name];
        if (!std::holds_alternative<Vector>(kept)) kept = Vector();
        std::get<Vector>(kept).assign(values.begin(), values.end());  // reuses the memory of the last call
    }
    std::map<std::string, std::variant<std::vector<double>, std::vector<std::int64_t>>> values_;
};

}  // namespace corpuscle::io
