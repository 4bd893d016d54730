#pragma once

#include <vector>

#include "support/little_worlds.hpp"
#include "tree/regrouping.hpp"

namespace slod::test {

/// How the clusters of a RigidWorld are kept.
struct RigidRules {
    RegionSettings background;
    std::vector<RegionOfInterest> regions;
    double cell_side = 8; ///< of the background's grid, when its breadth is unlimited
    bool merging = true;
    MotionSettings motion{};
};

/// The paper's own scheme in straight flight, open to tests that ask who shares a cluster with whom: clusters
/// in rigid motion, a frame of 1/64, no forces.
class RigidWorld {
public:
    static constexpr double step = 0x1p-6;

    /// Divides the particles into clusters; or, when `singly`, gives each a cluster of its own.
    RigidWorld(const RigidRules& rules, const ParticleSet& particles, bool singly = false);

    /// One frame: all clusters move, and the tree is updated.
    void advance();
    void advance(int frames);

    const ClusterTable& clusters() const { return world_.store.clusters; }
    const ClusterStore& store() const { return world_.store; }
    SlodTree& tree() { return world_.tree; }

    std::vector<ClusterSlot> alive() const;                ///< in order
    ParticleSet members(ClusterSlot slot) const;           ///< by id
    ParticleSet particles() const;                         ///< all of them, by id
    std::vector<ClusterSlot> cluster_of_particles() const; ///< by id, which must be the numbers from 1 on

    /// What is wrong with tree or clusters; empty when nothing is.
    Problems problems() const { return slod::problems(world_.tree, clusters()); }

    UpdateCounts counts; ///< of the last frame
    std::uint64_t frame = 0;

private:
    World world_;
    Regrouping regrouping_;
};

} // namespace slod::test
