#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/vectors.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// What is published as one node: a cluster, or the sum of neighbouring ones.
struct PublishedNode {
    Vector3d position{0, 0, 0}; ///< centre of mass, scene length
    Vector3d velocity{0, 0, 0}; ///< mean by mass
    double mass = 0;
    std::uint32_t particles = 0;
    Symmetric3 covariance;       ///< of the particles' positions about `position`, by mass
    ClusterId id;                ///< of the first cluster
    std::uint64_t formation = 0; ///< of the first cluster
};

/// The sum of the clusters in `rows` (at least one) of `states`: conserves mass, momentum and particles,
/// and the second moments with them. Weightless clusters weigh by their particles.
PublishedNode sum_of(const ClusterStates& states, std::span<const std::uint32_t> rows);

/// Divides clusters into at most so many groups of neighbours. Depends on nothing but the clusters and
/// their order. Keeps its memory from call to call.
class NodeGroups {
public:
    /// Groups the clusters in `rows`. As many groups as clusters when `limit` allows; else `limit` runs,
    /// equally long within one, of the clusters in Morton order (Morton 1966).
    void form(const ClusterStates& states, std::span<const std::uint32_t> rows, std::size_t limit);

    /// Groups all clusters.
    void form(const ClusterStates& states, std::size_t limit);

    std::size_t size() const { return group_count_; }
    std::size_t clusters() const { return rows_.size(); }
    std::uint32_t clusters_per_group() const; ///< at most; 1 when there is no cluster

    /// Rows of the clusters of group `index`; at least one.
    std::span<const std::uint32_t> operator[](std::size_t index) const;

    /// Centre of the smallest box about all the centres; 0 when there are none.
    Vector3d origin() const { return (lower_ + upper_) / 2; }

private:
    void divide(const ClusterStates& states, std::size_t limit);
    void find_box(const ClusterStates& states);
    void sort_by_place(const ClusterStates& states);
    void sort_by_digit(unsigned shift);

    struct Key {
        std::uint64_t code; ///< Morton code of the centre
        std::uint32_t row;
    };

    std::size_t group_count_ = 0;
    std::vector<std::uint32_t> rows_;
    std::vector<Key> keys_, sorted_keys_;
    Vector3d lower_{0, 0, 0}, upper_{0, 0, 0};
};

} // namespace slod
