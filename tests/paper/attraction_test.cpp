#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/leapfrog.hpp"
#include "support/random_draws.hpp"
#include "support/rigid_scenes.hpp"

// O'Brien, Fisher, Lin 2001, sections 3.1 and 6.1: N-body systems, and light particles among heavy ones.
namespace slod::test {
namespace {

/// Every particle by itself, and walks of the tree whatever their number.
SimulationSettings attracting(double opening_angle)
{
    SimulationSettings settings = rigid_settings(1);
    settings.gravity.emplace();
    settings.gravity->opening = OpeningCriterion::Geometric;
    settings.gravity->opening_angle = opening_angle;
    settings.gravity->direct_below = 0;
    return settings;
}

/// Accelerations that the first forces give, as a first step's velocities from rest say them: half a step's
/// by these and half a step's by the next, which differ from these by some 1e-4.
std::vector<Vector3d> first_pulls(const SimulationSettings& settings, ParticleSet particles)
{
    for (Particle& particle : particles)
        particle.velocity.setZero();
    Simulation simulation(settings, particles, {});
    simulation.step({});
    std::vector<Vector3d> pulls;
    for (const Particle& particle : simulation.particles())
        pulls.push_back(particle.velocity / settings.time.step);
    return pulls;
}

// Each quadrupling adds no more to each particle's than the one before it; a tenth is left to chance.
TEST(Paper, A05_InteractionsPerParticleGrowNoFasterThanTheLogarithmOfTheirNumber)
{
    std::vector<double> interactions;
    for (const std::size_t number : {8000U, 32'000U, 128'000U}) {
        Simulation simulation(attracting(0.7), plummer_sphere(number, 1), {});
        interactions.push_back(double(simulation.step({}).counts.interactions) / double(number));
    }
    for (std::size_t i = 2; i < interactions.size(); ++i)
        EXPECT_LE(interactions[i] - interactions[i - 1], 1.1 * (interactions[i - 1] - interactions[i - 2]));
    EXPECT_LT(interactions.back(), 0.1 * 128'000) << "of all pairs";
}

TEST(Paper, A05_TheForceErrorFallsWithTheOpeningAngle)
{
    const ParticleSet particles = plummer_sphere(4000, 2);
    SimulationSettings direct = attracting(0.5);
    direct.gravity->direct_below = 100'000;
    const std::vector<Vector3d> exact = first_pulls(direct, particles);
    double last = std::numeric_limits<double>::infinity();
    for (const double angle : {1.0, 0.7, 0.5, 0.3}) {
        const std::vector<Vector3d> found = first_pulls(attracting(angle), particles);
        double largest = 0;
        for (std::size_t i = 0; i < exact.size(); ++i)
            largest = std::max(largest, (found[i] - exact[i]).norm() / exact[i].norm());
        EXPECT_LT(largest, last) << "opening angle " << angle;
        last = largest;
    }
}

/// Heavy particles, and after them light ones, at masses 1e6 apart, in the same ball.
ParticleSet heavy_and_light(std::size_t heavy, std::size_t light)
{
    ParticleSet particles = ball(heavy + light, 1, 0.3, 16);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles[i].mass = i < heavy ? 1e-2F : 1e-8F;
    return particles;
}

/// Light particles in a region of their own, which attracts as asked; both in clusters of at most `size`.
SimulationSettings separated(double size, Attracts light_attracts)
{
    SimulationSettings settings = rigid_settings(size);
    settings.background.max_breadth = 0.5;
    settings.gravity.emplace();
    settings.gravity->direct_below = 100'000;
    settings.regions = {world_region("light", size)};
    settings.regions[0].most_mass = 1e-5;
    settings.regions[0].partition.max_breadth = 0.5;
    settings.regions[0].partition.attracts = light_attracts;
    return settings;
}

// To the bit where nothing merges. Which of two clusters comes first in a merge depends on where in memory
// they are: then sums differ in their last bits, and offsets, half a unit long, in the rounding to float of
// each of some eight formings.
TEST(Paper, A16_HeavyParticlesMoveAsIfTheLightOnesThatTheyBypassWereNotThere)
{
    constexpr std::size_t heavy = 100, light = 300;
    for (const double size : {1.0, 4.0}) {
        for (const Attracts rule : {Attracts::Nothing, Attracts::OwnRegion}) {
            Simulation with(separated(size, rule), heavy_and_light(heavy, light), {});
            Simulation without(separated(size, rule), heavy_and_light(heavy, 0), {});
            for (int frame = 0; frame < 60; ++frame) {
                const Snapshot& snapshot = with.step({});
                without.step({});
                const std::uint64_t h = load_of(with, snapshot, "background").clusters;
                const std::uint64_t l = load_of(with, snapshot, "light").clusters;
                const std::uint64_t own = rule == Attracts::OwnRegion ? l * (l - 1) : 0;
                ASSERT_EQ(snapshot.counts.interactions, h * (h - 1) + l * h + own)
                    << "none of light on heavy";
            }
            const ParticleSet all = with.particles(), expected = without.particles();
            const ParticleSet found(all.begin(), all.begin() + heavy);
            EXPECT_LE(largest_distance(found, expected), size > 1 ? 8 * 0.5 * 0x1p-24 : 0) << size;
        }
    }
}

// Before the first frame no particle has moved: a run whose rule is changed then is one that began with it.
TEST(Paper, A16_AChangedRuleOfWhoAttractsWhomHoldsFromTheNextFrameOn)
{
    const ParticleSet particles = heavy_and_light(100, 300);
    Simulation changed(separated(1, Attracts::Everything), particles, {});
    Simulation begun(separated(1, Attracts::Nothing), particles, {});
    ASSERT_EQ(changed.change_region(separated(1, Attracts::Nothing).regions[0]), Problems{});
    run(changed, 1);
    run(begun, 1);
    EXPECT_EQ(largest_distance(changed.particles(), begun.particles()), 0);
}

// The heavy ones answer each other, to rounding, and nothing answers what the light ones are given: so much
// is missing from the momentum, at most their share of the mass.
TEST(Paper, A16_TheMomentumDroppedIsWhatTheLightOnesAreGiven)
{
    constexpr std::size_t heavy = 100, light = 300;
    const ParticleSet particles = heavy_and_light(heavy, light);
    SimulationSettings settings = separated(1, Attracts::Nothing);
    settings.gravity->precision = Precision::Double;
    Simulation simulation(settings, particles, {});
    const Vector3d before = simulation.snapshot({.conserved = true}).conserved.momentum;
    Vector3d reported(0, 0, 0), last = simulation.snapshot({}).unanswered_force;
    for (int frame = 0; frame < 60; ++frame) { // each frame's half kicks are by the old forces and the new
        const Vector3d unanswered = simulation.step({}).unanswered_force;
        reported += 0.5 * settings.time.step * (last + unanswered);
        last = unanswered;
    }
    const Vector3d dropped = simulation.snapshot({.conserved = true}).conserved.momentum - before;
    const ParticleSet after = simulation.particles();
    Vector3d given(0, 0, 0);
    double largest = 0, light_mass = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Vector3d change = after[i].velocity - particles[i].velocity;
        largest = std::max(largest, change.norm());
        if (i < heavy)
            continue;
        light_mass += double(particles[i].mass);
        given += double(particles[i].mass) * change;
    }
    // Velocities of order 1 and a mass of 1, rounded twice in each frame.
    EXPECT_LE((dropped - given).norm(), 60 * 2 * 0x1p-52);
    EXPECT_LE((dropped - reported).norm(), 60 * 4 * 0x1p-52);
    EXPECT_GT(dropped.norm(), 0.01 * light_mass * largest);
    EXPECT_LE(dropped.norm(), light_mass * largest);
}

// Instead of being ignored they may be grouped into much larger clusters.
TEST(Paper, A16_LightParticlesInMuchLargerClustersCostFewInteractions)
{
    constexpr std::size_t heavy = 100, light = 3000;
    SimulationSettings settings = separated(1, Attracts::Everything);
    settings.regions[0].partition.max_cluster_size = 64;
    settings.regions[0].partition.max_breadth = 2;
    Simulation simulation(settings, heavy_and_light(heavy, light), {});
    const Snapshot& snapshot = simulation.step({});
    EXPECT_EQ(load_of(simulation, snapshot, "background").clusters, heavy);
    EXPECT_LT(load_of(simulation, snapshot, "light").clusters, light / 20);
    EXPECT_LT(snapshot.counts.interactions, 8 * heavy * heavy);
}

/// Weightless bodies on circular orbits of radius 0.5 to 2 about a mass of 1, in all planes.
ParticleSet orbits(std::size_t count)
{
    ParticleSet particles(count + 1);
    particles[0] = {.position = {0, 0, 0}, .velocity = {0, 0, 0}, .id = 1, .mass = 1};
    for (std::size_t i = 1; i <= count; ++i) {
        Random random(8, 0, i);
        const Vector3d x = random_direction(random);
        const Vector3d along = x.cross(random_direction(random)).normalized();
        const double radius = 0.5 + 1.5 * random.uniform();
        particles[i] = {
            .position = radius * x, .velocity = along / std::sqrt(radius), .id = i + 1, .mass = 1e-9F};
    }
    return particles;
}

// On circular orbits the pull is 1 / r^2, so a region for pulls of 1 or more holds what is within a radius
// of 1. A cluster's pull is that at its centre, and a member keeps its cluster's when that is re-formed: a
// cluster of up to four of 2000 neighbours is some 0.3 wide there, and half of that off at most.
TEST(Paper, A11_AccelerationDividesWhatIsReformed)
{
    SimulationSettings settings = quiet_settings();
    settings.kinds[0].softening = 0.01;
    settings.gravity.emplace();
    settings.motion.longest_life = 4;
    settings.background.max_cluster_size = 4;
    settings.background.pool_factor = 1;
    RegionOfInterest pulled;
    pulled.name = "pulled";
    pulled.least_acceleration = 1;
    pulled.partition = settings.background;
    settings.regions = {pulled};
    Simulation simulation(settings, orbits(2000), {});
    run(simulation, 40);
    const Snapshot& snapshot = simulation.snapshot({.clusters = true});
    std::size_t inside = 0, outside = 0;
    for (std::size_t i = 0; i < snapshot.clusters.size(); ++i) {
        const double radius = snapshot.clusters.position[i].norm();
        const bool in_region = snapshot.clusters.region[i] != background_row;
        inside += in_region && radius < 0.8;
        outside += !in_region && radius > 1.2;
        if (snapshot.clusters.mass[i] < 0.5) {
            EXPECT_FALSE(in_region && radius > 1.2) << radius;
            EXPECT_FALSE(!in_region && radius < 0.8) << radius;
        }
    }
    EXPECT_GT(inside, 50U);
    EXPECT_GT(outside, 50U);
}

} // namespace
} // namespace slod::test
