#pragma once

#include <compare>
#include <cstdint>

namespace slod {

/// An index of one kind of thing. Two kinds do not mix; `none` is no thing.
template <class Tag>
struct Id {
    static constexpr std::uint32_t none = 0xffff'ffff;

    std::uint32_t index = none;

    constexpr bool valid() const { return index != none; }
    friend constexpr auto operator<=>(Id, Id) = default;
};

using ClusterSlot = Id<struct ClusterSlotTag>; ///< a row of the cluster table; re-used after the cluster ends
using NodeId = Id<struct NodeTag>;             ///< a node of one subtree
using PoolId = Id<struct PoolTag>;             ///< a pool of one subtree
using RunId = Id<struct RunTag>;               ///< what reaches into one cell of a grid of regions

/// Names a cluster outside the step: its row, and how often the row had been given away before.
struct ClusterId {
    ClusterSlot slot;
    std::uint32_t generation = 0;

    friend constexpr auto operator<=>(ClusterId, ClusterId) = default;
};

} // namespace slod
