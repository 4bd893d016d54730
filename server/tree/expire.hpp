#pragma once

#include <cstdint>
#include <vector>

#include "tree/slod_tree.hpp"

namespace slod {

/// Ends the lives of members whose time has come, and clusters that this leaves empty.
class Expiry {
public:
    /// Provides memory for the clusters there is room for.
    void reserve(const ClusterTable& clusters) { died_.reserve(clusters.slot_capacity()); }

    /// Returns how many particles died at the end of context.frame.
    std::uint64_t update(SlodTree& tree, const UpdateContext& context);

private:
    std::vector<std::uint32_t> died_; ///< by slot
};

} // namespace slod
