#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cluster/motion.hpp"
#include "tree/grouping.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// The update of clusters whose flow maps age, in fields that depend on the position. A pool's clusters
/// are formed together and live a fixed number of frames, after the dynamical clock of the tides there:
///   life = clamp(2^round(log2(clock / (step sqrt(|T|)))), shortest, longest).
/// A life also ends as soon as one of the pool's maps is worn. When it ends, its members are mapped out and
/// go to the pool where they will be in the middle of the next life: compact then, clusters are too wide as
/// long before as after it, and the errors of near-pair forces cancel. A pool that is due itself takes them
/// all and is divided anew; in another one a stray joins the nearest cluster, or founds one with the other
/// strays.
class Reforming {
public:
    /// Clusters of a pool that a stray is compared with: a bound for pools that cannot be divided however
    /// many they hold; elsewhere few have so many.
    static constexpr std::uint32_t most_candidates = 256;

    Reforming(const MotionSettings& motion, const UpdateContext& context);

    /// Takes another dynamical clock for the lives to come, in units of the local dynamical time.
    void set_clock(double clock) { motion_.clock = clock; }

    /// Whether strays will come to clusters that are formed, for which they keep room.
    enum class Strays : bool { None, Come };

    /// Forms clusters of `particles`, none of which has one yet.
    void found(SlodTree& tree, std::span<const Particle> particles, std::uint64_t frame,
               Strays strays = Strays::Come);

    /// Ends all lives now, whatever their clocks say: for lives that the first forces have yet to set.
    void reform_all(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts);

    /// Provides memory for updates of so many particles, in the clusters and pools there is room for.
    void reserve(const SlodTree& tree, std::size_t particle_count);

    /// Re-forms the pools that are due at the end of frame `frame`.
    void update(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts);

private:
    /// A pool whose clusters' lives end now, and where its members are in `grouping_.particles`.
    struct Due {
        PoolRef pool;
        std::uint32_t first, count;
    };

    void reform(SlodTree& tree, UpdateCounts& counts);
    std::uint64_t end_worn_lives(SlodTree& tree);
    void merge_sparse_pools(SlodTree& tree);
    void start_lives(SlodTree& tree);
    void map_out_due(SlodTree& tree);
    void find_targets(SlodTree& tree);
    void gather_groups(const SlodTree& tree);
    void expand_crowded(SlodTree& tree);
    void expand_group(SlodTree& tree, std::size_t group);
    void place_strays(SlodTree& tree, UpdateCounts& counts);
    std::uint32_t insert_strays(SlodTree& tree, Grouping::Group& group);
    void form(SlodTree& tree, Strays strays);

    std::uint64_t wanted_life(const SlodTree& tree, const PoolRef& pool) const;
    void start_life(Pool& pool, std::uint64_t life) const;
    bool due_now(const Pool& pool) const { return pool.turn_frame == context_.frame; }

    MotionSettings motion_;
    UpdateContext context_;
    Grouping grouping_;
    std::vector<Due> due_;
    std::vector<ClusterSlot> ending_;      ///< clusters of the due pools, in their order
    std::vector<PoolRef> target_;          ///< by particle
    std::vector<std::uint32_t> arrivals_;  ///< by pool, all regions in a row
    std::vector<std::uint32_t> pool_base_; ///< by region: its first row in `arrivals_`
};

} // namespace slod
