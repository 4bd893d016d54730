#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "tree/reforming.hpp"

namespace slod {
namespace {

constexpr RegionSettings region{.max_cluster_size = 16, .pool_factor = 4};

class ReformingTest : public testing::Test {
protected:
    test::World world{{MapKind::Full, 0, 0.01}, {}, region, 4};
    Reforming reforming{{}, world.context(0)};
    UpdateCounts counts;
};

// Two balls that will be at the same place then, 0.32 from now: what is together now is not what will be.
TEST_F(ReformingTest, GroupsMembersByWhereTheyWillBeInTheMiddleOfTheirLife)
{
    ParticleSet particles = test::ball(64, 0.9, 0, 1, {2, 2, 2});
    for (Particle& particle : particles) {
        const double side = particle.id % 2 == 0 ? 1 : -1;
        particle.position.x() += side;
        particle.velocity.x() = -side / 0.32;
    }
    reforming.found(world.tree, particles, 0);
    reforming.reform_all(world.tree, 0, counts); // without a tide a life is 64 frames of 0.01
    double now = 0, midway = 0;
    for (std::uint32_t slot = 0; slot < world.store.clusters.slot_count(); ++slot) {
        if (!world.store.clusters.alive(slot))
            continue;
        const double life =
            double(world.region().pools[world.store.clusters.pool[slot].index].due_frame) * 0.01;
        for (const Particle& member : test::members(world.store, ClusterSlot{slot}, 0)) {
            const Vector3d apart = member.position - world.store.clusters.position[slot];
            const Vector3d later = apart + life / 2 * (member.velocity - world.store.clusters.velocity[slot]);
            now += apart.squaredNorm();
            midway += later.squaredNorm();
        }
    }
    EXPECT_LT(4 * midway, now);
}

TEST_F(ReformingTest, ReformsOnlyPoolsThatAreDue)
{
    reforming.found(world.tree, test::ball(1000, 6, 0, 1), 0);
    Subtree& tree = world.region();
    for (std::uint32_t pool = 0; pool < tree.pools.size(); ++pool)
        tree.pools[pool].due_frame = pool % 3 == 0 ? 5 : 9;
    const ClusterTable& clusters = world.store.clusters;
    std::vector<std::uint64_t> formation(clusters.formation.begin(), clusters.formation.end());
    std::vector<PoolId> pool(clusters.pool.begin(), clusters.pool.end());
    reforming.update(world.tree, 5, counts);
    std::size_t kept = 0;
    for (std::size_t slot = 0; slot < formation.size(); ++slot) {
        if (pool[slot].index % 3 == 0)
            EXPECT_NE(clusters.formation[slot], formation[slot]);
        else
            kept += clusters.formation[slot] == formation[slot] ? 1 : 0;
    }
    EXPECT_GT(kept, formation.size() / 3);
    EXPECT_GT(counts.due_pools, 0U);
}

/// A pool that is due has a member that is by now in the next cell, where a cluster is in the midst of its
/// life.
class StrayTest : public ReformingTest {
protected:
    /// `host_size` particles within 0.5 of (6, 2, 2), `spare` free rows, a member at `place` that strays.
    void stray(std::size_t host_size, std::uint32_t spare, const Vector3d& place)
    {
        reforming.found(world.tree, test::ball(11, 0.5, 0, 1, {2, 2, 2}), 0);
        host = world.add(test::ball(host_size, 0.5, 0, 2, {6, 2, 2}), 0, spare);
        world.store.clusters.variance[host.index] = 0.15; // 3/5 of the squared radius
        const PoolId due = locate(world.region(), Vector3d(2, 2, 2));
        pool = world.store.clusters.pool[host.index];
        const ClusterSlot visitor =
            world.add({{.position = place, .velocity = {0, 0, 0}, .id = 99, .mass = 1}});
        unlink(world.region(), world.store.clusters, visitor);
        link(world.region(), world.store.clusters, due, visitor);
        world.region().pools[due.index].due_frame = 1;
        world.region().pools[pool.index].turn_frame = 0;
        world.region().pools[pool.index].due_frame = 50;
        reforming.update(world.tree, 1, counts);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
        EXPECT_EQ(counts.strays_inserted + counts.strays_founding, 1U);
    }

    ClusterSlot host;
    PoolId pool;
};

TEST_F(StrayTest, JoinsTheNearestClusterOfAPoolThatIsNotDue)
{
    stray(8, 4, {5.5, 2, 2}); // two rms radii are 0.77
    EXPECT_EQ(counts.strays_inserted, 1U);
    EXPECT_EQ(world.store.clusters.count[host.index], 9U);
    EXPECT_EQ(world.region().pools[pool.index].members, 9U);
}

TEST_F(StrayTest, FoundsOneWhereTheNearestIsTooFar)
{
    stray(8, 4, {5, 2, 2});
    EXPECT_EQ(counts.strays_founding, 1U);
    EXPECT_EQ(world.region().pools[pool.index].clusters, 2U);
}

TEST_F(StrayTest, FoundsOneWhereTheNearestHasTheMaximumSize)
{
    stray(16, 4, {5.9, 2, 2});
    EXPECT_EQ(counts.strays_founding, 1U);
    EXPECT_EQ(world.store.clusters.count[host.index], 16U);
}

TEST_F(StrayTest, FoundsOneWhereTheNearestHasNoRowLeft)
{
    stray(8, 0, {5.9, 2, 2});
    EXPECT_EQ(counts.strays_founding, 1U);
    EXPECT_EQ(world.store.clusters.count[host.index], 8U);
}

// A pool that cannot be divided: 10,000 clusters at one place, and 100 strays.
TEST_F(ReformingTest, StraysLookAtSoManyClustersOfAPoolAtMost)
{
    constexpr std::uint32_t crowd = 10'000, strays = 100;
    const Vector3d place(6, 2, 2);
    for (std::uint64_t id = 1; id <= crowd; ++id)
        world.add({{.position = place, .velocity = {0, 0, 0}, .id = id, .mass = 1}});
    const PoolId pool = locate(world.region(), place);
    world.region().pools[pool.index].turn_frame = 0;
    world.region().pools[pool.index].due_frame = 50;
    const PoolId due = locate_or_grow(world.region(), Vector3d(2, 2, 2));
    for (std::uint64_t id = 1; id <= strays; ++id) {
        const ClusterSlot visitor =
            world.add({{.position = place, .velocity = {0, 0, 0}, .id = crowd + id, .mass = 1}});
        unlink(world.region(), world.store.clusters, visitor);
        link(world.region(), world.store.clusters, due, visitor);
    }
    world.region().pools[due.index].due_frame = 1;
    reforming.update(world.tree, 1, counts);
    EXPECT_EQ(counts.strays_inserted + counts.strays_founding, strays);
    EXPECT_EQ(counts.stray_tests, std::uint64_t{strays} * Reforming::most_candidates);
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST_F(ReformingTest, WhatIsFormedAnewInheritsTheMeanPullOfItsMembers)
{
    reforming.found(world.tree, test::ball(200, 0.9, 0, 1, {2, 2, 2}), 0);
    ClusterTable& clusters = world.store.clusters;
    double sum = 0;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        EXPECT_EQ(clusters.pull[slot], 0); // nothing is known yet
        clusters.pull[slot] = double(slot % 4);
        sum += clusters.count[slot] * clusters.pull[slot];
    }
    for (Pool& pool : world.region().pools)
        pool.due_frame = 3;
    reforming.update(world.tree, 3, counts);
    double inherited = 0;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot))
            continue;
        EXPECT_LE(clusters.pull[slot], 3);
        inherited += clusters.count[slot] * clusters.pull[slot];
    }
    // Members without a pull take the mean of the others in their cluster, so the sum may grow.
    EXPECT_GE(inherited, sum * (1 - 1e-6));
    EXPECT_LE(inherited, 200 * 3);
    EXPECT_GT(sum, 0);
}

TEST_F(ReformingTest, APoolOfNewbornsLivesShortlyUntilTheirTidesAreKnown)
{
    world.add(test::ball(5, 0.5, 0, 1, {2, 2, 2}), 7);
    reforming.update(world.tree, 8, counts);
    const Pool& pool = world.region().pools[locate(world.region(), Vector3d(2, 2, 2)).index];
    EXPECT_EQ(pool.turn_frame, 8U);
    EXPECT_LE(pool.life(), 3U); // the shortest is 2, and ends at its multiples
}

// Tides of 1e-4 ask for lives of 0.2 / (0.01 sqrt(1e-4 sqrt(3))) = 1520 frames: the longest, of 64, in phase.
TEST_F(ReformingTest, PoolsThatAreLaidAnewKeepTheLivesThatTheirTidesAskFor)
{
    reforming.found(world.tree, test::ball(1000, 6, 0, 1), 0);
    for (Symmetric3& tide : world.store.clusters.tide)
        tide = {.xx = 1e-4, .yy = 1e-4, .zz = 1e-4};
    RegionOfInterest everywhere = world.tree.regions[background_row].settings;
    everywhere.partition.bin_by = BinBy::Mass;
    change_region(world.tree, background_row, everywhere, world.store.clusters);
    ASSERT_EQ(world.tree.reinserted, world.store.clusters.alive_count());
    reforming.update(world.tree, 64, counts);
    std::uint64_t pools = 0, lives = 0;
    for (const Pool& pool : world.region().pools) {
        pools += pool.node.valid() && pool.members > 0 ? 1 : 0;
        lives += pool.node.valid() && pool.members > 0 ? pool.life() : 0;
    }
    EXPECT_GT(pools, 30U);
    EXPECT_GT(lives, 16 * pools); // they end at any of 64 frames to come
}

TEST_F(ReformingTest, ClustersAreFormedWithRoomForStrays)
{
    reforming.found(world.tree, test::ball(1000, 3, 0, 1), 0);
    const ClusterTable& clusters = world.store.clusters;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        EXPECT_LE(clusters.count[slot], 14U); // of 16
        EXPECT_GE(clusters.slab[slot].capacity, clusters.count[slot] + 2);
    }
}

} // namespace
} // namespace slod
