#pragma once

#include <stdexcept>
#include <utility>
#include <variant>

#include "core/settings.hpp"

namespace slod::test {

/// What was loaded; throws the first problem, which fails the test, when there are any.
template <class T>
T sound(std::variant<T, Problems> loaded)
{
    if (const auto* problems = std::get_if<Problems>(&loaded))
        throw std::runtime_error(problems->front());
    return std::get<T>(std::move(loaded));
}

} // namespace slod::test
