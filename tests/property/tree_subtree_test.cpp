#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

constexpr int seeds = 64;
constexpr std::size_t cluster_count = 200;

/// A world of single particles in a ball of ten cells across, whose tree is divided and merged at random.
class RandomTree {
public:
    explicit RandomTree(std::uint64_t seed) : random_(seed, 5, 0)
    {
        for (const Particle& particle : test::ball(cluster_count, 5, 0, seed))
            world.add({particle});
    }

    test::World world{{MapKind::Identity, 0, 1}, {}, {.max_cluster_size = 4, .pool_factor = 4}, 1.0};

    Vector3d random_place() { return test::point_in_ball(random_, 6); }

    void change()
    {
        Subtree& tree = world.region();
        const PoolId pool = locate(tree, random_place());
        if (!pool.valid())
            return;
        if (random_.bits() % 3 != 0 && can_expand(tree, pool)) {
            const Box box = tree.nodes[tree.pools[pool.index].node.index].box;
            const int axis = int(random_.bits() % 3);
            const double position = box.lower[axis] + (0.1 + 0.8 * random_.uniform()) * box.size()[axis];
            if (box.lower[axis] < position && position < box.upper[axis])
                expand(tree, world.store.clusters, pool, axis, position);
        } else {
            prune(tree, world.store.clusters, pool, random_.bits() % 20);
        }
    }

    PoolId random_pool()
    {
        const Subtree& tree = world.region();
        for (;;) {
            const PoolId pool{random_.bits() % std::uint32_t(tree.pools.size())};
            if (tree.pools[pool.index].node.valid())
                return pool;
        }
    }

private:
    Random random_;
};

/// The pool of the one leaf whose box holds x, found by looking at all leaves; invalid without one.
PoolId find_leaf(const Subtree& tree, const Vector3d& x)
{
    PoolId found;
    for (std::uint32_t pool = 0; pool < tree.pools.size(); ++pool) {
        const NodeId node = tree.pools[pool].node;
        if (!node.valid() || !tree.nodes[node.index].box.contains(x))
            continue;
        EXPECT_FALSE(found.valid()) << "two leaves hold the same place";
        found = {pool};
    }
    return found;
}

TEST(Subtree, StaysSoundUnderRandomDivisionsAndMergers)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(seed);
        RandomTree tree(seed);
        for (int change = 0; change < 300; ++change) {
            tree.change();
            if (change % 30 == 0) {
                ASSERT_EQ(problems(tree.world.tree, tree.world.store.clusters), Problems{})
                    << "change " << change;
            }
        }
        EXPECT_EQ(problems(tree.world.tree, tree.world.store.clusters), Problems{});
    }
}

TEST(Subtree, LocatesByDescendingAndByClimbingWhatALookAtAllLeavesFinds)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(seed);
        RandomTree tree(seed);
        for (int change = 0; change < 200; ++change)
            tree.change();
        const Subtree& region = tree.world.region();
        for (int probe = 0; probe < 100; ++probe) {
            const Vector3d x = tree.random_place();
            const PoolId expected = find_leaf(region, x);
            ASSERT_EQ(locate(region, x), expected);
            ASSERT_EQ(locate_near(region, tree.random_pool(), x), expected);
        }
    }
}

// Whatever was divided, with nothing else done, merges back into one pool per cell.
TEST(Subtree, PruningEverythingUndoesEveryDivision)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(seed);
        RandomTree tree(seed);
        for (int change = 0; change < 200; ++change)
            tree.change();
        Subtree& region = tree.world.region();
        for (int round = 0; round < 64; ++round)
            for (std::uint32_t pool = 0; pool < region.pools.size(); ++pool)
                if (region.pools[pool].node.valid())
                    prune(region, tree.world.store.clusters, {pool}, 1'000'000);
        EXPECT_EQ(region.pool_count(), region.cells.size());
        EXPECT_EQ(problems(tree.world.tree, tree.world.store.clusters), Problems{});
        for (std::uint32_t slot = 0; slot < cluster_count; ++slot)
            EXPECT_EQ(tree.world.store.clusters.pool[slot],
                      locate(region, tree.world.store.clusters.position[slot]));
    }
}

} // namespace
} // namespace slod
