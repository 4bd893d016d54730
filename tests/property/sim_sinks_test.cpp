#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/clouds.hpp"
#include "support/small_scenes.hpp"

// Particles that die in sinks, whatever clusters they are in.
namespace slod::test {
namespace {

/// A ball of particles that flies apart and falls, towards a floor, a small ball and the outside of a box.
SmallScene falling_apart(Motion motion, double max_cluster_size)
{
    SmallScene scene{"falling_apart", quiet_settings(), ball(1000, 1, 3, 5)};
    give_masses(scene.initial, 0.5, 2, 6);
    scene.settings.motion.motion = motion;
    scene.settings.background.max_cluster_size = max_cluster_size;
    scene.settings.background.max_breadth = 2;
    scene.settings.uniform_gravity.emplace();
    scene.settings.linear_drag = LinearDragSettings{0.3};
    scene.settings.sinks = {
        {.name = "floor", .position = {0, 0, -1.5}, .normal = {0.2, 0, 1}},
        {.name = "hole", .shape = SinkShape::Sphere, .position = {0.5, 0, 0}, .radius = 0.2},
        {.name = "world", .shape = SinkShape::Box, .half_extent = {1.5, 1.4, 3}, .outside = true}};
    return scene;
}

/// The frame at whose end each particle died, by id.
std::map<std::uint64_t, int> deaths(const SmallScene& scene, int frames)
{
    std::map<std::uint64_t, int> died;
    for (const Particle& particle : scene.initial)
        died[particle.id] = frames + 1;
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 1; frame <= frames; ++frame) {
        const std::uint64_t before = simulation.snapshot({}).counts.particles;
        const Snapshot& now = simulation.step({});
        EXPECT_EQ(now.counts.drained, now.counts.died);
        EXPECT_EQ(now.counts.particles, before - now.counts.drained);
        std::map<std::uint64_t, int> alive;
        for (const Particle& particle : simulation.particles())
            alive[particle.id] = 1;
        for (auto& [id, last] : died)
            if (last > frames && !alive.contains(id))
                last = frame;
    }
    EXPECT_EQ(simulation.problems(), Problems{});
    return died;
}

// Single particles in the same fields, each for itself: the world in which nothing is shared. A clustered
// one's place is off by the rounding of offsets to float, 1e-6 after some formings, so it may die a frame
// early or late if it passes a face within that of a frame's end: of a thousand, each of which goes some 20th
// of a length in a frame, less than one does.
TEST(Sinks, TakeTheMembersOfClustersWhenTheyWouldTakeThemAlone)
{
    for (const double size : {8.0, 64.0}) {
        const auto clustered = deaths(falling_apart(Motion::Flow, size), 60);
        const auto alone = deaths(falling_apart(Motion::Flow, 1), 60);
        int others = 0, died = 0;
        for (const auto& [id, frame] : alone) {
            EXPECT_LE(std::abs(clustered.at(id) - frame), 1) << id;
            others += clustered.at(id) != frame;
            died += frame <= 60;
        }
        EXPECT_LE(others, 1) << size;
        EXPECT_GT(died, 500);
    }
}

// Whatever moves the clusters, who came into a sink in a frame is not there any more, and nobody else is
// missed.
TEST(Sinks, LeaveNobodyInsideAndTakeNobodyElse)
{
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid}) {
        const SmallScene scene = falling_apart(motion, 64);
        const Sinks sinks(scene.settings.sinks);
        Simulation simulation(scene.settings, scene.initial, {});
        SimulationSettings without = scene.settings;
        without.sinks.clear();
        for (int frame = 0; frame < 60; ++frame) {
            // One frame without sinks, of the same particles in clusters of their own, shows their ways.
            const ParticleSet before = simulation.particles();
            simulation.step({});
            for (const Particle& particle : simulation.particles())
                ASSERT_FALSE(sinks.hold(particle.position)) << frame;
            if (motion == Motion::Rigid)
                continue; // its members move with their cluster, not by themselves
            without.background.max_cluster_size = 1;
            Simulation free(without, before, {});
            free.step({});
            const ParticleSet after = free.particles();
            std::uint64_t expected = 0;
            for (std::size_t i = 0; i < after.size(); ++i)
                expected += sinks.meet(before[i].position, after[i].position) ? 0 : 1;
            ASSERT_NEAR(double(simulation.snapshot({}).counts.particles), double(expected), 1) << frame;
        }
    }
}

// Three lengths in a frame, through a plate a hundredth thick and a ball of a tenth: who was on its way
// through is gone, whoever flew with it, and nobody else. Places are off by floats of offsets below 16, which
// nobody passes a face by.
TEST(Sinks, ThatAreThinAreNotFlownThrough)
{
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid}) {
        SmallScene scene{"volley", quiet_settings(), ball(500, 1, motion == Motion::Rigid ? 0.0 : 3.0, 5)};
        for (Particle& particle : scene.initial)
            particle.velocity += Vector3d(200, 0, 0);
        scene.settings.motion.motion = motion;
        scene.settings.background.max_breadth = 4;
        scene.settings.linear_drag = LinearDragSettings{0.3};
        scene.settings.sinks = {
            {.name = "plate", .shape = SinkShape::Box, .position = {8, 1, 0}, .half_extent = {0.005, 1, 10}},
            {.name = "bead", .shape = SinkShape::Sphere, .position = {10, -0.5, 0}, .radius = 0.1}};
        ParticleSet left[2];
        for (const double size : {1.0, 64.0}) {
            scene.settings.background.max_cluster_size = size;
            Simulation simulation(scene.settings, scene.initial, {});
            for (int frame = 0; frame < 10; ++frame)
                simulation.step({});
            left[size > 1 ? 1 : 0] = simulation.particles();
        }
        ASSERT_EQ(left[0].size(), left[1].size());
        EXPECT_LT(left[0].size(), 300U);
        EXPECT_GT(left[0].size(), 100U);
        for (std::size_t i = 0; i < left[0].size(); ++i)
            EXPECT_EQ(left[0][i].id, left[1][i].id);
        for (const Particle& particle : left[0])
            EXPECT_LT(particle.position.y(), 0.4) << "beside the plate, and 0.12 on at 3";
    }
}

// A sink behind a surface takes nobody whom the surface turns back, though most would have been in it.
TEST(Sinks, BehindACollidersSurfaceTakeNobody)
{
    SmallScene scene{"lined", quiet_settings(), ball(500, 0.5, 2, 5, {0, 0, 1})};
    scene.settings.background.max_cluster_size = 64;
    scene.settings.background.max_breadth = 2;
    scene.settings.uniform_gravity.emplace();
    scene.settings.colliders = {{.name = "floor", .restitution = 0.9}};
    scene.settings.sinks = {{.name = "lining",
                             .shape = SinkShape::Box,
                             .position = {0, 0, -0.01},
                             .half_extent = {100, 100, 0.005}}};
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t impacts = 0;
    for (int frame = 0; frame < 100; ++frame)
        impacts += simulation.step({}).counts.impacts;
    EXPECT_GT(impacts, 500U);
    EXPECT_EQ(simulation.particles().size(), 500U);
}

// In uniform gravity alone momentum grows by M g h in a frame, and by nothing else but what sinks take.
TEST(Sinks, KeepTheBooksOfMassAndMomentum)
{
    SmallScene scene = falling_apart(Motion::Flow, 64);
    scene.settings.linear_drag.reset();
    Simulation simulation(scene.settings, scene.initial, {});
    ConservedQuantities before = simulation.snapshot({.clusters = false, .conserved = true}).conserved;
    const double scale = before.mass;
    double taken = 0;
    for (int frame = 0; frame < 60; ++frame) {
        const Snapshot& now = simulation.step({.clusters = false, .conserved = true});
        const Vector3d pull = before.mass * scene.settings.time.step * Vector3d(0, 0, -9.81);
        // A thousand masses of speeds below 16, summed up in any order, some with offsets that are floats of
        // members that leave: their sum is exact in what stays, so doubles are all that rounds.
        ASSERT_NEAR(now.conserved.mass + now.drained.mass, before.mass, 2000 * 0x1p-53 * scale) << frame;
        ASSERT_LE((now.conserved.momentum + now.drained.momentum - before.momentum - pull).norm(),
                  2000 * 0x1p-53 * 16 * scale)
            << frame;
        before = now.conserved;
        taken += now.drained.mass;
    }
    EXPECT_GT(taken, 0.5 * scale);
}

// A sink that nobody comes to changes no bit, in any scene; the kicks and lives of clusters are the same too.
TEST(Sinks, OutOfReachChangeNoBit)
{
    for (const char* name : {"fountain", "flow", "rigid_obstacles", "mixture", "regions"}) {
        SmallScene scene = small_scene(name);
        const auto hash_undrained = [&] {
            Simulation simulation(scene.settings, scene.initial, {});
            for (int frame = 0; frame < 40; ++frame)
                EXPECT_EQ(simulation.step({}).counts.drained, 0U);
            return simulation.state_hash();
        };
        const std::uint64_t without = hash_undrained();
        scene.settings.sinks = {{.name = "far", .position = {0, 0, -1e6}}};
        EXPECT_EQ(hash_undrained(), without) << name;
    }
}

// What is born and in a sink at the end of the same frame was never there, as if its life had ended within
// it.
TEST(Sinks, SwallowWhatIsBornInThem)
{
    SmallScene scene = small_scene("fountain");
    scene.settings.sinks = {{.name = "all", .shape = SinkShape::Sphere, .radius = 10}};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 10; ++frame) {
        const Snapshot& now = simulation.step({});
        EXPECT_EQ(now.counts.particles, 0U);
        EXPECT_EQ(now.counts.born, 0U);
    }
}

// The first, partial frame takes most newborns past a plate of 0.01 half a length before the nozzle.
TEST(Sinks, ThatAreThinAreNotFlownThroughByNewborns)
{
    SmallScene scene = small_scene("fountain");
    EmitterSettings& emitter = scene.settings.emitters.front();
    scene.settings.emitters.resize(1);
    emitter.direction = {0, 0, 1};
    emitter.cone_angle_deg = 0;
    emitter.speed = 200;
    scene.settings.sinks = {{.name = "plate",
                             .shape = SinkShape::Box,
                             .position = emitter.position + Vector3d(0, 0, 0.5),
                             .half_extent = {100, 100, 0.005}}};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 20; ++frame)
        simulation.step({});
    for (const Particle& particle : simulation.particles())
        EXPECT_LT(particle.position.z(), emitter.position.z() + 0.5);
}

TEST(Sinks, HaveTheSameBitsAtAnyNumberOfThreads)
{
    for (const char* name : {"sinks", "attracted_sink"}) {
        const SmallScene scene = small_scene(name);
        const std::uint64_t alone = hash_of(scene, 1);
        EXPECT_EQ(hash_of(scene, 3), alone) << name;
        EXPECT_EQ(hash_of(scene, 8), alone) << name;
    }
}

TEST(Sinks, MayGoWhileTheSceneRuns)
{
    const SmallScene scene = small_scene("sinks");
    Simulation simulation(scene.settings, scene.initial, {});
    const auto drained = [&] {
        std::uint64_t sum = 0;
        for (int frame = 0; frame < 40; ++frame)
            sum += simulation.step({}).counts.drained;
        return sum;
    };
    EXPECT_GT(drained(), 0U);
    SimulationSettings other = scene.settings;
    other.sinks.clear();
    ASSERT_EQ(simulation.change_settings(other), Problems{});
    EXPECT_EQ(drained(), 0U);
}

} // namespace
} // namespace slod::test
