#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/leapfrog.hpp"
#include "support/small_scenes.hpp"

// The limits of clustering, where the outcome is known from elsewhere: every particle by itself, pairs, and
// one cluster for everything.
namespace slod::test {
namespace {

constexpr int frame_count = 40;
const Vector3d middle(512, 512, 512); ///< of a cell of side 1024

/// What the roundings of positions in [512, 1024) can add up to: half a unit in the last place, 2^-44, in
/// each coordinate and frame.
const double position_rounding = frame_count * std::sqrt(3) * 0x1p-44;

/// Self-gravity of two kinds in clusters of `max_cluster_size`.
SimulationSettings attracting(double max_cluster_size)
{
    SimulationSettings settings = quiet_settings();
    settings.kinds = {{"star", 0.25}, {"dust", 0.5}}; // with squares that are kept exactly
    settings.gravity.emplace();
    settings.gravity->precision = Precision::Double;
    settings.background.max_cluster_size = max_cluster_size;
    settings.background.max_breadth = 1024;
    return settings;
}

/// A cloud of heavy stars and one of light dust within it, and no two particles of quite the same mass.
ParticleSet stars_and_dust(std::uint32_t stars, std::uint32_t dust)
{
    ParticleSet particles;
    add_cloud(particles, {.count = stars, .mass = 0.9, .centre = middle, .velocity = {0.3, 0.1, 0}}, 1);
    add_cloud(particles, {.count = dust, .mass = 0.1, .centre = middle, .velocity = {0.3, 0.1, 0}, .kind = 1},
              2);
    for (Particle& particle : particles)
        particle.mass *= 1 + 1e-3F * float(particle.id);
    return particles;
}

ParticleSet run(const SimulationSettings& settings, const ParticleSet& initial, int frames = frame_count)
{
    Simulation simulation(settings, initial, {});
    for (int frame = 0; frame < frames; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.problems(), Problems{});
    return simulation.particles();
}

/// Position and velocity of the centre of mass.
std::pair<Vector3d, Vector3d> centre_of(const ParticleSet& particles)
{
    double mass = 0;
    Vector3d position(0, 0, 0), velocity(0, 0, 0);
    for (const Particle& particle : particles) {
        mass += double(particle.mass);
        position += double(particle.mass) * (particle.position - middle);
        velocity += double(particle.mass) * particle.velocity;
    }
    return {middle + position / mass, velocity / mass};
}

// Differences grow by the tides: a star's is 5e-3 / 0.25^3 = 0.3 at most, and some forty within a softening
// length make 12, which in 0.6 of time amplifies by less than exp(0.6 sqrt(12)) = 8. What is amplified is the
// rounding of positions; in mixed precision that of the pulls too, a few units of 2^-24 of accelerations of
// order 1, which act for half of 0.6^2.
TEST(UnclusteredParticles, FollowALeapfrogOfFreeOnes)
{
    const ParticleSet initial = stars_and_dust(200, 100);
    SimulationSettings settings = attracting(1);
    const ParticleSet free = leapfrog(initial, settings, frame_count);
    EXPECT_LE(largest_distance(run(settings, initial), free), 8 * position_rounding);
    settings.gravity->precision = Precision::Mixed;
    EXPECT_LE(largest_distance(run(settings, initial), free), 8 * 4 * 0x1p-24 * 0.18);
}

// Whatever the motion and the fraction: one particle per cluster is one road.
TEST(UnclusteredParticles, MoveAlikeBelowTwoPerCluster)
{
    const ParticleSet initial = stars_and_dust(200, 100);
    const ParticleSet expected = run(attracting(1), initial);
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid}) {
        for (const double size : {1.0, 1.5, 1.99}) {
            SimulationSettings settings = attracting(size);
            settings.motion.motion = motion;
            EXPECT_EQ(largest_distance(run(settings, initial), expected), 0) << size << " per cluster";
        }
    }
}

TEST(UnclusteredParticles, KeepIdsKindsAndMasses)
{
    const ParticleSet initial = stars_and_dust(200, 100);
    const ParticleSet particles = run(attracting(1), initial);
    for (std::size_t i = 0; i < initial.size(); ++i)
        EXPECT_EQ(std::tie(particles[i].id, particles[i].kind, particles[i].mass),
                  std::tie(initial[i].id, initial[i].kind, initial[i].mass));
}

TEST(ClusteredParticles, KeepIdsKindsAndMassesThroughEveryReforming)
{
    const ParticleSet initial = stars_and_dust(2000, 1000);
    for (const double size : {2, 16, 64}) {
        const ParticleSet particles = run(attracting(size), initial);
        ASSERT_EQ(particles.size(), initial.size());
        for (std::size_t i = 0; i < initial.size(); ++i)
            EXPECT_EQ(std::tie(particles[i].id, particles[i].kind, particles[i].mass),
                      std::tie(initial[i].id, initial[i].kind, initial[i].mass));
    }
}

/// Mean distance of the particles of two runs.
double mean_distance(const ParticleSet& a, const ParticleSet& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i].position - b[i].position).norm();
    return sum / double(a.size());
}

// Smaller clusters are better linearised. A quarter of the size halves the distance, or better, here.
TEST(ClusteredParticles, AreTheNearerToFreeOnesTheSmallerTheirClusters)
{
    const ParticleSet initial = stars_and_dust(2000, 1000);
    const ParticleSet free = run(attracting(1), initial);
    double previous = INFINITY;
    for (const double size : {128, 32, 8, 2}) {
        const double distance = mean_distance(run(attracting(size), initial), free);
        EXPECT_LT(distance, previous) << size << " per cluster";
        previous = distance;
    }
}

TEST(PairsOfParticles, AreTheLargestClustersOfMaximumSizeTwo)
{
    Simulation simulation(attracting(2), stars_and_dust(2000, 1000), {});
    for (int frame = 0; frame < frame_count; ++frame) {
        const ClusterStates& clusters = simulation.step({.clusters = true}).clusters;
        EXPECT_EQ(std::ranges::max(clusters.count), 2U);
    }
}

class OneCluster : public testing::TestWithParam<Motion> {};

TEST_P(OneCluster, HasTheCentreOfMassOfItsMembersInLinearFields)
{
    SimulationSettings settings = attracting(1e6);
    settings.motion.motion = GetParam();
    settings.gravity.reset();
    settings.uniform_gravity = UniformGravitySettings{{0.5, 1, -9.81}};
    settings.linear_drag = LinearDragSettings{0.7};
    settings.uniform_wind = UniformWindSettings{{3, -2, 1}};
    const ParticleSet initial = stars_and_dust(2000, 1000);
    Simulation simulation(settings, initial, {});
    const auto [start, speed] = centre_of(initial);
    const double k = settings.linear_drag->rate;
    const Vector3d terminal = settings.uniform_wind->velocity + settings.uniform_gravity->acceleration / k;
    for (int frame = 1; frame <= frame_count; ++frame) {
        EXPECT_EQ(simulation.step({}).counts.clusters, 1U);
        const double time = frame * settings.time.step;
        const Vector3d there = start - std::expm1(-k * time) / k * (speed - terminal) + time * terminal;
        const auto [now, velocity] = centre_of(simulation.particles());
        EXPECT_LE((now - there).norm(), position_rounding) << "frame " << frame;
        EXPECT_LE((velocity - terminal - std::exp(-k * time) * (speed - terminal)).norm(), 1e-12);
    }
}

std::string motion_of(const testing::TestParamInfo<Motion>& info)
{
    return std::string(names(info.param)[std::size_t(info.param)]);
}

INSTANTIATE_TEST_SUITE_P(Motions, OneCluster, testing::Values(Motion::Flow, Motion::Stream, Motion::Rigid),
                         motion_of);

// Nothing outside attracts it, and its own closure cannot move its centre.
TEST(OneCluster, MovesStraightOnWhateverItsSelfGravity)
{
    const ParticleSet initial = stars_and_dust(2000, 1000);
    const auto [start, speed] = centre_of(initial);
    const auto [now, velocity] = centre_of(run(attracting(1e6), initial));
    EXPECT_LE((now - start - frame_count * attracting(1e6).time.step * speed).norm(), position_rounding);
    EXPECT_LE((velocity - speed).norm(), 1e-12);
}

/// Ids of the living after each frame, of particles that die one per frame, every other one never.
void expect_deaths_on_time(SimulationSettings settings)
{
    ParticleSet initial = stars_and_dust(60, 0);
    for (std::size_t i = 0; i < initial.size(); i += 2)
        initial[i].expiry_frame = std::uint32_t(1 + i / 2);
    Simulation simulation(settings, initial, {});
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = false, .conserved = true});
        EXPECT_EQ(snapshot.counts.died, frame <= 30 ? 1U : 0U) << "frame " << frame;
        double mass = 0;
        const ParticleSet living = simulation.particles();
        for (const Particle& particle : living) {
            EXPECT_GT(particle.expiry_frame, frame);
            mass += double(particle.mass);
        }
        EXPECT_EQ(living.size(), 60 - std::min(frame, 30U)) << "frame " << frame;
        EXPECT_NEAR(snapshot.conserved.mass, mass, 1e-12);
    }
    EXPECT_EQ(simulation.problems(), Problems{});
}

TEST(Lifetimes, EndOnTimeUnclustered)
{
    expect_deaths_on_time(attracting(1));
}

TEST(Lifetimes, EndOnTimeInClusters)
{
    expect_deaths_on_time(attracting(16));
    SimulationSettings rigid = attracting(16);
    rigid.motion.motion = Motion::Rigid;
    expect_deaths_on_time(rigid);
}

TEST(Lifetimes, F34_OfNoLengthOrNoRateGiveNoParticles)
{
    SimulationSettings settings = attracting(16);
    settings.emitters = {jet("stillborn"), jet("silent")};
    settings.emitters[0].lifetime = 0;
    settings.emitters[1].rate = 0;
    Simulation simulation(settings, {}, {});
    for (int frame = 0; frame < frame_count; ++frame)
        expect_at_most("particles", double(simulation.step({}).counts.particles), 0);
}

TEST(SimulationStep, HandsOutClustersOfTheFramesTheyAreAskedForInAlone)
{
    Simulation simulation(attracting(8), stars_and_dust(30, 30), {});
    EXPECT_EQ(simulation.step({.clusters = true}).clusters.size(), simulation.snapshot({}).counts.clusters);
    EXPECT_EQ(simulation.step({}).clusters.size(), 0U);
}

/// Steps until nobody is left; what was taken out meanwhile.
Quarantined run_dry(Simulation& simulation)
{
    Quarantined taken;
    for (int frame = 0; frame < 1000 && simulation.snapshot({}).counts.particles > 0; ++frame) {
        const Snapshot& now = simulation.step({.clusters = true});
        for (const Vector3d& x : now.clusters.position)
            EXPECT_TRUE(in_range(x, scene_range(simulation.settings()))) << "frame " << frame;
        EXPECT_EQ(now.quarantined.particles, now.counts.quarantined);
        EXPECT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
        taken += now.quarantined;
    }
    return taken;
}

TEST(SimulationStep, TakesOutParticlesThatLeaveTheRangeOfNumbers)
{
    for (const Motion motion : {Motion::Flow, Motion::Rigid}) {
        SimulationSettings settings = attracting(8);
        settings.motion.motion = motion;
        settings.gravity->strength = 1e30;
        settings.time.step = motion == Motion::Flow ? 1e12 : 1e200;
        Simulation simulation(settings, stars_and_dust(30, 30), {});
        const Quarantined taken = run_dry(simulation);
        EXPECT_EQ(taken.particles, 60U) << names(motion)[std::size_t(motion)];
        EXPECT_EQ(taken.ids().size(), Quarantined::most_named);
    }
}

// Nothing is updated there: particles only fly.
TEST(SimulationStep, TakesOutUnclusteredParticlesThatLeaveTheRangeOfNumbers)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 1;
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -1e307}};
    Simulation simulation(settings, stars_and_dust(3, 3), {});
    ASSERT_FALSE(simulation.plan().has(Phase::Update));
    EXPECT_EQ(run_dry(simulation).particles, 6U);
}

} // namespace
} // namespace slod::test
