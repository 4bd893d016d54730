#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"

// O'Brien, Fisher, Lin 2001, sections 3.3 and 5.1: mass, speed and acceleration beside the place.
namespace slod::test {
namespace {

/// The bin of a quantity, by its definition in the settings.
int bin_of(const RegionSettings& settings, double value)
{
    int bin = 0;
    for (double edge = settings.bin_floor; value >= edge; edge *= settings.bin_ratio)
        ++bin;
    return bin;
}

double value_of(BinBy quantity, const Particle& particle)
{
    return quantity == BinBy::Mass ? double(particle.mass) : particle.velocity.norm();
}

/// A cloud of particles of speeds up to 8 and masses spread over six decades.
ParticleSet motley(std::size_t count, std::uint64_t seed)
{
    ParticleSet particles = ball(count, 2, 8, seed);
    Random random(seed, 3, 0);
    for (Particle& particle : particles)
        particle.mass = float(std::pow(10.0, 6 * random.uniform() - 3));
    return particles;
}

void expect_one_bin_per_cluster(const RigidWorld& world, const RegionSettings& settings)
{
    for (const ClusterSlot slot : world.alive()) {
        std::set<int> bins;
        for (const Particle& particle : world.members(slot))
            bins.insert(bin_of(settings, value_of(settings.bin_by, particle)));
        ASSERT_EQ(bins.size(), 1U) << "cluster " << slot.index << " in frame " << world.frame;
    }
}

// Bin edges are 1, 2, 4, 8: a particle's speed is kept to a float's rounding by its cluster, and none of
// these is that near to an edge.
TEST(Paper, A11_NoClusterHoldsParticlesOfTwoBins)
{
    for (const BinBy quantity : {BinBy::Mass, BinBy::Speed}) {
        RigidRules rules{.background = {.max_cluster_size = 16, .bin_by = quantity}, .regions = {}};
        RigidWorld world(rules, motley(2000, 1));
        ASSERT_NO_FATAL_FAILURE(expect_one_bin_per_cluster(world, rules.background)) << "at the build";
        for (int frame = 0; frame < 40; ++frame) {
            world.advance();
            ASSERT_NO_FATAL_FAILURE(expect_one_bin_per_cluster(world, rules.background));
        }
        EXPECT_EQ(world.problems(), Problems{});
    }
}

TEST(Paper, A12_ABinDividesAtTheTopAndPlaceAloneBelow)
{
    const RigidRules rules{.background = {.max_cluster_size = 4, .max_breadth = 1, .bin_by = BinBy::Mass},
                           .regions = {}};
    const ParticleSet particles = motley(4000, 2);
    RigidWorld world(rules, particles);
    std::set<std::array<int, 4>> occupied;
    for (const Particle& particle : particles) {
        const Vector3d cell = particle.position.array().floor();
        occupied.insert(
            {int(cell.x()), int(cell.y()), int(cell.z()), bin_of(rules.background, double(particle.mass))});
    }
    const Subtree& tree = world.tree().subtrees.front();
    EXPECT_EQ(tree.cells.size(), occupied.size());
    std::size_t inner = 0;
    for (const Node& node : tree.nodes) {
        if (node.leaf())
            continue;
        ++inner;
        EXPECT_TRUE(node.axis >= 0 && node.axis < 3);
        EXPECT_EQ(tree.nodes[node.left.index].bin, node.bin);
        EXPECT_EQ(tree.nodes[node.right().index].bin, node.bin);
    }
    EXPECT_GT(inner, 100U);
}

// Speeds are uniform in a ball's volume up to 8: half of the particles are faster than 8 / cbrt(2) = 6.35.
TEST(Paper, A13_FasterParticlesAreInSmallerClusters)
{
    SimulationSettings settings = rigid_settings(32);
    settings.regions = {world_region("fast", 4)};
    settings.regions[0].least_speed = 6.35;
    Simulation simulation(settings, motley(8000, 3), {});
    const Snapshot& snapshot = simulation.snapshot({});
    const RegionLoad fast = load_of(simulation, snapshot, "fast");
    const RegionLoad slow = load_of(simulation, snapshot, "background");
    EXPECT_NEAR(double(fast.particles), 4000, 4 * std::sqrt(2000)) << "four deviations of a fair coin";
    EXPECT_GE(mean_size(slow) / mean_size(fast), 4);
}

TEST(Paper, A14_A50_RegionsThatCoverTheWorldTakeParticlesByTheirMass)
{
    RigidRules rules{.background = {.max_cluster_size = 8}, .regions = {}};
    rules.regions = {world_region("light", 2), world_region("heavy", 32)};
    rules.regions[0].most_mass = 0.1;
    rules.regions[1].least_mass = 10;
    const ParticleSet particles = motley(4000, 4);
    RigidWorld world(rules, particles);
    world.advance(20);
    std::array<std::size_t, 3> clusters{}, members{};
    for (const ClusterSlot slot : world.alive()) {
        const RegionRow row = world.clusters().region[slot.index];
        for (const Particle& particle : world.members(slot)) {
            const RegionRow own = particle.mass < 0.1F ? 1 : particle.mass >= 10 ? 2 : 0;
            ASSERT_EQ(row, own) << "mass " << particle.mass;
        }
        ++clusters[row];
        members[row] += world.clusters().count[slot.index];
    }
    EXPECT_LE(members[1], 2 * clusters[1]);
    EXPECT_GT(members[0], 4 * clusters[0]);
    EXPECT_GT(members[2], 16 * clusters[2]);
}

/// Rms error, against free flight, of the light and of the heavy half of a sheared cloud.
std::array<double, 2> errors_of_halves(double light_size, double heavy_size)
{
    ParticleSet particles = ball(4000, 2, 0, 5);
    for (Particle& particle : particles) {
        particle.velocity = {particle.position.y(), 0, 0};
        particle.mass = particle.id % 2 == 0 ? 1 : 100;
    }
    SimulationSettings settings = rigid_settings(heavy_size);
    settings.regions = {world_region("light", light_size)};
    settings.regions[0].most_mass = 10;
    Simulation simulation(settings, particles, {});
    run(simulation, 64);
    std::array<double, 2> squares{};
    const ParticleSet ended = simulation.particles();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vector3d exact = particles[i].position + particles[i].velocity; // after a unit of time
        squares[particles[i].id % 2] += (ended[i].position - exact).squaredNorm();
    }
    return {std::sqrt(squares[0] / 2000), std::sqrt(squares[1] / 2000)};
}

// In a shear a cluster's error is as wide as the cluster, which is the cube root of its size: 4 instead of 64
// particles make it 0.4 of what it was. The shapes of clusters vary: 0.7 allows for that.
TEST(Paper, A15_SmallerClustersGoToThoseWhoseErrorIsToFall)
{
    const auto [light, heavy] = errors_of_halves(4, 64);
    const auto [light_swapped, heavy_swapped] = errors_of_halves(64, 4);
    EXPECT_LT(light, 0.7 * light_swapped);
    EXPECT_LT(heavy_swapped, 0.7 * heavy);
}

/// Largest change of a cluster's velocity, relative to its speed, in the merges of some hundred frames.
double largest_deviation(BinBy bin_by)
{
    ParticleSet particles = ball(1000, 1, 0.2, 6);
    for (Particle& particle : particles) {
        particle.velocity += Vector3d(1, 0, 0);
        particle.mass = particle.id % 2 == 0 ? 1e-3F : 1e3F;
    }
    RigidRules rules{.background = {.max_cluster_size = 2, .speed_ratio = 2, .bin_by = bin_by},
                     .regions = {}};
    rules.background.velocity_reference = VelocityReference::Rest;
    RigidWorld world(rules, particles, true);
    double largest = 0;
    for (int frame = 0; frame < 100; ++frame) {
        const std::vector<ClusterSlot> before = world.cluster_of_particles();
        const AlignedVector<Vector3d> velocity = world.clusters().velocity;
        world.advance();
        const std::vector<ClusterSlot> after = world.cluster_of_particles();
        for (std::size_t i = 0; i < before.size(); ++i) {
            const Vector3d& old = velocity[before[i].index];
            const Vector3d change = world.clusters().velocity[after[i].index] - old;
            largest = std::max(largest, change.norm() / old.norm());
        }
        if (bin_by == BinBy::Mass) {
            EXPECT_NO_FATAL_FAILURE(expect_one_bin_per_cluster(world, rules.background));
        }
    }
    return largest;
}

TEST(Paper, A17_MassAsADimensionKeepsLightClustersFromBeingSweptAlongByHeavyOnes)
{
    const double mixed = largest_deviation(BinBy::None), binned = largest_deviation(BinBy::Mass);
    EXPECT_GT(binned, 0) << "equals merge all the same";
    EXPECT_LT(binned, 0.75 * mixed) << "of two equals each changes by half of what a light one does";
}

} // namespace
} // namespace slod::test
