#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/rigid_scenes.hpp"

// O'Brien, Fisher, Lin 2001, sections 1 and 3: what goes in, what comes out, and what it costs.
namespace slod::test {
namespace {

TEST(Paper, A01_EveryFrameTellsItsTimeItsClustersAndTheSizeThatEachRegionAllows)
{
    SimulationSettings settings = rigid_settings(32);
    settings.regions = {ball_region("near", {0, 0, 0}, 1, 4), ball_region("far", {3, 0, 0}, 1, 16)};
    Simulation simulation(settings, ball(2000, 4, 1, 1), {});
    for (std::uint64_t frame = 1; frame <= 20; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = true});
        EXPECT_EQ(snapshot.frame, frame);
        EXPECT_EQ(snapshot.time, double(frame) * settings.time.step);
        EXPECT_EQ(snapshot.counts.clusters, snapshot.clusters.size());
        const auto regions = simulation.regions();
        ASSERT_EQ(snapshot.regions.size(), regions.size());
        for (std::size_t i = 0; i < regions.size(); ++i)
            EXPECT_EQ(snapshot.regions[i].row, regions[i].row);
        EXPECT_EQ(regions[0].settings.partition.max_cluster_size, 4);
        EXPECT_EQ(regions[1].settings.partition.max_cluster_size, 16);
        EXPECT_EQ(regions[2].settings.partition.max_cluster_size, 32);
    }
}

// The user's interest in one place, and a variable accuracy from region to region.
TEST(Paper, A02_ARequirementOfOneRegionChangesTheClustersOfThatRegionAlone)
{
    SimulationSettings settings = rigid_settings(32);
    settings.regions = {ball_region("left", {-2, 0, 0}, 1.5, 32), ball_region("right", {2, 0, 0}, 1.5, 32)};
    Simulation simulation(settings, ball(8000, 4, 0, 1), {});
    const Snapshot before = run(simulation, 40);
    RegionOfInterest wanted = settings.regions[0];
    wanted.partition.max_cluster_size = 4;
    ASSERT_EQ(simulation.change_region(wanted), Problems{});
    const Snapshot after = run(simulation, 8);
    EXPECT_LE(mean_size(load_of(simulation, after, "left")), 4);
    for (const char* other : {"right", "background"}) {
        EXPECT_GT(mean_size(load_of(simulation, before, other)), 16);
        EXPECT_EQ(load_of(simulation, before, other).clusters, load_of(simulation, after, other).clusters);
    }
}

// The clock advances by ever longer strides, so that how long a phase took says when it ran.
TEST(Paper, A03_EachFrameMovesThenUpdatesTheTreeThenHandsOutWhatIsShownEachOnce)
{
    SimulationSettings settings = rigid_settings(8);
    settings.gravity.emplace();
    settings.emitters = {jet("jet")};
    std::int64_t readings = 0;
    const auto tick = [&] {
        ++readings;
        return readings * readings * 1'000'000;
    };
    Simulation simulation(settings, ball(100, 1, 0, 1), {.isa = {}, .tick = tick});
    readings = 0;
    const StepProfile profile = simulation.step({}).profile;
    const std::vector<Phase> order{Phase::Commands,  Phase::OpenKick, Phase::Propagate, Phase::Expire,
                                   Phase::Emit,      Phase::Update,   Phase::Moments,   Phase::Forces,
                                   Phase::CloseKick, Phase::Snapshot, Phase::Meter};
    const std::set<Phase> with_an_effect{Phase::Expire, Phase::Emit, Phase::Forces}; // timed by itself
    double last = 0;
    for (const Phase phase : order) {
        const double start = last + 1;
        last = start + (with_an_effect.contains(phase) ? 3 : 1);
        EXPECT_EQ(profile[phase], last * last - start * start) << names(Phase{})[std::size_t(phase)];
    }
    EXPECT_EQ(double(readings), last);
}

// Where a particle is after ten frames is where one solution of its equation of motion has it: it was moved
// ten times. The update has no part in such a scene, so that it counts nothing.
TEST(Paper, A04_AFieldSystemEvaluatesNoPairsAndMovesEachParticleOnce)
{
    constexpr double drag = 0.5, fall = -9.81 / drag;
    SimulationSettings settings = rigid_settings(1);
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -9.81}};
    settings.linear_drag = LinearDragSettings{drag};
    const double time = 10 * settings.time.step, drift = -std::expm1(-drag * time) / drag;
    for (const std::size_t count : {1000U, 2000U, 4000U}) {
        const ParticleSet particles = ball(count, 4, 1, 1);
        Simulation simulation(settings, particles, {});
        const FrameCounts counts = run(simulation, 10).counts;
        EXPECT_EQ(counts.clusters, count);
        EXPECT_EQ(counts.interactions, 0U);
        const ParticleSet moved = simulation.particles();
        for (std::size_t i = 0; i < count; ++i) {
            const Vector3d terminal(0, 0, fall);
            const Vector3d expected =
                particles[i].position + time * terminal + drift * Vector3d(particles[i].velocity - terminal);
            // Ten frames round positions below 8, and displacements, to 2^-50.
            ASSERT_LE((moved[i].position - expected).cwiseAbs().maxCoeff(), 10 * 4 * 0x1p-50);
        }
    }
}

// Clusters are what is moved, and pairs of them what attracts.
TEST(Paper, A06_TheWorkFallsWithTheNumberOfParticlesPerCluster)
{
    constexpr std::uint64_t count = 4000;
    SimulationSettings settings = rigid_settings(16);
    settings.gravity.emplace();
    settings.gravity->strength = 1e-12;
    settings.gravity->direct_below = 100'000;
    Simulation simulation(settings, ball(count, 4, 0, 1), {});
    const FrameCounts counts = run(simulation, 40).counts;
    EXPECT_GE(double(count) / double(counts.clusters), 10);
    EXPECT_EQ(counts.interactions, counts.clusters * (counts.clusters - 1));
    settings.background.max_cluster_size = 1;
    Simulation exact(settings, ball(count, 4, 0, 1), {});
    EXPECT_EQ(run(exact, 1).counts.interactions, count * (count - 1));
}

// What is built at the start stays; a breadth, the second lever, lays the cells anew once. Near the breadth
// clusters go on being merged and split, but in the same tree.
TEST(Paper, A07_TheTreeIsBuiltOnceAndAgainOnlyWhenItsCellsChange)
{
    Simulation simulation(rigid_settings(16), cube(4000, 4, 1), {});
    run(simulation, 100); // merges and divisions have come to an end
    const std::uint64_t pools = simulation.snapshot({}).counts.pools;
    for (int frame = 0; frame < 1000; ++frame) {
        const FrameCounts counts = simulation.step({}).counts;
        ASSERT_EQ(counts.reformed_members + counts.crossings, 0U) << "frame " << frame;
        ASSERT_EQ(counts.pools, pools);
    }
    RegionOfInterest background = simulation.regions().back().settings;
    background.partition.max_breadth = 1;
    ASSERT_EQ(simulation.change_region(background), Problems{});
    run(simulation, 100);
    const std::uint64_t finer = simulation.snapshot({}).counts.pools;
    EXPECT_GT(finer, pools);
    for (int frame = 0; frame < 1000; ++frame) {
        const FrameCounts counts = simulation.step({}).counts;
        ASSERT_EQ(counts.crossings, 0U) << "frame " << frame;
        ASSERT_EQ(counts.pools, finer);
    }
    EXPECT_EQ(simulation.problems(), Problems{});
}

// A search climbs from the leaf and descends again: twice the depth of the tree at most, and the leaf itself.
// Here k-d trees are at most six deep: 2000 particles in cells of side 2 in a ball of radius 4, 16 to a
// leaf, are 4 leaves per cell, and crowding makes some deeper.
TEST(Paper, A08_AfterTheBuildASearchVisitsOnlyWhatClustersThatCrossedNeed)
{
    constexpr std::uint64_t deepest = 6;
    for (const double speed : {0.0, 0.5}) {
        SimulationSettings settings = rigid_settings(4);
        settings.background.max_breadth = 2;
        Simulation simulation(settings, ball(2000, 4, speed, 1), {});
        std::uint64_t crossings = 0, visited = 0;
        for (int frame = 0; frame < 100; ++frame) {
            const FrameCounts counts = simulation.step({}).counts;
            crossings += counts.crossings;
            visited += counts.nodes_searched;
            ASSERT_LE(counts.nodes_searched, (2 * deepest + 1) * counts.crossings) << "frame " << frame;
            ASSERT_EQ(counts.boundary_tests, 0U) << "there is no region to ask";
        }
        EXPECT_EQ(crossings > 0, speed > 0);
        EXPECT_EQ(visited > 0, speed > 0);
    }
}

// A frame covers less than a cell, so that no face is passed over.
TEST(Paper, A09_AClusterIsMovedInTheTreeJustWhenItCrossesAFace)
{
    constexpr double side = 0.75;
    Random random(9, 0, 0);
    for (int run_number = 0; run_number < 100; ++run_number) {
        SimulationSettings settings = rigid_settings(8);
        settings.background.max_breadth = side;
        Particle particle;
        particle.position = {10 * random.uniform() - 5, 0.1, 0.1};
        particle.velocity = {(2 * random.uniform() - 1) * side / settings.time.step, 0, 0};
        particle.mass = 1;
        Simulation simulation(settings, {particle}, {});
        std::uint64_t crossings = 0;
        for (int frame = 0; frame < 64; ++frame)
            crossings += simulation.step({}).counts.crossings;
        const double start = particle.position.x(), end = simulation.particles().front().position.x();
        EXPECT_EQ(crossings, std::uint64_t(std::abs(std::floor(end / side) - std::floor(start / side))))
            << "from " << start << " to " << end;
    }
}

// Some 1e5 births and deaths, with a region that appears, wanders and goes again among them.
TEST(Paper, A10_EveryParticleIsInOneClusterHoweverManyAreAddedAndDeleted)
{
    SimulationSettings settings = rigid_settings(12);
    settings.background.max_breadth = 0.5;
    settings.uniform_gravity.emplace();
    for (const char* name : {"one", "two", "three"}) {
        settings.emitters.push_back(jet(name));
        settings.emitters.back().rate = 12'000;
        settings.emitters.back().lifetime = 0.25;
    }
    Simulation simulation(settings, {}, {});
    std::uint64_t changes = 0, alive = 0;
    for (int frame = 0; frame < 100; ++frame) {
        if (frame % 20 == 5) {
            ASSERT_EQ(simulation.add_region(ball_region("guest", {0, 0, 0.01 * frame}, 0.4, 3)), Problems{});
        } else if (frame % 20 == 15) {
            ASSERT_EQ(simulation.remove_region("guest"), Problems{});
        }
        const Snapshot& snapshot = simulation.step({.clusters = true});
        changes += snapshot.counts.born + snapshot.counts.died;
        alive += snapshot.counts.born - snapshot.counts.died;
        ASSERT_EQ(snapshot.counts.particles, alive);
        std::uint64_t members = 0;
        for (const std::uint32_t count : snapshot.clusters.count)
            members += count;
        ASSERT_EQ(members, alive) << "frame " << frame;
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
        std::set<std::uint64_t> ids;
        for (const Particle& particle : simulation.particles())
            ids.insert(particle.id);
        ASSERT_EQ(ids.size(), alive) << "a particle is in two clusters in frame " << frame;
    }
    EXPECT_GT(changes, 90'000U);
}

} // namespace
} // namespace slod::test
