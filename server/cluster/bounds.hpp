#pragma once

#include "cluster/forming.hpp"

namespace slod {

/// Radius about the centre that no member is beyond: |A| (o_max + |o_c|) + |B| (w_max + |w_c|).
double bounding_radius(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                       std::uint64_t frame);

/// The same for velocities: no member's differs more from the cluster's.
double velocity_bound(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                      std::uint64_t frame);

/// Both at once, up to rounding, and without an exponential where maps are closed forms of the age.
struct MemberBounds {
    double radius, velocity;
};
MemberBounds member_bounds(const ClusterStore& store, std::size_t slot, std::uint64_t frame);

/// No less than member_bounds(), and without a look at the moments where maps are closed forms of the age: no
/// mean of what members have stored is longer than the longest.
MemberBounds generous_bounds(const ClusterStore& store, std::size_t slot, std::uint64_t frame);

} // namespace slod
