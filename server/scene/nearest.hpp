#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slod {

/// The fewest letters to insert, delete, replace or swap with their neighbour that make `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The one of `known` that was likely meant; null when none is near.
const std::string* nearest(std::string_view name, const std::vector<std::string>& known);

/// The remedy for a name that is none of `known`: "did you mean x?" when one is near, else all of them.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

} // namespace slod
