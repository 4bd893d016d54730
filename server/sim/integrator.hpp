#pragma once

#include "cluster/forming.hpp"

namespace slod {

/// Kicks every cluster by `step`: v += step a(x), and its flow map by the tangent of that kick, the tide
/// and the members' own attraction included.
void kick_clusters(ClusterTable& clusters, double step);

/// The same for one cluster.
void kick_cluster(ClusterTable& clusters, std::size_t slot, double step);

/// Moves every cluster by the exact flow of the uniform fields, and its flow map by the tangent of it.
void propagate_clusters(ClusterTable& clusters, const Propagator& step);

/// Whether all clusters are at places that are numbers: those of one in `turns` of the table's blocks.
bool all_finite(const ClusterTable& clusters, std::uint64_t turn = 0, std::uint64_t turns = 1);

} // namespace slod
