// The names among `expected` that a family of models lacks. It may have other models: each added model has a test of
// its own.
#pragma once
#include <string>
#include <vector>

#include "core/registry.hpp"

namespace corpuscle::support {

template <class Family>
std::vector<std::string> missing(const std::vector<std::string>& expected) {
    std::vector<std::string> lacking;
    for (const std::string& name : expected)
        if (!Registry<Family>::instance().find(name)) lacking.push_back(name);
    return lacking;
}

}  // namespace corpuscle::support
