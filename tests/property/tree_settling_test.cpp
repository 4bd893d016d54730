#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/random_regions.hpp"
#include "tree/regrouping.hpp"

// What the tree does when regions have come, gone or moved.
namespace slod {
namespace {

constexpr std::uint64_t far_off = 99; ///< frame in which all pools are due

/// Single particles in a cube of side 16, in cells of this side, and k-d trees as fine as they ask for.
test::World crowded_world(double cell_side, BinBy bin_by = BinBy::None)
{
    test::World world({MapKind::Identity, 0, 1}, {}, {.max_cluster_size = 1, .bin_by = bin_by}, cell_side);
    ParticleSet particles = test::cube(4000, 8, 1);
    test::give_masses(particles, 0.5, 8, 1);
    for (const Particle& particle : particles)
        world.add({particle});
    Regrouping regrouping({}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 8; ++frame)
        regrouping.update(world.tree, frame, counts);
    for (Pool& pool : world.region().pools)
        pool.due_frame = far_off;
    return world;
}

std::size_t nodes_in_use(const Subtree& tree)
{
    return tree.nodes.size() - tree.free_roots.size() - 2 * tree.free_node_pairs.size();
}

bool meet(const Box& a, const Box& b)
{
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

/// Nodes from `id` downwards are marked where a region may reach into their boxes.
void expect_marked_below(const SlodTree& tree, const Subtree& subtree, NodeId id)
{
    const Node& node = subtree.nodes[id.index];
    for (const RegionIndex::Entry& entry : tree.index.entries())
        if (meet(entry.test.bounds(), node.box) && !entry.test.misses(node.box)) {
            ASSERT_TRUE(node.contested) << node.box.lower.transpose() << " to " << node.box.upper.transpose();
        }
    if (node.leaf())
        return;
    expect_marked_below(tree, subtree, node.left);
    expect_marked_below(tree, subtree, node.right());
}

/// A pool's life ends just where one of the boxes meets its leaf.
void expect_lives_ended_in(const Subtree& subtree, const std::vector<Box>& changed)
{
    for (const Pool& pool : subtree.pools) {
        if (!pool.node.valid())
            continue;
        const Box& leaf = subtree.nodes[pool.node.index].box;
        const bool met =
            std::any_of(changed.begin(), changed.end(), [&](const Box& box) { return meet(box, leaf); });
        ASSERT_EQ(pool.due_frame, met ? 0 : far_off) << leaf.lower.transpose();
    }
}

TEST(Settling, MarksWhatARegionMayReachAndEndsTheLivesWhereOneChanged)
{
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 8, 0);
        test::World world = crowded_world(seed % 2 == 0 ? 16 : 1, seed % 3 == 0 ? BinBy::Mass : BinBy::None);
        std::vector<RegionRow> rows;
        std::vector<RegionOfInterest> regions;
        for (int i = 0; i < 6; ++i) {
            regions.push_back(test::random_region(random, {.extent = 8, .everywhere = false}));
            rows.push_back(open_region(world.tree, regions.back()));
        }
        settle(world.tree);
        for (Pool& pool : world.region().pools)
            pool.due_frame = far_off;
        std::vector<Box> changed{RegionTest(regions[0]).bounds(), RegionTest(regions[1]).bounds()};
        close_region(world.tree, rows[0]);
        regions[1].centre = test::random_point(random, 8);
        change_region(world.tree, rows[1], regions[1], world.store.clusters);
        changed.push_back(RegionTest(regions[1]).bounds());
        settle(world.tree);
        world.region().cells.for_each([&](const Cell&, NodeId root) {
            ASSERT_NO_FATAL_FAILURE(expect_marked_below(world.tree, world.region(), root));
        });
        ASSERT_NO_FATAL_FAILURE(expect_lives_ended_in(world.region(), changed));
    }
}

TEST(Settling, HasNothingToDoWhereARegionIsOnlyToFollowAnotherClient)
{
    test::World world = crowded_world(1);
    RegionOfInterest region;
    region.shape = Shape::Sphere;
    const RegionRow row = open_region(world.tree, region);
    settle(world.tree);
    region.follows = "viewer-2";
    region.view_share = 0.5;
    region.partition.max_cluster_size = 3;
    change_region(world.tree, row, region, world.store.clusters);
    EXPECT_FALSE(world.tree.unsettled);
    EXPECT_EQ(world.tree.regions[row].settings.follows, "viewer-2");
    region.precedence += 1;
    change_region(world.tree, row, region, world.store.clusters);
    EXPECT_TRUE(world.tree.unsettled);
}

// A ball of radius 1/2 is in a few leaves of some 4000 / 16, and so in a few cells of side 1 of 4096.
TEST(Settling, ComparesFewNodesWithARegionThatIsSmall)
{
    for (const double cell_side : {16.0, 1.0}) {
        test::World world = crowded_world(cell_side);
        RegionOfInterest ball;
        ball.shape = Shape::Sphere;
        ball.centre = {4, 4, 4};
        ball.radius = 0.5;
        const RegionRow row = open_region(world.tree, ball);
        settle(world.tree);
        ball.centre.x() += 0.25;
        change_region(world.tree, row, ball, world.store.clusters);
        EXPECT_LT(settle(world.tree), nodes_in_use(world.region()) / 4) << cell_side;
    }
}

RegionOfInterest ball_at(const Vector3d& centre)
{
    RegionOfInterest ball;
    ball.shape = Shape::Sphere;
    ball.centre = centre;
    ball.radius = 1;
    return ball;
}

/// The crowded world with a thousand balls that share its particles, in grids of their own.
struct BallPit {
    static constexpr std::size_t balls = 1000;

    BallPit()
    {
        Random random(5, 8, 0);
        for (std::size_t i = 0; i < balls; ++i) {
            regions.push_back(ball_at(test::random_point(random, 8)));
            regions.back().partition.max_breadth = 0.5;
            rows.push_back(open_region(world.tree, regions.back()));
        }
        settle(world.tree);
        UpdateCounts counts;
        Regrouping({}, world.context(8)).update(world.tree, 9, counts);
    }

    void move(std::size_t ball)
    {
        regions[ball].centre.x() += 0.1;
        change_region(world.tree, rows[ball], regions[ball], world.store.clusters);
    }

    test::World world = crowded_world(1);
    std::vector<RegionOfInterest> regions;
    std::vector<RegionRow> rows;
};

// What a change is compared with does not depend on the others, but that few of them are not worth halving
// the cells for: so the cost of many is at most in proportion. If each were compared with each region's
// cells, a thousand would cost a hundred times a hundred.
TEST(Settling, CostsInProportionToTheRegionsThatMove)
{
    BallPit pit;
    std::vector<std::uint64_t> compared;
    for (const std::size_t moving : {10U, 100U, 1000U}) {
        for (std::size_t ball = 0; ball < moving; ++ball)
            pit.move(ball);
        compared.push_back(settle(pit.world.tree));
    }
    EXPECT_LT(compared[1], 11 * compared[0]);
    EXPECT_LT(compared[2], 11 * compared[1]);
}

// Two boxes, where it was and where it is, are compared with each node and each half of the cells, of which
// there are as many as nodes at most; where they make few changes more than few, small ones are too: half as
// much again.
TEST(Settling, ComparesEachNodeOnceWithARegionThatIsEverywhereAmongManySmallOnes)
{
    BallPit pit;
    std::size_t nodes = 0;
    for (const Subtree& subtree : pit.world.tree.subtrees)
        nodes += nodes_in_use(subtree);
    for (std::size_t ball = 0; ball < pit.balls; ++ball)
        pit.move(ball);
    const std::uint64_t small = settle(pit.world.tree);
    RegionOfInterest large = ball_at({0, 0, 0});
    large.radius = 100;
    const RegionRow row = open_region(pit.world.tree, large);
    settle(pit.world.tree);
    for (std::size_t ball = 0; ball < pit.balls; ++ball)
        pit.move(ball);
    large.centre.x() += 0.25;
    change_region(pit.world.tree, row, large, pit.world.store.clusters);
    const std::uint64_t both = settle(pit.world.tree);
    EXPECT_LT(both, small + 6 * nodes);
}

} // namespace
} // namespace slod
