#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/random_regions.hpp"
#include "tree/slod_tree.hpp"

namespace slod {
namespace {

const test::RegionDraw any{.by_mass = true, .by_motion = true};

Box random_box(Random& random, double extent, double size)
{
    const Vector3d lower = test::random_point(random, extent);
    return {lower, lower + size * Vector3d(random.uniform(), random.uniform(), random.uniform())};
}

Vector3d point_in(Random& random, const Box& box)
{
    const Vector3d share(random.uniform(), random.uniform(), random.uniform());
    return (box.lower + share.cwiseProduct(box.size())).cwiseMax(box.lower).cwiseMin(box.upper);
}

Subject random_subject(Random& random, const Vector3d& x)
{
    return {x, 2 * random.uniform(), 5 * random.uniform(), 2 * random.uniform()};
}

std::vector<RegionIndex::Entry> random_entries(Random& random, std::size_t count,
                                               const test::RegionDraw& draw)
{
    std::vector<RegionIndex::Entry> entries;
    for (std::size_t i = 0; i < count; ++i)
        entries.push_back({RegionRow(count - i), RegionTest(test::random_region(random, draw))});
    return entries;
}

TEST(RegionTest, MissesAndCoversWhatItContainsNothingOrAllOf)
{
    std::size_t missed = 0, covered = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        Random random(1, 0, i);
        const RegionTest region(test::random_region(random, any));
        const Box box = random_box(random, 10, i % 2 == 0 ? 0.3 : 6);
        const bool misses = region.misses(box), covers = region.covers(box);
        missed += misses;
        covered += covers;
        for (int sample = 0; sample < 16; ++sample) {
            const Subject subject = random_subject(random, point_in(random, box));
            const bool inside = region.contains(subject);
            ASSERT_FALSE(misses && inside) << i;
            ASSERT_FALSE(covers && !inside) << i;
            ASSERT_FALSE(inside && !(subject.position.array() >= region.bounds().lower.array()).all()) << i;
            ASSERT_FALSE(inside && !(subject.position.array() <= region.bounds().upper.array()).all()) << i;
        }
    }
    EXPECT_GT(missed, 5000U);
    EXPECT_GT(covered, 20U);
}

TEST(RegionOfInterest, FollowsClientsWhoseNamesCanBePrinted)
{
    RegionOfInterest region;
    region.follows = "viewer 2, \xc3\xa4";
    EXPECT_EQ(problems(region), Problems{});
    for (const std::string name : {"a\x1b[2J", "a\nb", "\x7f"}) {
        region.follows = name;
        ASSERT_EQ(problems(region).size(), 1U);
        EXPECT_EQ(problems(region)[0].find("follows"), 0U);
    }
}

TEST(RegionOfInterest, IsRefusedWithTheNumberThatIsOutOfRange)
{
    RegionOfInterest region;
    region.precedence = 2'000'000'000;
    region.radius = -1e-31;
    EXPECT_EQ(problems(region),
              (Problems{"precedence = 2e+09 is out of range.", "radius = -1e-31 is out of range."}));
}

/// Sets the `wanted`-th of a region's numbers to one end of its range; false when there is none.
struct Extreme {
    int wanted;
    bool largest;
    bool set = false;

    void operator()(const Field& field, double& value)
    {
        if (wanted-- == 0) {
            value = std::clamp(largest ? field.maximum : field.minimum, -1e308, 1e308);
            set = true;
        }
    }
    void operator()(const Field& field, Vector3d& value)
    {
        if (wanted-- == 0) {
            value.setConstant(std::clamp(largest ? field.maximum : field.minimum, -1e308, 1e308));
            set = true;
        }
    }
    template <class Other>
    void operator()(const Field&, const Other&)
    {}
};

TEST(SlodTree, TakesEveryRegionThatHasNoProblemsHoweverExtremeItsNumbers)
{
    int taken = 0;
    for (const Shape shape : {Shape::Everywhere, Shape::Box, Shape::Sphere, Shape::Frustum}) {
        for (const bool largest : {false, true}) {
            for (int number = 0;; ++number) {
                RegionOfInterest region;
                region.shape = shape;
                region.up = {0, 1, 0.1};
                Extreme extreme{number, largest};
                for_each_field(region, extreme);
                if (!extreme.set)
                    break;
                if (!problems(region).empty())
                    continue;
                SlodTree tree({}, 1);
                open_region(tree, region);
                settle(tree);
                for (const Vector3d& x :
                     {Vector3d(0, 0, 0), Vector3d(1e30, -1e30, 1e30), Vector3d(0, 0, -1e300)})
                    EXPECT_TRUE(locate_or_grow(tree, x).valid());
                EXPECT_TRUE(locate_or_grow(tree, Vector3d(0, std::nan(""), 0)).valid());
                ++taken;
            }
        }
    }
    EXPECT_GT(taken, 100);
}

/// Moves a region of a tree with some clusters from pose to pose; returns how many were put into cells anew.
template <class Pose>
std::uint64_t reinserted_by(RegionOfInterest region, const Pose& pose)
{
    test::World world({MapKind::Identity, 0, 1}, {}, {}, 16);
    const RegionRow row = open_region(world.tree, region);
    settle(world.tree);
    for (const Particle& particle : test::cube(100, 8, 1)) {
        const ClusterSlot slot = test::form(world.store, {particle});
        const PoolId pool = locate_or_grow(world.tree.subtrees[row], particle.position);
        link(world.tree.subtrees[row], world.store.clusters, pool, slot);
    }
    for (int i = 0; i < 360; ++i) {
        pose(region, i);
        change_region(world.tree, row, region, world.store.clusters);
    }
    return world.tree.reinserted;
}

// The box around it goes from 1.45 to 2.05 times its depth and back, across a power of two for every other
// depth.
TEST(SlodTree, KeepsItsCellsWhileAFrustumTurns)
{
    const auto turned = [](RegionOfInterest& region, int degree) {
        const double angle = degree * std::numbers::pi / 180;
        region.direction = {std::cos(angle), 0.3 * std::sin(3 * angle), std::sin(angle)};
    };
    for (const double depth : {4.0, 5.0, 6.0, 7.0}) {
        RegionOfInterest region;
        region.shape = Shape::Frustum;
        region.far_distance = depth;
        EXPECT_EQ(reinserted_by(region, turned), 0U) << depth;
    }
}

// (x + h) - (x - h) is not 2 h for every x, and 2 h here is a power of two.
TEST(SlodTree, KeepsItsCellsWhileABoxMoves)
{
    const auto moved = [](RegionOfInterest& region, int i) { region.centre.x() = 0.1 * i - 18; };
    RegionOfInterest region;
    region.shape = Shape::Box;
    region.half_extent = {4, 1, 1};
    EXPECT_EQ(reinserted_by(region, moved), 0U);
}

TEST(SlodTree, LaysCellsAnewOnceWhereARegionGrowsFourfold)
{
    const auto grown = [](RegionOfInterest& region, int i) { region.radius = 3 * (1 + i / 120.0); };
    RegionOfInterest region;
    region.shape = Shape::Sphere;
    region.radius = 3;
    EXPECT_EQ(reinserted_by(region, grown), 100U);
}

TEST(RegionIndex, FindsWhatALookAtAllRegionsFinds)
{
    for (const std::size_t count : {0U, 1U, 5U, 9U, 60U, 1000U}) {
        Random random(2, 0, count);
        RegionIndex index;
        index.assign(random_entries(
            random, count, {.size = 1.5, .everywhere = count < 60, .by_mass = true, .by_motion = true}));
        std::size_t elsewhere = 0;
        for (int sample = 0; sample < 20'000; ++sample) {
            const Subject subject = random_subject(random, test::random_point(random, 12));
            const RegionRow row = index.find(subject);
            ASSERT_EQ(row, test::region_by_turns(index.entries(), subject)) << count;
            elsewhere += row != background_row;
        }
        if (count >= 60) {
            EXPECT_GT(elsewhere, 0U);
        }
    }
}

TEST(RegionIndex, AsksNoRegionThatComesAfterTheAnswer)
{
    for (const std::size_t count : {6U, 1000U}) {
        Random random(3, 0, count);
        RegionIndex index;
        index.assign(random_entries(random, count, {.size = 1.0, .everywhere = false}));
        std::uint64_t asked = 0;
        for (int sample = 0; sample < 10'000; ++sample) {
            std::uint64_t tests = 0;
            const RegionRow row = index.find(test::random_point(random, 12), &tests);
            // Rows count down from the number of regions, so the first in order has rank 0.
            const std::size_t rank = row == background_row ? count : count - row;
            ASSERT_LE(tests, rank + 1);
            if (count == 6) {
                ASSERT_EQ(tests, std::min<std::uint64_t>(rank + 1, count)); // sequentially, as in the paper
            }
            asked += tests;
        }
        // A thousand regions of a few per mille of the space each: a point is near some of them.
        if (count == 1000) {
            EXPECT_LT(asked, 10'000 * 60U);
        }
    }
}

TEST(RegionIndex, CallsEveryBoxContestedThatHoldsAnythingOfAnother)
{
    std::size_t quiet = 0;
    for (const std::size_t count : {3U, 40U}) {
        Random random(4, 0, count);
        RegionIndex index;
        index.assign(random_entries(random, count, {.size = 2, .everywhere = false, .by_mass = true}));
        for (int sample = 0; sample < 5000; ++sample) {
            const Box box = random_box(random, 12, 1);
            const Subject there = random_subject(random, point_in(random, box));
            const RegionRow owner = index.find(there);
            if (index.contested(box, owner))
                continue;
            ++quiet;
            for (int other = 0; other < 16; ++other)
                ASSERT_EQ(index.find(random_subject(random, point_in(random, box))), owner);
        }
    }
    EXPECT_GT(quiet, 1000U);
}

} // namespace
} // namespace slod
