#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/sweep.hpp"

namespace slod {

/// Boxes that stay where they are, in a binary tree of boxes around them: who meets a sweep is found in a
/// time that grows with the logarithm of their number.
///
/// Nodes are stored depth first. Invariants:
///  - a node's box holds those of its leaves;
///  - `after` is the first node that is not below it;
///  - a leaf holds at most `leaf_capacity` boxes, in order of their indices.
class BoxTree {
public:
    explicit BoxTree(std::span<const Box> boxes);

    /// Calls visit(index) for each box that the sweep may meet, and for some near them, until it returns
    /// true; returns whether it did.
    template <class Visit>
    bool any(const Sweep& sweep, const Visit& visit) const
    {
        for (std::size_t i = 0; i < nodes_.size();) {
            const Node& node = nodes_[i];
            if (!sweep.meets(node.box)) {
                i = node.after;
                continue;
            }
            for (const std::uint32_t index : std::span(order_).subspan(node.first, node.count))
                if (visit(index))
                    return true;
            ++i;
        }
        return false;
    }

private:
    static constexpr std::uint32_t leaf_capacity = 4;

    struct Node {
        Box box;
        std::uint32_t after = 0;
        std::uint32_t first = 0, count = 0; ///< in `order_`; none in an inner node
    };

    void build(std::span<const Box> boxes, std::uint32_t first, std::uint32_t count);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

} // namespace slod
