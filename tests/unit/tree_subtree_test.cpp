#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

const MapRule rigid{MapKind::Identity, 0, 1};

/// A world of single particles, uniform in a ball, in cells of side `cell_side`.
test::World world_of(std::size_t count, double radius, double cell_side)
{
    test::World world(rigid, {}, {.max_cluster_size = 4, .pool_factor = 4}, cell_side);
    for (const Particle& particle : test::ball(count, radius, 0, 1))
        world.add({particle});
    return world;
}

TEST(CellOf, N18_TakesTheFloorOnBothSidesOfZero)
{
    const test::World world(rigid, {}, {}, 2.0);
    const auto x = [&](double value) {
        return cell_of(world.tree.subtrees.front(), Vector3d(value, 0, 0)).x;
    };
    const std::pair<double, std::int32_t> places[] = {
        {0.0, 0},     {-0.0, 0},     {1e-300, 0},
        {-1e-17, -1}, {-5e-324, -1}, {std::nextafter(2.0, 0.0), 0},
        {2.0, 1},     {-2.0, -1},    {std::nextafter(-2.0, -3.0), -2}};
    int wrong = 0;
    for (const auto& [place, cell] : places) {
        EXPECT_EQ(x(place), cell) << place;
        wrong += x(place) == cell ? 0 : 1;
    }
    test::expect_at_most("places in a wrong cell", wrong, 0);
}

TEST(CellOf, N18_PutsWhatIsBeyondTheGridIntoTheCellsAtItsRim)
{
    int wrong = 0;
    const test::World world(rigid, {}, {}, 1e-3);
    constexpr std::int32_t rim = 1 << 30;
    for (const double far : {2e6, 1e12, 1e300, std::numeric_limits<double>::max()}) {
        const Cell cell = cell_of(world.tree.subtrees.front(), Vector3d(far, -far, 0));
        EXPECT_EQ(cell, (Cell{rim, -rim, 0})) << far;
        wrong += cell == Cell{rim, -rim, 0} ? 0 : 1;
    }
    test::expect_at_most("places in a wrong cell", wrong, 0);
}

TEST(CellOf, PutsAllAboveTheLastEdgeOfSixtyFourIntoOneBin)
{
    const test::World world(rigid, {}, {.bin_by = BinBy::Mass, .bin_floor = 2, .bin_ratio = 1.01}, 1.0);
    const auto bin = [&](double mass) {
        return cell_of(world.tree.subtrees.front(), {Vector3d(0, 0, 0), mass}).bin;
    };
    EXPECT_EQ(bin(0), 0);
    EXPECT_EQ(bin(1.99), 0);
    EXPECT_EQ(bin(2), 1);
    EXPECT_EQ(bin(2 * std::pow(1.01, 61.5)), 62);
    EXPECT_EQ(bin(2 * std::pow(1.01, 62.5)), 63);
    EXPECT_EQ(bin(2 * std::pow(1.01, 63.5)), most_bins);
    EXPECT_EQ(bin(1e30), most_bins);
}

// 0.1 and 0.3 are no binary fractions: at many faces the rounded quotient falls on the wrong side.
TEST(CellOf, N18_AgreesWithTheCellsBoxAtEveryFace)
{
    int outside = 0;
    for (const double side : {0.1, 0.3, 1e-7, 3e11}) {
        test::World world(rigid, {}, {}, side);
        for (int face = -300; face <= 300; ++face) {
            for (const double x :
                 {face * side, std::nextafter(face * side, -1e300), std::nextafter(face * side, 1e300)}) {
                const PoolId pool = locate_or_grow(world.region(), Vector3d(x, 0, 0));
                const Box& box = world.region().nodes[world.region().pools[pool.index].node.index].box;
                outside += box.contains({x, 0, 0}) ? 0 : 1;
                ASSERT_EQ(outside, 0) << "side " << side << " face " << face;
            }
        }
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
    test::expect_at_most("places outside of their cell's box", outside, 0);
}

TEST(Subtree, ACellIsThereOnlyOnceAskedFor)
{
    test::World world(rigid, {}, {}, 1);
    const Vector3d x{3.5, -2.5, 0.5};
    EXPECT_FALSE(locate(world.region(), x).valid());
    const PoolId pool = locate_or_grow(world.region(), x);
    EXPECT_EQ(locate(world.region(), x), pool);
    EXPECT_EQ(locate_or_grow(world.region(), x), pool);
    EXPECT_FALSE(locate(world.region(), Vector3d(4.5, -2.5, 0.5)).valid());
    EXPECT_EQ(world.region().pool_count(), 1U);
}

TEST(Subtree, ExpandingDividesClustersByTheirCentre)
{
    test::World world = world_of(100, 1, 4);
    Subtree& tree = world.region();
    const PoolId left = locate(tree, Vector3d(0.1, 0.1, 0.1));
    const std::uint32_t before = tree.pools[left.index].clusters;
    const PoolId right = expand(tree, world.store.clusters, left, 0, 0.25);
    for (const auto& [pool, is_right] : {std::pair(left, false), std::pair(right, true)})
        for (ClusterSlot slot = tree.pools[pool.index].first; slot.valid();
             slot = world.store.clusters.next[slot.index])
            EXPECT_EQ(world.store.clusters.position[slot.index].x() >= 0.25, is_right);
    EXPECT_GT(tree.pools[right.index].clusters, 0U);
    EXPECT_EQ(tree.pools[left.index].clusters + tree.pools[right.index].clusters, before);
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST(Subtree, BothHalvesOfAnExpandedPoolKeepItsTurnUntilOneTakesItsOwn)
{
    test::World world = world_of(100, 1, 4);
    Subtree& tree = world.region();
    const PoolId left = locate(tree, Vector3d(0.1, 0.1, 0.1));
    tree.pools[left.index].turn_frame = 7;
    tree.pools[left.index].due_frame = 15;
    const PoolId right = expand(tree, world.store.clusters, left, 1, 1.0);
    EXPECT_EQ(tree.pools[right.index].turn_frame, 7U);
    EXPECT_EQ(tree.pools[right.index].due_frame, 15U);
    EXPECT_EQ(tree.pools[right.index].phase, tree.pools[left.index].phase);
    take_own_turn(tree, right);
    EXPECT_NE(tree.pools[right.index].phase, tree.pools[left.index].phase);
}

TEST(Subtree, PruningUndoesExpanding)
{
    test::World world = world_of(100, 1, 4);
    Subtree& tree = world.region();
    const PoolId pool = locate(tree, Vector3d(0.1, 0.1, 0.1));
    const std::uint32_t members = tree.pools[pool.index].members;
    const PoolId right = expand(tree, world.store.clusters, pool, 0, 0.3);
    expand(tree, world.store.clusters, right, 1, 0.3);
    expand(tree, world.store.clusters, right, 2, 0.3);
    const PoolId kept = prune(tree, world.store.clusters, right, 1000);
    EXPECT_EQ(locate(tree, Vector3d(0.1, 0.1, 0.1)), kept);
    EXPECT_EQ(tree.pools[kept.index].members, members);
    EXPECT_EQ(tree.pool_count(), tree.cells.size());
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

TEST(Subtree, PruningLeavesPoolsThatTogetherHoldEnough)
{
    test::World world = world_of(100, 1, 4);
    Subtree& tree = world.region();
    const PoolId pool = locate(tree, Vector3d(0.1, 0.1, 0.1));
    const std::uint32_t members = tree.pools[pool.index].members;
    const std::size_t pools = tree.pool_count();
    expand(tree, world.store.clusters, pool, 0, 0.3);
    prune(tree, world.store.clusters, pool, members);
    EXPECT_EQ(tree.pool_count(), pools + 1);
    prune(tree, world.store.clusters, pool, members + 1);
    EXPECT_EQ(tree.pool_count(), pools);
}

TEST(Subtree, AnEmptyCellGoesWhenItIsPruned)
{
    test::World world(rigid, {}, {}, 1);
    Subtree& tree = world.region();
    for (const double x : {-1e300, -7.3, 0.5, 1e300}) {
        const PoolId pool = locate_or_grow(tree, Vector3d(x, 0, 0));
        EXPECT_FALSE(prune(tree, world.store.clusters, pool, 16).valid());
        EXPECT_FALSE(locate(tree, Vector3d(x, 0, 0)).valid()) << x;
    }
    EXPECT_EQ(tree.cells.size(), 0U);
    EXPECT_EQ(tree.pool_count(), 0U);
}

// Far from the origin the coordinates themselves are coarse: a box is not divided below their resolution.
TEST(Subtree, ALeafCanBeDividedUntilItIsAsThinAsItsCoordinatesResolve)
{
    for (const double place : {0.0, 1e7, 1e12, 1e300}) {
        test::World world(rigid, {}, {}, 1);
        Subtree& tree = world.region();
        const PoolId pool = locate_or_grow(tree, Vector3d(place, place, place));
        int divisions = 0;
        for (; can_expand(tree, pool); ++divisions) {
            const Box box = tree.nodes[tree.pools[pool.index].node.index].box;
            const int axis = box.longest_side();
            expand(tree, world.store.clusters, pool, axis, box.lower[axis] + 0.2 * box.size()[axis]);
        }
        EXPECT_LE(divisions, 64) << "at " << place;
        EXPECT_GE(divisions, place > 1e10 ? 0 : 10) << "at " << place;
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{}) << "at " << place;
    }
}

/// What must be found when one thing is wrong in an otherwise sound world.
class SubtreeProblems : public testing::Test {
protected:
    SubtreeProblems()
    {
        const PoolId pool = locate(tree(), Vector3d(0.1, 0.1, 0.1));
        right = expand(tree(), world.store.clusters, pool, 0, 0.3);
        slot = tree().pools[right.index].first;
    }

    Subtree& tree() { return world.region(); }
    std::size_t found() { return problems(world.tree, world.store.clusters).size(); }

    test::World world = world_of(100, 1, 4);
    PoolId right;
    ClusterSlot slot;
};

TEST_F(SubtreeProblems, AreNoneInASoundTree)
{
    EXPECT_EQ(found(), 0U);
}

TEST_F(SubtreeProblems, AreFoundInAWrongCountOfClustersOrMembers)
{
    ++tree().pools[right.index].members;
    EXPECT_EQ(found(), 1U);
    --tree().pools[right.index].members;
    --tree().pools[right.index].clusters;
    EXPECT_GE(found(), 1U);
}

TEST_F(SubtreeProblems, AreFoundInAClusterThatNamesAnotherPoolOrRegion)
{
    world.store.clusters.pool[slot.index] = {};
    EXPECT_EQ(found(), 1U);
    world.store.clusters.pool[slot.index] = right;
    world.store.clusters.region[slot.index] = 3;
    EXPECT_EQ(found(), 1U);
}

TEST_F(SubtreeProblems, AreFoundInADeadClusterThatIsListedAndAnAliveOneThatIsNot)
{
    world.store.clusters.count[slot.index] = 0;
    EXPECT_GE(found(), 1U);
    world.store.clusters.count[slot.index] = 1;
    unlink(tree(), world.store.clusters, slot);
    EXPECT_EQ(found(), 1U);
}

TEST_F(SubtreeProblems, AreFoundInABoxThatIsNotDividedByItsChildren)
{
    tree().nodes[tree().pools[right.index].node.index].box.lower[0] += 0.01;
    EXPECT_EQ(found(), 1U);
}

TEST_F(SubtreeProblems, AreFoundInARootOutsideItsCell)
{
    const NodeId root = tree().cells.find({0, 0, 0});
    tree().nodes[root.index].box.lower[2] += 4;
    tree().nodes[root.index].box.upper[2] += 4;
    EXPECT_GE(found(), 1U);
}

TEST_F(SubtreeProblems, AreFoundInALeafWhosePoolIsAnothers)
{
    tree().pools[right.index].node = tree().cells.find({0, 0, 0});
    EXPECT_EQ(found(), 1U);
}

} // namespace
} // namespace slod
