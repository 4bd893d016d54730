#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/number_text.hpp"
#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

/// `text` as a TOML basic string, quotes included.
std::string string_text(std::string_view text);

/// number_text as a TOML float: "10.0" where that has neither point nor exponent.
std::string float_text(double value);

/// `list` as "a, b, c".
template <class List>
std::string joined(const List& list)
{
    std::string text;
    for (const auto& item : list) {
        if (!text.empty())
            text += ", ";
        text += item;
    }
    return text;
}

/// The smallest and largest value that a field of type T takes.
struct Range {
    double minimum, maximum;

    bool contains(double value) const { return value >= minimum && value <= maximum; }
};
template <class T>
Range range_of(const Field& field)
{
    Range range{field.minimum, field.maximum};
    if constexpr (std::is_integral_v<T>) {
        range.minimum = std::max(range.minimum, double(std::numeric_limits<T>::lowest()));
        range.maximum = std::min(range.maximum, double(std::numeric_limits<T>::max()));
    }
    return range;
}

/// "1 to 64", "at least 0, or inf", "any".
std::string range_text(const Range& range, bool infinity_allowed);

/// "[[1.0, 2.0], [3.0, 4.0]]".
std::string pairs_text(const NumberPairs& pairs);

/// A setting's value in TOML.
template <class T>
std::string value_text(const T& value)
{
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_enum_v<T>)
        return string_text(names(value)[std::size_t(value)]);
    else if constexpr (std::is_integral_v<T>)
        return std::to_string(value);
    else if constexpr (std::is_same_v<T, double>)
        return float_text(value);
    else if constexpr (std::is_same_v<T, NumberPairs>)
        return pairs_text(value);
    else if constexpr (std::is_same_v<T, Vector3d>)
        return "[" + float_text(value.x()) + ", " + float_text(value.y()) + ", " + float_text(value.z()) +
               "]";
    else
        return string_text(value);
}

/// What a setting of type T may be, in a few words.
template <class T>
std::string choice_text(const Field& field)
{
    if constexpr (std::is_same_v<T, bool>)
        return "true or false";
    else if constexpr (std::is_enum_v<T>)
        return joined(names(T{}));
    else if constexpr (std::is_arithmetic_v<T>)
        return range_text(range_of<T>(field), field.infinity_allowed);
    else if constexpr (std::is_same_v<T, Vector3d>)
        return std::isfinite(field.minimum) || std::isfinite(field.maximum)
                   ? "3 numbers, each " + range_text(range_of<double>(field), false)
                   : "3 numbers";
    else if constexpr (std::is_same_v<T, NumberPairs>)
        return "pairs of numbers, each " + range_text(range_of<double>(field), false);
    else
        return "text";
}

} // namespace slod
