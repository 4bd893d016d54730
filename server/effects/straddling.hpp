#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "cluster/bounds.hpp"

namespace slod {

/// No less than how far any member is from its cluster's centre, without a look at map and moments: most
/// clusters are too far from a boundary to need more. Of members alike none is farther out than the root of
/// the sum of all squares, which the variance that was measured before forces has.
inline double quick_reach(const ClusterStore& store, std::size_t slot)
{
    const ClusterTable& clusters = store.clusters;
    if (store.rule.kind == MapKind::Identity)
        return 2 * double(clusters.offset_max[slot]);
    if (clusters.columns.variance() && !clusters.columns.counting_moments)
        return std::sqrt(clusters.count[slot] * clusters.variance[slot]);
    return std::numeric_limits<double>::infinity();
}

/// Counts the clusters of [first, last) that a boundary of one of the fields cuts, as they are at the end of
/// `frame`. Any thread may call it.
template <class Fields>
void count_straddling(Fields& fields, const ClusterStore& store, std::uint64_t frame, std::size_t first,
                      std::size_t last)
{
    for (std::size_t slot = first; slot < last; ++slot) {
        if (store.clusters.count[slot] < 2)
            continue;
        const Vector3d& x = store.clusters.position[slot];
        if (fields.clearance(x) < quick_reach(store, slot))
            fields.count_straddling(x, member_bounds(store, slot, frame).radius);
    }
}

} // namespace slod
