#include <map>
#include <set>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/merging_pairs.hpp"
#include "tree/merge_rules.hpp"
#include "tree/regrouping.hpp"

namespace slod {
namespace {

constexpr double step = 0.02;
constexpr std::size_t particle_count = 600;
const RegionSettings limits{.max_cluster_size = 12,
                            .max_breadth = 1.0,
                            .pool_factor = 4,
                            .speed_ratio = 2,
                            .angle_deg = 40,
                            .speed_floor = 0.1,
                            .velocity_reference = VelocityReference::Rest};

/// Single particles of different mass in rigid motion, which regrouping may merge. Forces look at their
/// pools, or merges alone do.
class Merging {
public:
    Merging(std::uint64_t seed, bool forces) : world({MapKind::Identity, 0, step}, {}, limits, 1)
    {
        world.store.clusters.columns.acceleration = forces;
        ParticleSet particles = test::ball(particle_count, 1.5, 0.5, seed, {0.3, -0.2, 0.1});
        test::give_masses(particles, 0, 5, seed);
        for (Particle& particle : particles) {
            particle.velocity += Vector3d(0.6, 0.3, 0);
            world.add({particle});
        }
        world.tree.merging = true;
    }

    void advance()
    {
        ++frame;
        ClusterTable& clusters = world.store.clusters;
        for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
            if (clusters.alive(slot))
                clusters.position[slot] += step * clusters.velocity[slot];
        world.store.members.recycle(frame);
        counts = {};
        regrouping.update(world.tree, frame, counts);
        note_homes();
    }

    /// The longest that any cluster has been in another pool than that of its place [frames].
    std::uint64_t longest_absence() const { return absence; }

    test::World world;
    Regrouping regrouping{{}, world.context(0)};
    UpdateCounts counts;
    std::uint64_t frame = 0;

private:
    void note_homes()
    {
        const ClusterTable& clusters = world.store.clusters;
        for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
            if (!clusters.alive(slot))
                continue;
            std::uint64_t& seen = at_home.try_emplace(clusters.formation[slot], frame - 1).first->second;
            if (clusters.pool[slot] == locate(world.region(), clusters.position[slot]))
                seen = frame;
            absence = std::max(absence, frame - seen);
        }
    }

    std::map<std::uint64_t, std::uint64_t> at_home; ///< by formation: the last frame
    std::uint64_t absence = 0;
};

void expect_sound(const Merging& merging)
{
    const ClusterTable& clusters = merging.world.store.clusters;
    ASSERT_EQ(problems(merging.world.tree, clusters), Problems{});
    const ParticleSet all = test::members(merging.world.store, merging.frame);
    ASSERT_EQ(all.size(), particle_count);
    for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_EQ(all[i].id, i + 1) << "every particle is in exactly one cluster";
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot))
            continue;
        ASSERT_LE(clusters.count[slot], limits.max_cluster_size);
        const Symmetric3 extent = map_position_moments(clusters.counting_moments(slot), {});
        const double nearly_full = clusters.count[slot] > 0.9 * limits.max_cluster_size ? 1.25 : 1;
        // Half of a cluster may be as wide as the whole of it; it is split next.
        if (merging.counts.splits > 0 && clusters.formed_frame[slot] == merging.frame)
            continue;
        ASSERT_LE(breadth(extent, clusters.count[slot]), nearly_full * limits.max_breadth * (1 + 1e-6));
    }
}

class RegroupingByForces : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Scenes, RegroupingByForces, testing::Bool(),
                         [](const auto& forces) { return forces.param ? "forces" : "none"; });

// Pools that merges alone look at have a turn in every 16 frames.
TEST_P(RegroupingByForces, KeepsTreeParticlesSizesAndBreadthsInOrder)
{
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        SCOPED_TRACE(seed);
        Merging merging(seed, GetParam());
        std::uint64_t merges = 0, crossings = 0;
        for (int frame = 0; frame < 100; ++frame) {
            merging.advance();
            merges += merging.counts.merges;
            crossings += merging.counts.crossings;
            ASSERT_NO_FATAL_FAILURE(expect_sound(merging)) << "frame " << frame;
        }
        EXPECT_GT(merges, 100U);
        EXPECT_GT(crossings, 100U);
        EXPECT_LE(merging.longest_absence(), GetParam() ? 0U : 16U);
    }
}

// Every merger of a frame is one of clusters that by their own state then were allowed to.
TEST_P(RegroupingByForces, MergesOnlyWhatMayMerge)
{
    const auto expect_alike = [](const Vector3d& a, const Vector3d& b) {
        const double fast = std::max(a.norm(), b.norm()), slow = std::min(a.norm(), b.norm());
        if (fast <= limits.speed_floor)
            return;
        EXPECT_LE(fast, limits.speed_ratio * slow);
        EXPECT_GE(a.dot(b), 0.7660444431 * fast * slow * (1 - 1e-9)); // cos 40
    };
    Merging merging(3, GetParam());
    std::size_t largest = 0;
    for (int frame = 0; frame < 60; ++frame) {
        const ClusterTable before = merging.world.store.clusters;
        std::map<std::uint64_t, std::uint32_t> slot_of; // by particle
        for (std::uint32_t slot = 0; slot < before.slot_count(); ++slot)
            if (before.alive(slot))
                for (const Particle& member :
                     test::members(merging.world.store, ClusterSlot{slot}, merging.frame))
                    slot_of[member.id] = slot;
        merging.advance();
        const ClusterTable& after = merging.world.store.clusters;
        for (std::uint32_t slot = 0; slot < after.slot_count(); ++slot) {
            if (!after.alive(slot) || after.formed_frame[slot] != merging.frame)
                continue;
            std::set<std::uint32_t> origins;
            for (const Particle& member :
                 test::members(merging.world.store, ClusterSlot{slot}, merging.frame))
                origins.insert(slot_of[member.id]);
            for (const std::uint32_t a : origins)
                for (const std::uint32_t b : origins)
                    expect_alike(before.velocity[a], before.velocity[b]);
            largest = std::max(largest, origins.size());
        }
        EXPECT_EQ(before.alive_count() - after.alive_count(), merging.counts.merges)
            << "nothing is split here";
    }
    EXPECT_GT(largest, 2U) << "whole groups merge at once";
}

// All that stand still may merge as to speed; once every pool has had its turn nothing is left to do.
TEST(Regrouping, GoesOnUntilNothingMayMerge)
{
    test::World world({MapKind::Identity, 0, step}, {}, limits, 1);
    for (const Particle& particle : test::ball(200, 1, 0, 1))
        world.add({particle});
    world.tree.merging = true;
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 400; ++frame)
        regrouping.update(world.tree, frame, counts);
    for (const Pool& pool : world.region().pools)
        for (ClusterSlot a = pool.first; a.valid(); a = world.store.clusters.next[a.index])
            for (ClusterSlot b = world.store.clusters.next[a.index]; b.valid();
                 b = world.store.clusters.next[b.index])
                EXPECT_FALSE(test::may_merge(world.store, limits, a, b));
    EXPECT_LT(world.store.clusters.alive_count(), 100U);
}

} // namespace
} // namespace slod
