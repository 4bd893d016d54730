#pragma once

#include <cstdint>
#include <vector>

#include "cluster/forming.hpp"
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

/// Whether two clusters merge when they are alone in a pool of such a region, in whose list `a` is first.
/// Velocities are relative to `reference`. Their places in lists are as before.
bool may_merge(ClusterStore& store, const RegionSettings& region, ClusterSlot a, ClusterSlot b,
               const Vector3d& reference = {0, 0, 0});

/// How much a merge within the region's limits can change the velocity of a cluster of this mass and speed,
/// relative to the same reference, when its partner has `other_mass`: length / time. The formulas of section
/// 6.2 are no such bounds: they leave out that a turn changes the speed, and that the faster one turns the
/// slower. Of the velocities that the limits allow, none is farther away than the fastest one at the largest
/// angle.
double velocity_change_bound(const RegionSettings& region, double speed, double mass, double other_mass);

} // namespace slod::test
