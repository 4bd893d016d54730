#pragma once

#include <cstddef>
#include <cstdint>

#include "gravity/force_view.hpp"

namespace slod {

/// Nodes of a pool with so many clusters, which are halved until a part has few.
std::uint32_t nodes_of_pool(std::uint32_t clusters);

/// At most so many nodes are below those of any pools with so many clusters together.
std::size_t most_pool_nodes(std::size_t clusters);

/// Puts the clusters of all pools into the room that has been laid out for them, and the nodes between them.
void fill_pools(ForceView& view, const SlodTree& tree, const ClusterTable& clusters);

} // namespace slod
