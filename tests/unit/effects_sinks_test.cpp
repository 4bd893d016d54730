#include <cmath>

#include <gtest/gtest.h>

#include "cluster/conserved.hpp"
#include "core/random.hpp"
#include "effects/draining.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"

// Where sinks are, and what they leave of clusters.
namespace slod {
namespace {

SinkSettings plane()
{
    return {.name = "plane", .position = {0, 0, 0.25}, .normal = {0, 0, 2}};
}

SinkSettings box(bool outside)
{
    return {.name = "box",
            .shape = SinkShape::Box,
            .position = {0.25, 0, 0},
            .half_extent = {0.5, 0.25, 1},
            .outside = outside};
}

SinkSettings sphere(bool outside)
{
    return {.name = "sphere",
            .shape = SinkShape::Sphere,
            .position = {0, 0.25, 0},
            .radius = 0.75,
            .outside = outside};
}

std::vector<SinkSettings> one_of_each()
{
    return {plane(), box(false), box(true), sphere(false), sphere(true)};
}

/// Written anew, as the sentence says what a sink takes.
bool taken(const SinkSettings& sink, const Vector3d& x)
{
    const Vector3d away = (x - sink.position).cwiseAbs();
    if (sink.shape == SinkShape::Plane)
        return (x - sink.position).dot(sink.normal) < 0;
    if (sink.shape == SinkShape::Sphere)
        return sink.outside ? away.norm() > sink.radius : away.norm() < sink.radius;
    return sink.outside ? (away.array() > sink.half_extent.array()).any()
                        : (away.array() < sink.half_extent.array()).all();
}

TEST(Sinks, HoldWhatIsInsideOrOutsideOfThem)
{
    for (const SinkSettings& sink : one_of_each()) {
        const Sinks sinks({sink});
        int held = 0;
        for (std::uint64_t i = 0; i < 10'000; ++i) {
            Random random(1, 0, i);
            const Vector3d x = test::point_in_ball(random, 2);
            ASSERT_EQ(sinks.hold(x), taken(sink, x)) << sink.name << " at " << x.transpose();
            held += sinks.hold(x);
        }
        EXPECT_GT(held, 100) << sink.name;
        EXPECT_LT(held, 9900) << sink.name;
    }
}

TEST(Sinks, HoldNothingThatIsRightOnAFace)
{
    for (const bool outside : {false, true}) {
        EXPECT_FALSE(Sinks({box(outside)}).hold({0.75, 0.125, 0}));
        EXPECT_FALSE(Sinks({sphere(outside)}).hold({0, 1, 0}));
    }
    EXPECT_FALSE(Sinks({plane()}).hold({7, -5, 0.25}));
}

// A ball of which a point is held reaches, and one that reaches with some of its radius to spare has such a
// point: towards the nearest one of the sink.
TEST(Sinks, AreReachedByExactlyTheBallsThatHoldAPointOfThem)
{
    for (const SinkSettings& sink : one_of_each()) {
        const Sinks sinks({sink});
        for (std::uint64_t i = 0; i < 300; ++i) {
            Random random(2, 0, i);
            const Vector3d centre = test::point_in_ball(random, 3);
            const double radius = random.uniform();
            bool held = false;
            for (int j = 0; j < 2000 && !held; ++j)
                held = sinks.hold(centre + test::point_in_ball(random, radius));
            if (held) {
                ASSERT_TRUE(sinks.reach(centre, radius)) << sink.name;
            } else {
                ASSERT_FALSE(sinks.reach(centre, 0.5 * radius))
                    << sink.name; // 2,000 points leave no such gap
            }
        }
    }
}

/// Whether any of a thousand points of the way is held.
bool meets_a_point(const Sinks& sinks, const Vector3d& from, const Vector3d& to)
{
    for (int i = 0; i <= 1000; ++i)
        if (sinks.hold(from + 0.001 * i * (to - from)))
            return true;
    return false;
}

// A way that meets a sink has one of a thousand of its points in a sink that is larger by the distance from
// one to the next, whatever corner it cuts.
TEST(Sinks, MeetWhoComesIntoThemOnAStraightWay)
{
    for (const SinkSettings& sink : {box(false), sphere(false)}) {
        const Sinks sinks({sink});
        int crossed = 0;
        for (std::uint64_t i = 0; i < 3000; ++i) {
            Random random(3, 0, i);
            const Vector3d from = test::point_in_ball(random, 2), to = test::point_in_ball(random, 2);
            if (meets_a_point(sinks, from, to)) {
                ASSERT_TRUE(sinks.meet(from, to)) << sink.name << " " << i;
            }
            if (sinks.meet(from, to)) {
                SinkSettings larger = sink;
                const double spacing = 0.001 * (to - from).norm();
                larger.radius += spacing;
                larger.half_extent.array() += spacing;
                ASSERT_TRUE(meets_a_point(Sinks({larger}), from, to)) << sink.name << " " << i;
            }
            crossed += sinks.meet(from, to) && !sinks.hold(from) && !sinks.hold(to) ? 1 : 0;
        }
        EXPECT_GT(crossed, 100) << sink.name;
    }
}

TEST(Sinks, MeetWhoGoesAlongAnAxisOrNowhere)
{
    const Sinks boxes({box(false)}), spheres({sphere(false)});
    EXPECT_TRUE(boxes.meet({-5, 0, 0}, {5, 0, 0}));
    EXPECT_FALSE(boxes.meet({-5, 0.5, 0}, {5, 0.5, 0}));
    EXPECT_FALSE(boxes.meet({-5, 0, 0}, {-3, 0, 0})) << "beyond its end";
    EXPECT_TRUE(boxes.meet({0.25, 0, 0}, {0.25, 0, 0}));
    EXPECT_FALSE(boxes.meet({5, 0, 0}, {5, 0, 0}));
    EXPECT_FALSE(spheres.meet({-5, 0, 0}, {-3, 0, 0}));
    EXPECT_FALSE(spheres.meet({5, 0, 0}, {5, 0, 0}));
}

TEST(Sinks, AreThinWhereOneMayFlyThroughThem)
{
    EXPECT_FALSE(Sinks({plane(), box(true), sphere(true)}).thin());
    EXPECT_TRUE(Sinks({plane(), box(false)}).thin());
    EXPECT_TRUE(Sinks({sphere(false)}).thin());
}

TEST(Sinks, AreRefusedWithKeysOfOtherShapesOrWithoutTheirOwn)
{
    for (const SinkSettings& sink : one_of_each())
        EXPECT_EQ(problems(sink), Problems{}) << sink.name;
    const auto says = [](const SinkSettings& sink, const std::string& start) {
        const Problems found = problems(sink);
        return found.size() == 1 && found.front().starts_with(start);
    };
    EXPECT_TRUE(says({.normal = {0, 0, 0}}, "normal = [0, 0, 0] has no direction"));
    EXPECT_TRUE(says({.radius = 1}, "radius is no key of shape = \"plane\""));
    EXPECT_TRUE(says({.half_extent = {1, 1, 1}}, "half_extent is no key of shape = \"plane\""));
    EXPECT_TRUE(says({.outside = true}, "outside is no key of shape = \"plane\""));
    EXPECT_TRUE(says({.shape = SinkShape::Sphere}, "radius = 0 leaves"));
    EXPECT_TRUE(says({.shape = SinkShape::Box, .half_extent = {1, 0, 1}}, "half_extent leaves"));
    EXPECT_TRUE(says({.shape = SinkShape::Sphere, .normal = {0, 1, 0}, .radius = 1}, "normal is no key"));
}

/// Clusters of 64 in a row along x, of which the plane z = 0 cuts the middle ones.
class DrainingTest : public testing::Test {
protected:
    DrainingTest()
    {
        for (std::uint64_t i = 0; i < 9; ++i) {
            ParticleSet cluster = test::ball(64, 0.5, 1, i, {double(i), 0, 0.25 * (double(i) - 4)});
            for (Particle& particle : cluster)
                particle.id += 100 * i;
            test::give_masses(cluster, 0.5, 2, i);
            world.add(cluster, 0, 8);
        }
    }

    test::World world{{MapKind::Identity, 0, 1}, {.masses = true, .kinds = false, .expiry = true}, {}, 2};
    Draining draining{{{.name = "floor"}}};
};

TEST_F(DrainingTest, TakesJustThoseMembersThatAreInASink)
{
    const ParticleSet before = test::members(world.store, 0);
    const Losses drained = draining.update(world.tree, world.context(0));
    const ParticleSet after = test::members(world.store, 0);
    ParticleSet expected;
    for (const Particle& particle : before)
        if (particle.position.z() >= 0)
            expected.push_back(particle);
    ASSERT_EQ(after.size(), expected.size());
    EXPECT_EQ(drained.particles, before.size() - after.size());
    EXPECT_GT(drained.particles, 100U);
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_EQ(after[i].id, expected[i].id);
        EXPECT_EQ(after[i].mass, expected[i].mass);
        EXPECT_LE((after[i].position - expected[i].position).norm(), 0x1p-24); // an offset of a float below 1
        EXPECT_LE((after[i].velocity - expected[i].velocity).norm(), 2 * 0x1p-24);
    }
    EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
}

// Sums of some 300 terms in double, and centres that follow them.
TEST_F(DrainingTest, KeepsTheBooksOfMassAndMomentum)
{
    const ConservedQuantities before = conserved_quantities(world.store, 0);
    const Losses drained = draining.update(world.tree, world.context(0));
    const ConservedQuantities after = conserved_quantities(world.store, 0);
    EXPECT_GT(drained.mass, 100);
    EXPECT_NEAR(after.mass + drained.mass, before.mass, 600 * 0x1p-53 * before.mass);
    EXPECT_LE((after.momentum + drained.momentum - before.momentum).norm(), 600 * 0x1p-53 * 2 * before.mass);
}

TEST_F(DrainingTest, LeavesClustersAloneThatLoseNobody)
{
    const std::vector<Vector3d> before(world.store.clusters.position.begin(),
                                       world.store.clusters.position.end());
    const ClusterId last = world.store.clusters.id(8);
    draining.update(world.tree, world.context(0));
    EXPECT_EQ(world.store.clusters.id(8), last);
    EXPECT_EQ(world.store.clusters.position[8], before[8]);
    EXPECT_EQ(world.store.clusters.alive_count(), 6U) << "the lowest three are altogether below";
}

TEST_F(DrainingTest, KeepsTheRoomForStrays)
{
    draining.update(world.tree, world.context(0));
    const ClusterTable& clusters = world.store.clusters;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        if (clusters.alive(slot)) {
            EXPECT_GE(clusters.slab[slot].capacity, clusters.stored[slot] + 8);
        }
}

} // namespace
} // namespace slod
