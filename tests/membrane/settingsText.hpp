// Settings and models from the text of a case.
#pragma once
#include <string>

#include "core/registry.hpp"

namespace corpuscle::membrane::testing {

template <class T>
T parsed(const std::string& text) {
    Problems problems;
    const auto value = read<T>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return value;
}

template <class Family>
std::shared_ptr<const Family> chosen(const std::string& text) {
    Problems problems;
    const auto choice = readChoice<Family>(parseValue(text, "test", problems), problems);
    problems.throwIfAny();
    return choice.model;
}

}  // namespace corpuscle::membrane::testing
