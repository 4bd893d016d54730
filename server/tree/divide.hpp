#pragma once

#include <cstdint>
#include <span>

namespace slod {

/// A particle to be grouped with its neighbours: where it counts as being, and which one it is.
struct DivisionKey {
    float x[3];          ///< relative to a nearby origin, scene length
    std::uint32_t index; ///< breaks ties
};

/// Orders `keys` so that cutting them into `parts` runs with part_begin() puts neighbours together: by k-d
/// splits at balanced counts, each across the longest side of what it splits. Within a part they stay in the
/// order they were in. `spare` has room for as many. There
/// are no more parts than keys.
void divide(std::span<DivisionKey> keys, std::span<DivisionKey> spare, std::uint32_t parts);

/// First key of part `part`; the parts differ in size by at most one level's rounding, and none has more
/// than ceil(count / parts).
std::uint32_t part_begin(std::uint32_t count, std::uint32_t parts, std::uint32_t part);

} // namespace slod
