#pragma once

#include "cluster/forming.hpp"

namespace slod {

/// Kicks every cluster by `step`: v += step a(x), and its flow map by the tangent of that kick, the tide
/// and the members' own attraction included. False: some velocity or map is none any more.
[[nodiscard]] bool kick_clusters(ClusterTable& clusters, double step);

/// The same for one cluster.
void kick_cluster(ClusterTable& clusters, std::size_t slot, double step);

/// Moves every cluster by the exact flow of the uniform fields, and its flow map by the tangent of it. False:
/// some place or map is none any more.
[[nodiscard]] bool propagate_clusters(ClusterTable& clusters, const Propagator& step, double range);

/// Largest square of the rate at which fields and the members' own attraction deform a cluster, 1 / time^2.
/// Needs columns.tide.
double largest_rate_squared(const ClusterTable& clusters);

/// Whether all clusters are sound.
bool all_sound(const ClusterTable& clusters, double range);

} // namespace slod
