#pragma once

#include <cstdint>

#include "cluster/forming.hpp"
#include "tree/slod_tree.hpp"

namespace slod::test {

/// What the particles of a little world can have. Every column that a cluster can have is there anyway,
/// the full map only where the rule asks for it.
struct Features {
    bool masses = true, kinds = false, expiry = false, withheld = false;
};

/// A store whose kinds 0, 1 and 2 have softenings 0.1, 0.2 and 0.4.
ClusterStore empty_store(const MapRule& rule, const Features& features = {});

/// Forms one cluster, in no pool, at the end of frame `frame`. Its slab has `spare` more rows.
ClusterSlot form(ClusterStore& store, ParticleSet particles, std::uint64_t frame = 0,
                 std::uint32_t spare = 0);

/// The live members of one cluster, or of all, by id.
ParticleSet members(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame);
ParticleSet members(const ClusterStore& store, std::uint64_t frame);

/// A map as a random history of `frames` kicks and steps makes it, with tides of the order of `tide` and
/// the drag and the step of `rule`.
FlowMap aged_map(const MapRule& rule, std::uint64_t frames, double tide, std::uint64_t seed);

/// Clusters and the tree they are in: one region that is everywhere, of cubic cells.
struct World {
    World(const MapRule& rule, const Features& features, const RegionSettings& region, double cell_side);

    ClusterStore store;
    SlodTree tree;

    Subtree& region() { return tree.subtrees.front(); }
    UpdateContext context(std::uint64_t frame) { return {store, frame, store.rule.step}; }

    /// Forms a cluster and puts it into the pool where its centre is.
    ClusterSlot add(const ParticleSet& particles, std::uint64_t frame = 0, std::uint32_t spare = 0);
};

} // namespace slod::test
