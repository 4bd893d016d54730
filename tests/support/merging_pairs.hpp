#pragma once

#include <cstdint>
#include <vector>

#include "core/vectors.hpp"
#include "tree/settings.hpp"

namespace slod::test {

/// Two bodies and what becomes of them when they meet.
struct MergingPair {
    double mass = 1, other_mass = 1;
    Vector3d velocity{0, 0, 0}, other_velocity{0, 0, 0};
    bool merged = false;
    Vector3d merged_velocity{0, 0, 0}; ///< of the cluster of both
};

/// Random pairs: masses in a ratio of 0.1 to 10, speeds 0.5 to 2, and the directions within 100 degrees.
std::vector<MergingPair> random_pairs(std::size_t count, std::uint64_t seed);

/// Lets each pair meet as two clusters in rigid motion, apart from the others, in a region with these limits
/// and velocities compared at rest.
void merge_pairs(std::vector<MergingPair>& pairs, const RegionSettings& limits);

} // namespace slod::test
