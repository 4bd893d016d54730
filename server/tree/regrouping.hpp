#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cluster/motion.hpp"
#include "tree/crowded.hpp"
#include "tree/gathering.hpp"
#include "tree/grouping.hpp"
#include "tree/pool_turns.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// The update of clusters whose maps do not age: those of exact flow maps, of rigid motion (O'Brien et
/// al. 2001, sections 4.1 and 4.3) and single particles. A cluster whose centre crosses into another leaf
/// or region moves to that one's pool, at once where the pools say what acts on it or what region it is in,
/// and in turns where they only say what it may merge with; one that has become too large or too wide is
/// split; where the tree has `merging`, those of one pool merge that together are small enough and move
/// alike.
class Regrouping {
public:
    Regrouping(const MotionSettings& motion, const UpdateContext& context)
        : motion_(motion.motion), merged_velocities_(motion.merged_velocities), context_(context)
    {}

    /// Divides clusters by their members' velocities, wherever those are, until in each of them the region's
    /// speed ratio and angle hold between any two members.
    void divide_by_velocity(SlodTree& tree, std::uint64_t frame);

    /// Provides memory for updates that form `particle_count` particles anew, in the clusters there is room
    /// for.
    void reserve(const SlodTree& tree, std::size_t particle_count);

    /// Updates after the clusters have moved to the end of frame `frame`.
    void update(SlodTree& tree, std::uint64_t frame, UpdateCounts& counts);

private:
    enum class Action : std::uint8_t { Stay, Cross, Split };

    /// The velocity of a cluster, and whether it is another one than its members' mean.
    struct HeldVelocity {
        Vector3d velocity;
        bool held;
    };

    /// What it took to find where clusters belong.
    struct Search {
        std::uint64_t nodes = 0, tests = 0;
    };

    /// A sum over particles.
    struct Rush {
        Vector3d velocity{0, 0, 0};
        std::uint64_t particles = 0;
    };

    /// One subtree's share of the memory to split leaves with, and what was looked at there.
    struct Revision {
        std::size_t first = 0, clusters = 0;
        std::uint64_t keys = 0;
    };

    bool to_be_revised(const Subtree& subtree, std::uint32_t pool) const;
    void plan(const SlodTree& tree, UpdateCounts& counts);
    Action action(const SlodTree& tree, std::size_t slot, Search& search);
    bool crosses(const SlodTree& tree, std::size_t slot, Search& search);
    void move_crossing(SlodTree& tree, UpdateCounts& counts);
    void fetch_links(const SlodTree& tree, ClusterSlot slot) const;
    void split(SlodTree& tree, UpdateCounts& counts);
    void note_held_velocities();
    void hold_velocities();
    void measure_surroundings(const SlodTree& tree);
    void merge(SlodTree& tree, UpdateCounts& counts);
    void dissolve_splitting(SlodTree& tree);
    void form_dissolved(SlodTree& tree, Vector3d Particle::*key);
    void share_velocities();
    void revise(SlodTree& tree, UpdateCounts& counts);
    void revise(Subtree& subtree, Revision& revision);

    Motion motion_;
    MergedVelocities merged_velocities_;
    UpdateContext context_;
    PoolTurns turns_;
    Grouping grouping_;
    Gathering gathering_;
    std::vector<Action> actions_;  ///< by slot
    std::vector<PoolRef> targets_; ///< by slot, of those that cross
    std::vector<Search> searches_; ///< by block of slots
    std::vector<ClusterSlot> crossing_, splitting_;
    std::vector<HeldVelocity> held_; ///< by cluster that is split, if any may hold one
    SplitMemory split_memory_;
    std::vector<Revision> revisions_;    ///< by region
    std::vector<Vector3d> surroundings_; ///< by region: what its velocities are relative to
    std::vector<Rush> rushes_;           ///< by block of slots, then region
};

} // namespace slod
