#include <cmath>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// A speed limit and Brownian kicks, which act on particles one by one.
namespace slod::test {
namespace {

SmallScene cloud_at_rest(std::uint32_t count)
{
    SmallScene scene{"cloud", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = 32;
    scene.settings.background.max_breadth = 4;
    add_cloud(scene.initial, {.count = count, .scale = 0.5}, 1);
    for (Particle& particle : scene.initial)
        particle.velocity.setZero();
    return scene;
}

// Without drag the variance of a component grows by s^2 a unit of time. Of 3 x 4000 numbers its estimate
// scatters by sqrt(2 / 12000), 1.3 %.
TEST(Brownian, HeatsInProportionToTheTime)
{
    SmallScene scene = cloud_at_rest(4000);
    scene.settings.brownian = BrownianSettings{0.5};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 64; ++frame)
        EXPECT_EQ(simulation.step({}).counts.kicked, 4000U);
    double sum = 0;
    Vector3d mean(0, 0, 0);
    for (const Particle& particle : simulation.particles()) {
        sum += particle.velocity.squaredNorm() / 12'000;
        mean += particle.velocity / 4000;
    }
    EXPECT_NEAR(sum / (0.25 * 64 * scene.settings.time.step), 1, 5 * 0.013);
    EXPECT_LE(mean.norm(), 5 * 0.5 * std::sqrt(3.0 / 4000));
}

// v' = e (v + kick) has the variance s^2 h e^2 / (1 - e^2) in the end.
TEST(Brownian, ComesToAnEquilibriumWithTheDrag)
{
    SmallScene scene = cloud_at_rest(4000);
    scene.settings.brownian = BrownianSettings{0.5};
    scene.settings.linear_drag = LinearDragSettings{8};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 64; ++frame)
        simulation.step({});
    const double h = scene.settings.time.step;
    double sum = 0;
    for (const Particle& particle : simulation.particles())
        sum += particle.velocity.squaredNorm() / 12'000;
    EXPECT_NEAR(sum * std::expm1(2 * 8 * h) / (0.25 * h), 1, 5 * 0.013);
}

// What a particle is given depends on its id, the frame and the seed, not on its cluster: with nothing else
// to act, clustered particles get to where single ones do, but for roundings to float of a few frames'
// offsets.
TEST(Brownian, KicksAParticleAlikeInAnyCluster)
{
    SmallScene scene = cloud_at_rest(300);
    scene.settings.brownian = BrownianSettings{0.5};
    const auto run = [&](double size, std::uint64_t seed) {
        scene.settings.background.max_cluster_size = size;
        scene.settings.seed = seed;
        Simulation simulation(scene.settings, scene.initial, {});
        for (int frame = 0; frame < 32; ++frame)
            simulation.step({});
        return simulation.particles();
    };
    const ParticleSet clustered = run(32, 1), single = run(1, 1), other = run(1, 2);
    double difference = 0;
    for (std::size_t i = 0; i < single.size(); ++i) {
        EXPECT_LE((clustered[i].position - single[i].position).norm(), 32 * 8 * 0x1p-24);
        difference = std::max(difference, (other[i].position - single[i].position).norm());
    }
    EXPECT_GT(difference, 0.01);
}

TEST(SpeedLimit, HoldsForEveryParticleAndLeavesSlowOnesAlone)
{
    SmallScene scene = cloud_at_rest(1000);
    for (Particle& particle : scene.initial)
        particle.velocity = 3 * particle.position;
    scene.settings.speed_limit = SpeedLimitSettings{2};
    Simulation simulation(scene.settings, scene.initial, {});
    const Snapshot& first = simulation.step({});
    EXPECT_GT(first.counts.kicked, 0U);
    EXPECT_LT(first.counts.kicked, 1000U);
    for (int frame = 0; frame < 10; ++frame)
        simulation.step({});
    const ParticleSet end = simulation.particles();
    for (std::size_t i = 0; i < end.size(); ++i) {
        EXPECT_LE(end[i].velocity.norm(), 2 * (1 + 4 * 0x1p-24)); // offsets of a cluster are floats
        const Vector3d& start = scene.initial[i].velocity;
        if (start.norm() < 1.99) {
            EXPECT_LE((end[i].velocity - start).norm(), 16 * 0x1p-24);
        }
    }
}

TEST(SpeedLimit, OutOfReachChangesNobody)
{
    SmallScene scene = small_scene("fountain");
    scene.settings.speed_limit = SpeedLimitSettings{1e6};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 40; ++frame)
        EXPECT_EQ(simulation.step({}).counts.kicked, 0U);
}

TEST(Brownian, E10_OfNoStrengthIsAsIfAbsentToTheBit)
{
    SmallScene scene = small_scene("mixture");
    const std::uint64_t without = hash_of(scene, 2, 20);
    scene.settings.brownian = BrownianSettings{0};
    EXPECT_EQ(hash_of(scene, 2, 20), without);
}

/// A cluster of two that a spring of acceleration 10 draws onto a floor, after the frame in which both hit
/// it.
ParticleSet bounced(double kicks)
{
    SmallScene scene{"floor", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = 4;
    scene.settings.background.max_breadth = 4;
    scene.settings.fields.of<Spring>() = {{.anchor = {0, 0, -10}}};
    scene.settings.colliders = {with(plane({0, 0, 0}, {0, 0, 1}), 1, 0)};
    scene.settings.brownian = BrownianSettings{kicks};
    scene.initial = {{{1, 1, 0.01}, {0, 0, -3}, 0, 1}, {{1, 1.125, 0.01}, {0, 0, -3}, 1, 1}};
    Simulation simulation(scene.settings, scene.initial, {});
    EXPECT_EQ(simulation.snapshot({}).counts.clusters, 1U);
    const Snapshot& end = simulation.step({});
    EXPECT_EQ(end.counts.impacts, 2U);
    EXPECT_EQ(end.counts.kicked, kicks > 0 ? 2U : 0U);
    return simulation.particles();
}

// The floor is hit 1/300 into a frame of 1/64: taken for free flight, the way there and back would be 0.09
// off in velocity, 10 (2/300 - 1/64). Kicks are of 1e-9 sqrt(3/64) a component, 4e-10 in all, and the places
// of the members are exact in floats.
TEST(MemberKicks, LeaveTheAccelerationThatABounceIsUnder)
{
    const ParticleSet kicked = bounced(1e-9), not_kicked = bounced(0);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LE((kicked[i].velocity - not_kicked[i].velocity).norm(), 1e-9) << i;
        EXPECT_LE((kicked[i].position - not_kicked[i].position).norm(), 1e-9) << i;
    }
}

/// Members formed anew at the ends of lives of 1 to 64 frames, in 64 frames of 1/64. The spring's tide of
/// 100 sqrt(3) asks for lives of 0.2 / 13.2, less than a frame.
std::uint64_t reformed(double kicks)
{
    SmallScene scene = cloud_at_rest(1000);
    scene.settings.motion.shortest_life = 1;
    scene.settings.motion.longest_life = 64;
    scene.settings.fields.of<Spring>() = {{.stiffness = 100}};
    scene.settings.brownian = BrownianSettings{kicks};
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t members = 0;
    for (int frame = 0; frame < 64; ++frame)
        members += simulation.step({}).counts.reformed_members;
    return members;
}

TEST(MemberKicks, LeaveThePaceAtWhichMapsAreRenewed)
{
    EXPECT_EQ(reformed(1e-9), reformed(0));
}

// Pools fall due one by one, so members that leave theirs come to clusters that were kicked in every frame of
// their lives. Slabs as small as these have just the rows that they are asked for.
TEST(MemberKicks, LeaveRoomForStrays)
{
    SmallScene scene = cloud_at_rest(2000);
    scene.settings.background.max_cluster_size = 10;
    scene.settings.background.max_breadth = 1;
    scene.settings.background.pool_factor = 2;
    scene.settings.motion.longest_life = 16;
    scene.settings.fields.of<Spring>() = {{.stiffness = 10}};
    scene.settings.brownian = BrownianSettings{0.1};
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t inserted = 0;
    for (int frame = 0; frame < 64; ++frame)
        inserted += simulation.step({}).counts.strays_inserted;
    EXPECT_TRUE(simulation.plan().clocked);
    EXPECT_GT(inserted, 0U);
}

TEST(MemberKicks, HaveTheSameBitsAtAnyNumberOfThreads)
{
    for (const char* name : {"mixture", "rigid_obstacles", "regions"}) {
        SmallScene scene = small_scene(name);
        scene.settings.brownian = BrownianSettings{0.5};
        scene.settings.speed_limit = SpeedLimitSettings{4};
        const std::uint64_t alone = hash_of(scene, 1, 40);
        EXPECT_EQ(hash_of(scene, 3, 40), alone) << name;
        EXPECT_EQ(hash_of(scene, 8, 40), alone) << name;
    }
}

} // namespace
} // namespace slod::test
