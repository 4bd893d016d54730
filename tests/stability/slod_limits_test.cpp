#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/random_regions.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"

// Clusters of one particle, of all particles and in degenerate places, and the tree over a long time.
namespace slod::test {
namespace {

TEST(SlodStability, S07_ParticlesInOnePlaceAreDividedByTheirNumber)
{
    for (const std::size_t count : {9U, 64U, 1000U}) {
        test::World world({MapKind::Identity, 0, 1}, {}, {.max_cluster_size = 8}, 1);
        world.add(ball(count, 0, 0, 1, {0.5, 0.5, 0.5}));
        world.tree.merging = true;
        Regrouping regrouping({}, world.context(0));
        UpdateCounts counts;
        for (std::uint64_t frame = 1; frame <= 100; ++frame)
            regrouping.update(world.tree, frame, counts);
        const double most = double((count + 7) / 8);
        expect_within("clusters over those needed", double(world.store.clusters.alive_count()) / most, 1, 1);
        expect_within("splits, once and never again", double(counts.splits), 1, 1);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
    // A leaf that cannot be divided is no reason to compare all with all. When it has its turn, a cluster
    // that gathers looks through as many as that is, and once more in vain; those gathered do not look at
    // all. What is left over looks once for one cluster and up to three times for two.
    constexpr std::uint64_t count = 20'000;
    RigidWorld crowd({.background = {.max_cluster_size = 8}, .regions = {}}, ball(count, 0, 0, 1), true);
    std::uint64_t pair_tests = 0;
    for (int frame = 0; frame < 100; ++frame) {
        crowd.advance();
        pair_tests += crowd.counts.pair_tests;
    }
    EXPECT_EQ(crowd.alive().size(), count / 8);
    expect_at_most("pairs that 20,000 in one place look at", double(pair_tests),
                   4.0 * count * Gathering::most_candidates);
    // The build ends, fills every cluster, as no stray will ever come to it, and gives the same each time.
    Simulation one(rigid_settings(8), ball(1000, 0, 0, 1), {}),
        other(rigid_settings(8), ball(1000, 0, 0, 1), {});
    EXPECT_EQ(one.snapshot({}).counts.clusters, 1000U / 8);
    run(one, 40);
    run(other, 40);
    EXPECT_EQ(one.state_hash(), other.state_hash());
}

/// `count` particles at rest in a row, a square or a cube of equal distances, in a cell of side 16.
ParticleSet lattice(int side, int dimensions)
{
    ParticleSet particles;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < (dimensions > 1 ? side : 1); ++y)
            for (int z = 0; z < (dimensions > 2 ? side : 1); ++z) {
                Particle particle;
                particle.position = Vector3d(x, y, z) * (15.0 / side) + Vector3d::Constant(0.5);
                particle.velocity.setZero();
                particle.mass = 1;
                particle.id = particles.size() + 1;
                particles.push_back(particle);
            }
    return particles;
}

// A cell is halved along its longest side, so of a row of particles every third split divides them, of a
// square two of three, of a cube all; one more level per axis for what does not come out even.
TEST(SlodStability, S08_RowsSquaresAndCubesAreDividedEvenlyInAFlatTree)
{
    constexpr double size = 8;
    for (const auto& [side, dimensions] : {std::pair{4096, 1}, std::pair{64, 2}, std::pair{16, 3}}) {
        SCOPED_TRACE(dimensions);
        RigidRules rules{.background = {.max_cluster_size = size, .pool_factor = 1}, .regions = {}};
        rules.cell_side = 16;
        const ParticleSet particles = lattice(side, dimensions);
        RigidWorld world(rules, particles);
        std::uint32_t smallest = 1000, largest = 0;
        for (const ClusterSlot slot : world.alive()) {
            smallest = std::min(smallest, world.clusters().count[slot.index]);
            largest = std::max(largest, world.clusters().count[slot.index]);
        }
        expect_at_most("largest cluster", largest, size);
        // A pool has 8 to 16, which are one cluster or two.
        expect_at_least("smallest cluster", smallest, size / 2);
        int deepest = 0;
        for (const Node& node : world.tree().subtrees.front().nodes)
            deepest = std::max(deepest, node.depth);
        const double levels = std::ceil(std::log2(double(particles.size()) / size)) + 2;
        expect_at_most("depth in " + std::to_string(dimensions) +
                           (dimensions == 1 ? " dimension" : " dimensions"),
                       deepest, levels * 3 / dimensions);
    }
}

TEST(SlodStability, S24_OneParticlePerClusterEverywhereIsTheRunWithoutClusters)
{
    const ParticleSet particles = ball(500, 2, 3, 1);
    SimulationSettings settings = windy(1);
    Simulation without(settings, particles, {});
    settings.background.max_cluster_size = 64;
    settings.regions = {world_region("all", 1)};
    settings.regions[0].partition.max_breadth = 1;
    Simulation with(settings, particles, {});
    ASSERT_TRUE(without.plan().unclustered);
    ASSERT_FALSE(with.plan().unclustered);
    for (int frame = 0; frame < 200; ++frame) {
        without.step({});
        ASSERT_EQ(with.step({}).counts.clusters, 500U);
    }
    const ParticleSet expected = without.particles(), found = with.particles();
    int different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        different += found[i].position != expected[i].position || found[i].velocity != expected[i].velocity;
    expect_at_most("particles of 500 that differ in a bit", different, 0);
}

/// Largest difference between the centre of one cluster and that of free particles, in `frames` frames.
double centre_error(const SimulationSettings& settings, std::size_t count, int frames)
{
    SimulationSettings single = settings;
    single.background.max_cluster_size = 1;
    const ParticleSet particles = ball(count, 1, 3, 1, {512, 512, 512});
    Simulation together(settings, particles, {}), apart(single, particles, {});
    double largest = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const Snapshot& snapshot = together.step({.clusters = true});
        EXPECT_EQ(snapshot.clusters.size(), 1U);
        apart.step({});
        Vector3d mean(0, 0, 0);
        for (const Particle& particle : apart.particles())
            mean += (particle.position - Vector3d::Constant(512)) / double(count);
        const Vector3d centre = snapshot.clusters.position[0] - Vector3d::Constant(512);
        largest = std::max(largest, (centre - mean).norm());
    }
    return largest;
}

// Positions below 1024 are rounded to 2^-44 in each coordinate and frame.
TEST(SlodStability, S25_OneClusterOfAllMovesAsTheMeanOfAllInUniformGravity)
{
    SimulationSettings settings = windy(1e6);
    settings.linear_drag.reset();
    settings.uniform_wind.reset();
    expect_at_most("error of the centre", centre_error(settings, 5000, 100), 100 * std::sqrt(3) * 0x1p-43);
}

TEST(SlodStability, S26_LinearDragActsOnTheCentreAsOnTheMean)
{
    expect_at_most("error of the centre in linear drag", centre_error(windy(1e6), 300, 1000), 1e-9);
}

// Half the Laplacian of |w| w is 2 w / |w|, so that the mean of what a swarm of velocities w + d feels is
// what its mean feels and c sigma^2 2 / 3 more, sigma^2 the mean of d^2. A cluster lacks just that: as of the
// next order, relative, it lacks (sigma / w)^2 = 0.003, and for what 2000 draws are off isotropy three of
// their standard deviations of 0.02.
TEST(SlodStability, S26_QuadraticDragOnTheCentreLacksTheTermOfSecondOrderInTheSpread)
{
    constexpr double coefficient = 0.1;
    SimulationSettings settings = windy(1e6);
    settings.gravity.reset();
    settings.uniform_gravity.reset();
    settings.linear_drag.reset();
    settings.uniform_wind.reset();
    settings.quadratic_drag = QuadraticDragSettings{coefficient};
    settings.time.step = 0x1p-10;
    ParticleSet particles = ball(2000, 1, 1, 26, {512, 512, 512});
    Vector3d mean(0, 0, 0);
    for (Particle& particle : particles) {
        particle.velocity.x() += 15;
        mean += particle.velocity / double(particles.size());
    }
    double spread = 0; // sigma^2
    for (const Particle& particle : particles)
        spread += (particle.velocity - mean).squaredNorm() / double(particles.size());
    SimulationSettings single = settings;
    single.background.max_cluster_size = 1;
    Simulation together(settings, particles, {}), apart(single, particles, {});
    for (int frame = 1; frame <= 256; ++frame) {
        const Snapshot& snapshot = together.step({.clusters = true});
        ASSERT_EQ(snapshot.clusters.size(), 1U);
        apart.step({});
        mean.setZero();
        for (const Particle& particle : apart.particles())
            mean += particle.velocity / double(particles.size());
        const double lacking = (snapshot.clusters.velocity[0] - mean).norm() /
                               (coefficient * spread * settings.time.step * frame);
        if (frame == 1)
            expect_within("what the centre lacks in quadratic drag over c sigma^2 2 / 3, at first",
                          lacking / (2.0 / 3), 1 - 0.066, 1 + 0.066);
        expect_at_most("what the centre lacks in quadratic drag over c sigma^2 t", lacking, 1);
    }
}

// From leaf to leaf, cell to cell, onto the very faces and out of the grid, where both find nothing.
TEST(SlodStability, S27_BottomUpFindsWhatTopDownFindsHoweverFarTheMove)
{
    const RigidRules rules{
        .background = {.max_cluster_size = 1, .pool_factor = 16}, .regions = {}, .cell_side = 4};
    RigidWorld world(rules, cube(20'000, 7.9, 1, {8, 8, 8}));
    const Subtree& tree = world.tree().subtrees.front();
    Random random(27, 0, 0);
    std::size_t outside = 0, different = 0;
    for (int move = 0; move < 1'000'000; ++move) {
        const PoolId start = locate(tree, Vector3d(Vector3d(8, 8, 8) + random_point(random, 7.9)));
        ASSERT_TRUE(start.valid());
        const Box& leaf = tree.nodes[tree.pools[start.index].node.index].box;
        Vector3d to = Vector3d(8, 8, 8) + random_point(random, move % 2 == 0 ? 7.9 : 20);
        if (move % 3 == 0)
            to[move % 9 / 3] = leaf.upper[move % 9 / 3];
        const PoolId found = locate(tree, to);
        different += locate_near(tree, start, to) == found ? 0 : 1;
        outside += !found.valid();
    }
    expect_at_most("moves of a million that end elsewhere", double(different), 0);
    expect_at_least("moves of a million that leave the grid", double(outside), 100'001);
}

// A swarm of forty clusters crosses a cell in two frames: what it leaves is pruned every eighth frame.
TEST(SlodStability, S28_TheTreeDoesNotGrowInAHundredThousandFrames)
{
    ParticleSet particles = ball(40, 1, 0.01, 1);
    for (Particle& particle : particles)
        particle.velocity += Vector3d(32, 7, 0);
    RigidWorld world({.background = {.max_cluster_size = 1, .max_breadth = 1}, .regions = {}}, particles);
    world.advance(1000);
    const Subtree& tree = world.tree().subtrees.front();
    const std::size_t nodes = tree.nodes.size(), pools = tree.pools.size();
    world.advance(99'000);
    // The swarm spreads by 0.01 per time, from a ball of radius 1 to one of 16, where each is in its own
    // cell.
    expect_at_most("nodes", double(tree.nodes.size()), double(std::max<std::size_t>(nodes, 40 * 9)));
    expect_at_most("pools", double(tree.pools.size()), double(std::max<std::size_t>(pools, 40 * 9)));
    expect_at_most("pools in use", double(tree.pool_count()), 40 * 9);
    EXPECT_EQ(world.problems(), Problems{});
}

TEST(SlodStability, S29_AParticleThatDiesLeavesTheCentreOfTheOthersAndTheLastOneLeavesNothing)
{
    ParticleSet particles = ball(40, 1, 1, 1, {512, 512, 512});
    for (Particle& particle : particles) {
        particle.expiry_frame = std::uint32_t(particle.id);
        particle.mass = float(1 + particle.id % 3);
    }
    SimulationSettings settings = windy(64);
    Simulation simulation(settings, particles, {});
    for (std::uint64_t frame = 1; frame < 40; ++frame) {
        const ParticleSet before = simulation.particles();
        const Snapshot& snapshot = simulation.step({.clusters = true});
        ASSERT_EQ(snapshot.counts.particles, 40 - frame);
        ASSERT_EQ(snapshot.clusters.size(), 1U);
        double mass = 0;
        Vector3d centre(0, 0, 0);
        for (const Particle& particle : simulation.particles()) {
            ASSERT_GT(particle.id, frame);
            mass += double(particle.mass);
            centre += double(particle.mass) * (particle.position - Vector3d::Constant(512));
        }
        ASSERT_EQ(snapshot.clusters.mass[0], mass);
        expect_at_most("error of the centre of those left",
                       (snapshot.clusters.position[0] - Vector3d::Constant(512) - centre / mass).norm(),
                       1e-12);
    }
    expect_at_most("clusters after the last one", double(simulation.step({}).counts.clusters), 0);
    expect_at_most("pools after the last one", double(run(simulation, 20).counts.pools), 0);
    EXPECT_EQ(simulation.problems(), Problems{});
}

} // namespace
} // namespace slod::test
