#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slod {

/// What a reader, a command line, a help text and a report need to know of one setting. Every settings
/// struct has a function beside it,
///     template <class Visitor> void for_each_field(Settings& s, Visitor&& visit),
/// that calls visit(field, s.member) for each of its members. It is the only list of them.
struct Field {
    std::string_view key;  ///< as in the scene file
    std::string_view unit; ///< scene units by name ("length", "1/time"), SI ("s", "Hz") or empty
    std::string_view help; ///< one sentence
    double minimum = -std::numeric_limits<double>::infinity(); ///< numbers and their vectors' components
    double maximum = std::numeric_limits<double>::infinity();  ///< in [minimum, maximum]
    bool infinity_allowed = false; ///< a number may be inf ("unlimited"); NaN never
};

/// A setting that is a list of pairs of numbers, [[a, b], ...] in the scene file; a field's range holds for
/// each.
using NumberPairs = std::vector<std::array<double, 2>>;

/// Sentences that say what is wrong, the key first; empty when nothing is.
using Problems = std::vector<std::string>;

inline constexpr double no_minimum = -std::numeric_limits<double>::infinity();
inline constexpr double no_maximum = std::numeric_limits<double>::infinity();

} // namespace slod
