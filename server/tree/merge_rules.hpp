#pragma once

#include <cstdint>

#include "cluster/forming.hpp"
#include "tree/settings.hpp"

namespace slod {

/// Whether two clusters may become one (O'Brien et al. 2001, section 4.1): together no more than the
/// maximum size and breadth, and speeds and directions within the region's limits. Below the speed floor
/// speeds and directions are not compared.
bool may_merge(const ClusterStore& store, const RegionSettings& region, ClusterSlot a, ClusterSlot b,
               std::uint64_t frame);

/// Whether a cluster of `size` particles and `second_moments` (summed, not averaged) is wider than `limit`.
bool wider_than(double limit, const Symmetric3& second_moments, double size);

} // namespace slod
