#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "gravity/force_view.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

/// Clusters of a few particles in a ball of several cells, which are divided further at random.
test::World random_world(std::uint64_t seed)
{
    test::World world({MapKind::Scalar, 0, 0.1}, {.masses = true, .kinds = true}, {.max_cluster_size = 16},
                      2);
    Random random(seed, 3, 0);
    for (std::uint64_t i = 0; i < 150; ++i) {
        ParticleSet particles =
            test::ball(1 + i % 5, 0.3, 1, 1000 * seed + i, test::point_in_ball(random, 5));
        for (Particle& particle : particles) {
            particle.mass = i % 7 == 0 ? 0.0F : float(random.uniform());
            particle.kind = std::uint8_t(i % 3);
        }
        world.add(particles);
    }
    for (int i = 0; i < 60; ++i) {
        const PoolId pool = locate(world.region(), test::point_in_ball(random, 5));
        if (!pool.valid() || !can_expand(world.region(), pool))
            continue;
        const Box box = world.region().nodes[world.region().pools[pool.index].node.index].box;
        const int axis = int(random.bits() % 3);
        expand(world.region(), world.store.clusters, pool, axis, 0.5 * (box.lower[axis] + box.upper[axis]));
    }
    return world;
}

ForceView view_of(test::World& world, const GravitySettings& gravity = {})
{
    ForceView view;
    measure_shapes(world.store, gravity, 1, 5);
    build(view, world.tree, world.store.clusters, gravity);
    return view;
}

TEST(ForceView, IsSoundAndHoldsEachClusterOnce)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        test::World world = random_world(seed);
        const ForceView view = view_of(world);
        EXPECT_EQ(problems(view, world.store.clusters), Problems{});
        std::set<std::uint32_t> slots;
        for (const ClusterSlot slot : view.slot)
            slots.insert(slot.index);
        EXPECT_EQ(slots.size(), 150U);
        EXPECT_EQ(view.body_count(), 150U);
    }
}

// Cells beyond 2^20 share a code, as do the bins of one cell.
TEST(ForceView, ARegionHasOneRootWhereCellsShareACode)
{
    for (const BinBy bin_by : {BinBy::None, BinBy::Mass}) {
        test::World world({MapKind::Scalar, 0, 0.1}, {}, {.bin_by = bin_by}, 1);
        for (std::uint64_t i = 1; i <= 5; ++i) {
            const double x = bin_by == BinBy::None ? 2e6 + double(i) : 0.5;
            world.add({{.position = {x, 0, 0}, .velocity = {0, 0, 0}, .id = i, .mass = std::exp2(float(i))}});
        }
        EXPECT_EQ(world.region().cells.size(), 5U);
        const ForceView view = view_of(world);
        EXPECT_EQ(problems(view, world.store.clusters), Problems{});
        EXPECT_EQ(view.nodes.size(), 9U); // halved until each is one
        EXPECT_EQ(view.nodes.front().count, 5U);
    }
}

// However many cells share a code.
TEST(ForceView, HasNoNodeOfMoreThanEightParts)
{
    test::World world({MapKind::Scalar, 0, 0.1}, {}, {}, 1);
    for (std::uint64_t i = 0; i < 1000; ++i)
        world.add({{.position = {2e6 + double(i), 0, 0}, .velocity = {0, 0, 0}, .id = i, .mass = 1}});
    const ForceView view = view_of(world);
    EXPECT_EQ(problems(view, world.store.clusters), Problems{});
    for (std::uint32_t node = 0; node < view.nodes.size(); ++node) {
        int parts = 0;
        for (std::uint32_t part = node + 1; part < view.nodes[node].next; part = view.nodes[part].next)
            ++parts;
        EXPECT_LE(parts, 8) << node;
    }
}

// A path of k-d nodes each of which holds nothing on one side, as what moves away leaves behind.
TEST(ForceView, HasNoNodeForWhatHoldsNothing)
{
    test::World world({MapKind::Scalar, 0, 0.1}, {}, {}, 16);
    for (std::uint64_t i = 0; i < 2; ++i)
        world.add({{.position = {0.5 + double(i), 0.5, 0.5}, .velocity = {0, 0, 0}, .id = i, .mass = 1}});
    for (double at = 8; at >= 1; at /= 2)
        expand(world.region(), world.store.clusters, locate(world.region(), Vector3d(0.5, 0.5, 0.5)), 0, at);
    const PoolId far_off = locate_or_grow(world.region(), Vector3d(40, 0.5, 0.5));
    expand(world.region(), world.store.clusters, far_off, 0, 40);
    const ForceView view = view_of(world);
    EXPECT_EQ(view.nodes.size(), 3U);
    EXPECT_EQ(problems(view, world.store.clusters), Problems{});
}

TEST(ForceView, ABodyIsItsClustersCentreMassSizeAndSoftening)
{
    test::World world = random_world(1);
    const ForceView view = view_of(world, {.size_softening = 0.3});
    const ClusterTable& clusters = world.store.clusters;
    for (std::size_t body = 0; body < view.body_count(); ++body) {
        const std::size_t slot = view.slot[body].index;
        EXPECT_EQ(view.position(body), clusters.position[slot]);
        EXPECT_EQ(view.mass[body], clusters.mass(slot));
        EXPECT_EQ(view.q[body],
                  0.5 * double(clusters.softening_squared[slot]) + 0.3 * clusters.variance[slot]);
    }
}

// Sums over up to 150 bodies, two levels of rounding per level of the tree.
TEST(ForceView, ANodeHasTheMassAndCentreOfItsBodiesAndBoundsThem)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        test::World world = random_world(seed);
        const ForceView view = view_of(world);
        for (const ForceView::Node& node : view.nodes) {
            double mass = 0;
            Vector3d by_mass{0, 0, 0}, by_number{0, 0, 0};
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body) {
                mass += view.mass[body];
                by_mass += view.mass[body] * view.position(body);
                by_number += view.position(body) / node.count;
            }
            EXPECT_NEAR(node.mass, mass, 1e-13 * mass);
            const Vector3d centre = mass > 0 ? Vector3d(by_mass / mass) : by_number;
            EXPECT_LE((node.centre - centre).norm(), 1e-12);
            double q = 0, variance = 0;
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
                q += (mass > 0 ? view.mass[body] / mass : 1.0 / node.count) * view.q[body];
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
                variance += mass > 0 ? view.mass[body] / mass * std::pow(view.q[body] - q, 2) : 0;
            EXPECT_NEAR(node.q, q, 1e-13 * q);
            double spread = 0;
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
                spread = std::max(spread, std::abs(view.q[body] - q));
            EXPECT_GE(double(node.q_spread), spread * (1 - 1e-12)) << "sums of inner nodes are bounds";
            // Float, rounded up by up to 2^-22 at each of the ten levels, in a fourth root.
            EXPECT_NEAR(double(node.blur), std::pow(15.0 / 8 * variance, 0.25), 1e-5 * std::sqrt(q));
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
                EXPECT_LE((view.position(body) - node.centre).norm(), node.radius + 1e-14);
            EXPECT_LE(node.radius, 2 * 5.1 * std::sqrt(3.0));
        }
        ASSERT_EQ(view.nodes.front().count, 150U);
    }
}

// Sums of up to 150 terms, some ten levels of the tree, over places below 10 that are rounded to 1e-15.
TEST(ForceView, ANodesSecondMomentsAreThoseOfItsBodies)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        test::World world = random_world(seed);
        const ForceView view = view_of(world, {.multipoles = Multipoles::Quadrupole});
        ASSERT_EQ(view.second_moments.size(), view.nodes.size());
        for (std::size_t index = 0; index < view.nodes.size(); ++index) {
            const ForceView::Node& node = view.nodes[index];
            Matrix3d sum = Matrix3d::Zero();
            for (std::uint32_t body = node.first; body < node.first + node.count; ++body) {
                const Vector3d offset = view.position(body) - node.centre;
                sum += view.mass[body] * offset * offset.transpose();
            }
            EXPECT_LE((node.mass * view.second_moments[index].matrix() - sum).norm(),
                      1e-12 * (1 + sum.norm()));
        }
    }
}

TEST(ForceView, HasNoSecondMomentsUnlessTheyAreAskedFor)
{
    test::World world = random_world(1);
    ForceView view = view_of(world, {.multipoles = Multipoles::Quadrupole});
    EXPECT_FALSE(view.second_moments.empty());
    build(view, world.tree, world.store.clusters, {.multipoles = Multipoles::Monopole});
    EXPECT_TRUE(view.second_moments.empty());
    EXPECT_EQ(view_of(world, {.multipoles = Multipoles::Monopole}).second_moments.capacity(), 0U);
}

TEST(ForceView, NoNodeIsEmptyOrTheSameAsItsOnlyChild)
{
    test::World world = random_world(2);
    const ForceView view = view_of(world);
    for (std::size_t node = 0; node + 1 < view.nodes.size(); ++node) {
        EXPECT_GT(view.nodes[node].count, 0U);
        if (view.nodes[node].next > node + 1) {
            EXPECT_LT(view.nodes[node + 1].count, view.nodes[node].count);
        }
    }
}

TEST(ForceView, CellsFarBeyondTheMortonCodesAreHeldAsWell)
{
    test::World world({MapKind::Identity, 0, 1}, {}, {}, 1e-6);
    for (const double x : {-1e12, -3e3, -1.0, 0.0, 1e-7, 2e-6, 1.0, 5.0, 1e4, 1e300})
        world.add({{.position = {x, 0, -x}, .velocity = {0, 0, 0}, .id = 1, .mass = 1}});
    const ForceView view = view_of(world);
    EXPECT_EQ(problems(view, world.store.clusters), Problems{});
    EXPECT_EQ(view.body_count(), 10U);
}

TEST(ForceView, AnEmptyTreeHasAnEmptyView)
{
    test::World world({MapKind::Identity, 0, 1}, {}, {}, 1);
    const ForceView view = view_of(world);
    EXPECT_EQ(view.body_count() + view.nodes.size(), 0U);
    EXPECT_EQ(problems(view, world.store.clusters), Problems{});
}

TEST(ForceViewProblems, AreFoundWhenANodeIsWrong)
{
    test::World world = random_world(3);
    const ForceView sound = view_of(world);
    ForceView broken = sound;
    broken.nodes[0].count -= 1;
    EXPECT_FALSE(problems(broken, world.store.clusters).empty());
    broken = sound;
    broken.nodes.back().first += 1;
    EXPECT_FALSE(problems(broken, world.store.clusters).empty());
    broken = sound;
    broken.slot.pop_back();
    EXPECT_FALSE(problems(broken, world.store.clusters).empty());
    broken = sound;
    broken.second_moments.resize(1);
    EXPECT_FALSE(problems(broken, world.store.clusters).empty());
}

// A homogeneous ball pulls its members to the centre with -G m / R^3 times their offset. The variance of n
// points has the relative sampling error 0.44 / sqrt(n), its power 3/2 that times 3/2; four of those.
TEST(MeasureShapes, TheClosureIsTheSelfGravityOfAHomogeneousBall)
{
    constexpr std::size_t count = 20'000;
    constexpr double radius = 2;
    constexpr double G = 3;
    test::World world({MapKind::Full, 0, 1}, {}, {}, 8);
    world.store.kind_softening_squared = {0};
    const ClusterSlot slot = world.add(test::ball(count, radius, 0, 1));
    measure_shapes(world.store, {}, G, 0);
    const double expected = G * count / std::pow(radius, 3);
    EXPECT_NEAR(world.store.clusters.closure[slot.index] / expected, 1,
                4 * 1.5 * 0.44 / std::sqrt(double(count)));
    EXPECT_NEAR(world.store.clusters.variance[slot.index] / (0.6 * radius * radius), 1,
                4 * 0.44 / std::sqrt(double(count)));
}

// Few members: their variance is too small by (n - 1) / n in the mean over many clusters.
TEST(MeasureShapes, TheRadiusIsNotBiasedBySmallNumbers)
{
    for (const std::size_t count : {2U, 3U, 8U}) {
        constexpr int trials = 20'000;
        test::World world({MapKind::Full, 0, 1}, {.masses = false}, {}, 8);
        world.store.kind_softening_squared = {0};
        double mean = 0;
        for (int trial = 0; trial < trials; ++trial) {
            const ClusterSlot slot = test::form(world.store, test::ball(count, 1, 0, std::uint64_t(trial)));
            measure_shapes(world.store, {}, 1, 0);
            // closure = n / R^3, so R^2 = (n / closure)^(2/3)
            mean += std::pow(double(count) / world.store.clusters.closure[slot.index], 2.0 / 3.0) / trials;
            world.store.members.retire(world.store.clusters.slab[slot.index], 0);
            world.store.members.recycle(1);
            world.store.clusters.free_slot(slot);
        }
        // The squared radius of n points scatters by less than itself.
        EXPECT_NEAR(mean, 1, 5 / std::sqrt(double(trials))) << count;
    }
}

TEST(MeasureShapes, SofteningWeakensTheClosure)
{
    test::World world({MapKind::Full, 0, 1}, {}, {}, 8);
    world.store.kind_softening_squared = {9};
    const ClusterSlot slot = world.add(test::ball(500, 2, 0, 1));
    measure_shapes(world.store, {}, 1, 0);
    const double s = world.store.clusters.variance[slot.index];
    EXPECT_DOUBLE_EQ(world.store.clusters.closure[slot.index],
                     500 / std::pow(5.0 / 3.0 * s * 500.0 / 499.0 + 9, 1.5));
    measure_shapes(world.store, {.closure = false}, 1, 0);
    EXPECT_EQ(world.store.clusters.variance[slot.index], s);
    EXPECT_EQ(world.store.clusters.closure[slot.index], 0) << "switched off";
}

TEST(MeasureShapes, SingleMasslessAndCoincidentMembersHaveNoClosure)
{
    test::World world({MapKind::Full, 0, 1}, {}, {}, 8);
    world.store.kind_softening_squared = {0};
    ParticleSet massless = test::ball(5, 1, 0, 1);
    for (Particle& particle : massless)
        particle.mass = 0;
    const ClusterSlot one = world.add(test::ball(1, 1, 0, 1));
    const ClusterSlot light = world.add(massless);
    const ClusterSlot coincident = world.add(test::ball(5, 0, 0, 1));
    measure_shapes(world.store, {}, 1, 0);
    for (const ClusterSlot slot : {one, light, coincident})
        EXPECT_EQ(world.store.clusters.closure[slot.index], 0);
    EXPECT_GT(world.store.clusters.variance[light.index], 0.1); // they have a size all the same
    EXPECT_EQ(world.store.clusters.variance[one.index] + world.store.clusters.variance[coincident.index], 0);
}

TEST(MeasureShapes, FollowTheMap)
{
    const MapRule rule{MapKind::Scalar, 0, 0.5};
    test::World world(rule, {}, {}, 8);
    ParticleSet particles = test::ball(100, 1, 0, 1);
    for (Particle& particle : particles)
        particle.velocity = particle.position; // expands as 1 + t
    const ClusterSlot slot = world.add(particles);
    measure_shapes(world.store, {}, 1, 0);
    const double then = world.store.clusters.variance[slot.index];
    measure_shapes(world.store, {}, 1, 4);
    EXPECT_NEAR(world.store.clusters.variance[slot.index] / then, 9, 9 * 4 * 0x1p-24); // t = 2
}

} // namespace
} // namespace slod
