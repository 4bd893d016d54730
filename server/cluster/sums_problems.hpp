#pragma once

#include <cstdint>

#include "cluster/forming.hpp"
#include "core/settings.hpp"

namespace slod {

/// Where what a cluster says of its members at the end of frame `frame` - mass, centre, mean velocity and
/// second moments - is not theirs, mapped out one by one, beyond the roundings of sums; empty when nothing is
/// wrong. O(particles).
Problems sums_problems(const ClusterStore& store, std::uint64_t frame);

} // namespace slod
