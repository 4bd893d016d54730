#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cluster/particles.hpp"
#include "tree/divide.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Particles without a cluster, on their way to being formed into clusters: the one road by which
/// clusters come about, whether at the start, at the end of a pool's life, by a split or at birth.
/// Memory is kept from frame to frame.
struct Grouping {
    /// Particles that are divided into clusters together.
    struct Group {
        PoolRef pool;            ///< where they go
        std::uint32_t first = 0; ///< in `order`
        std::uint32_t count = 0;
        std::uint32_t clusters = 0;   ///< into which they are divided
        std::uint32_t spare_rows = 0; ///< kept free in each cluster's slab for members to come
        std::uint32_t first_slot = 0; ///< in `slots`
    };

    std::vector<Particle> particles;
    std::vector<Vector3d> place;      ///< by particle: where it counts as being when grouped
    std::vector<float> pull;          ///< by particle: |a| of the cluster it comes from; 0: none is known
    std::vector<std::uint32_t> order; ///< particle indices, group by group
    std::vector<Group> groups;

    // Scratch of the functions below.
    std::vector<ClusterSlot> slots;
    std::vector<DivisionKey> keys, spare_keys;
    std::vector<Particle> ordered;
    std::vector<PoolRef> homes; ///< by formed cluster: where it is

    void clear();

    /// Room for `count` particles; the arrays per particle have exactly this length then. What was not there
    /// before has no pull.
    void resize(std::size_t count);

    /// Provides memory for so many particles, groups and clusters to be.
    void reserve(std::size_t particle_count, std::size_t group_count, std::size_t cluster_count);
};

/// Members that clusters in `slots` hold, mapped out to the front of `grouping`, in order, with their pulls;
/// the clusters end.
void dissolve(SlodTree& tree, Grouping& grouping, std::span<const ClusterSlot> slots,
              const UpdateContext& context);

/// Ends clusters: takes them off their pools, frees their slots and retires their slabs.
void end_clusters(SlodTree& tree, std::span<const ClusterSlot> slots, const UpdateContext& context);

/// Divides each group into its number of clusters (0: none) and forms them; they inherit their members' mean
/// pull.
void form_groups(Grouping& grouping, const UpdateContext& context);

/// Forms each group as form_groups() does, its particles in the order that they are in.
void form_groups_in_order(Grouping& grouping, const UpdateContext& context);

/// Adds the clusters just formed to the pools where their centres are. Throws std::overflow_error as
/// refuse_unbounded() does.
void link_where_they_are(SlodTree& tree, Grouping& grouping, const UpdateContext& context);

/// Adds the clusters just formed to their groups' pools.
void link_groups(SlodTree& tree, const Grouping& grouping, ClusterTable& clusters);

/// Throws std::overflow_error: in this frame something was to be grouped whose place is no number.
[[noreturn]] void refuse_unbounded(std::uint64_t frame);

/// Clusters of at most ceil(size) particles that `count` particles are divided into.
constexpr std::uint32_t clusters_for(std::uint32_t count, double size)
{
    const auto whole = std::uint32_t(count / size);
    return whole * size < count ? whole + 1 : whole;
}

} // namespace slod
