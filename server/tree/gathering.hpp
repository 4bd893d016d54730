#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tree/merge_rules.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Finds clusters that are to merge: in each pool, once in so many frames. Each one gathers the nearest of
/// those that follow it in the list, `most_candidates` at most, that the region's rules let it merge with,
/// until together they fill one cluster or, where they would not be fewer then, `most_parts`. So clusters of
/// any size become as large as they may in one turn, also where that is less than twice their size. Memory
/// is kept from frame to frame.
class Gathering {
public:
    /// A bound for pools that cannot be divided however many clusters they hold; elsewhere few have so many.
    static constexpr std::uint32_t most_candidates = 256;
    static constexpr std::uint32_t most_parts = 2;
    static constexpr std::uint64_t period = 16; ///< every pool looks for merges once in so many frames

    /// Clusters of one pool that become fewer.
    struct Group {
        std::uint32_t first = 0;    ///< in `clusters`
        std::uint32_t clusters = 0; ///< that there are
        std::uint32_t parts = 0;    ///< that they are to become
        std::uint32_t members = 0;
    };

    /// Provides memory for so many clusters.
    void reserve(std::size_t count);

    /// Fills `groups` and `clusters` with those of the pools whose turn is in `frame`, in the order of pools
    /// and their lists. `surroundings`: by region, what its velocities are relative to. Returns how many
    /// candidates were looked at.
    std::uint64_t find(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                       std::span<const Vector3d> surroundings);

    std::vector<Group> groups;
    std::vector<ClusterSlot> clusters; ///< group by group

private:
    /// What a pool is searched with.
    struct Search {
        const Subtree& tree;
        const ClusterStore& store;
        std::uint64_t frame;
        Vector3d reference;
        MergeRules rules;
        std::uint32_t smallest; ///< particles of the pool's smallest cluster
    };

    /// What a seed has gathered so far.
    struct Heap {
        std::uint32_t parts; ///< that it is to become, at most
        std::uint32_t clusters, members;
        VelocityBall ball;
        Crowd crowd;
    };

    /// What searching a pool came to.
    struct Found {
        std::uint64_t looked_at = 0; ///< candidates
        bool groups = false;         ///< are there
    };

    Found search_pool(Search search, const Pool& pool);
    static bool may_gather(const Search& search, const Pool& pool);
    bool gather(const Search& search, ClusterSlot seed, std::uint32_t parts, std::uint64_t& looked_at);
    ClusterSlot nearest_later(const Search& search, ClusterSlot seed, const Heap& heap,
                              std::uint64_t& looked_at) const;
    static Crowd crowd(const Search& search, ClusterSlot slot);
    void list_groups(const ClusterTable& table, const Pool& pool);

    enum class Place : std::uint8_t { Free, Out, Seed, Follower };

    std::vector<Place> places_;        ///< by slot, in a group or not
    std::vector<ClusterSlot> next_;    ///< by slot: the next one that the same seed gathered
    std::vector<std::uint32_t> parts_; ///< by slot of a seed
    std::vector<VelocityBall> balls_;  ///< by slot, of those that are not out
    std::vector<Found> found_;         ///< by pool in its turn
};

} // namespace slod
