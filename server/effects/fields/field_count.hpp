#pragma once

#include <array>
#include <cstdint>

#include "effects/fields/list.hpp"

namespace slod {

/// What the kernel of one effect of place did in a frame.
struct FieldCount {
    std::uint64_t calls = 0;    ///< for a block of clusters
    std::uint64_t clusters = 0; ///< that it was evaluated for, once for each element of its table
    /// Clusters, whether it was evaluated for them or not, that an element's boundary cuts; likewise.
    std::uint64_t straddling = 0;

    FieldCount& operator+=(const FieldCount& other)
    {
        calls += other.calls;
        clusters += other.clusters;
        straddling += other.straddling;
        return *this;
    }
    friend bool operator==(const FieldCount&, const FieldCount&) = default;
};

/// By effect of place, in the order of their list.
using FieldCounts = std::array<FieldCount, AllFields::size>;

} // namespace slod
