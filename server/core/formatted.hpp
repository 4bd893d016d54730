#pragma once

#include <cstdio>
#include <string>

namespace slod {

/// As printf() would print it.
template <class... Values>
std::string formatted(const char* format, Values... values)
{
    std::string text(std::size_t(std::snprintf(nullptr, 0, format, values...)), ' ');
    std::snprintf(text.data(), text.size() + 1, format, values...);
    return text;
}

} // namespace slod
