#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/clouds.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Bouncing, resting and sliding over many frames, each particle by itself and in clusters of 64.
namespace slod::test {
namespace {

constexpr double fall = 9.81;

SimulationSettings among(const std::vector<ColliderSettings>& colliders, double step = 1.0 / 60)
{
    SimulationSettings settings = quiet_settings();
    settings.time.step = step;
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -fall}};
    settings.colliders = colliders;
    return settings;
}

ColliderSettings floor_with(double restitution, double friction)
{
    return with(plane({0, 0, 0}, {0, 0, 1}), restitution, friction);
}

void run(Simulation& simulation, int frames)
{
    for (int frame = 0; frame < frames; ++frame)
        simulation.step({});
}

std::uint64_t impacts_in(Simulation& simulation, int frames)
{
    std::uint64_t impacts = 0;
    for (int frame = 0; frame < frames; ++frame)
        impacts += simulation.step({}).counts.impacts;
    return impacts;
}

double energy(const Particle& particle)
{
    return 0.5 * particle.velocity.squaredNorm() + fall * particle.position.z();
}

// One from a height of 1, which takes 0.9 of a unit of time to be there again, 11 bounces in 40 frames.
TEST(BouncingParticle, F12_KeepsItsHeightForTenThousandElasticBounces)
{
    Simulation simulation(among({floor_with(1, 0)}, 0.25), {{{0, 0, 1}, {0, 0, 0}, 1, 1}}, {});
    EXPECT_GE(impacts_in(simulation, 36'200), 10'000U); // a bounce every 0.903 units of time
    EXPECT_NEAR(energy(simulation.particles().front()) / fall, 1, 1e-3);
}

// A cluster that is formed anew rounds offsets and relative velocities to float: at speeds of about 4, half
// an ulp is 2e-7 and changes the height by 2e-7 * 4 / 9.81 = 1e-7 a frame. Were they all of one sign, they
// would reach the bound after 10^4 frames; at random after 10^8. There are 4,200.
TEST(BouncingCluster, F12_KeepsItsHeightsForAThousandElasticBounces)
{
    const ParticleSet initial = ball(64, 0.3, 0.5, 1, {0, 0, 1});
    Simulation simulation(among({floor_with(1, 0)}, 0.25), initial, {});
    EXPECT_GE(impacts_in(simulation, 4200), 64'000U);
    const ParticleSet now = simulation.particles();
    for (std::size_t i = 0; i < now.size(); ++i)
        EXPECT_NEAR(energy(now[i]) / fall, energy(initial[i]) / fall, 1e-3) << "particle " << now[i].id;
}

// The flights of a ball of restitution e sum up to (1 + e) / (1 - e) times its first fall.
TEST(BouncingParticle, F15_ComesToRestWhenItsBouncesHaveSummedUp)
{
    const double step = 1.0 / 60, end = 19 * std::sqrt(2 / fall);
    Simulation simulation(among({floor_with(0.9, 0)}, step), {{{0, 0, 1}, {0, 0, 0}, 1, 1}}, {});
    int frames = 0;
    std::uint64_t most = 0;
    for (bool rests = false; !rests && frames < 1000; ++frames) {
        const FrameCounts& counts = simulation.step({}).counts;
        EXPECT_EQ(counts.impacts_cut_off, 0U) << "frame " << frames;
        most = std::max(most, counts.impacts);
        const Particle particle = simulation.particles().front();
        rests = particle.velocity.isZero(0) && particle.position.z() == 0;
    }
    EXPECT_NEAR(frames * step, end, 2 * step);
    EXPECT_LE(most, Colliders::most_meetings);
    run(simulation, 100);
    EXPECT_EQ(simulation.particles().front().position, Vector3d(0, 0, 0));
}

/// Particles that have come to rest, and where.
class Rest : public testing::TestWithParam<int> {
protected:
    ParticleSet initial() const { return ball(std::size_t(GetParam()), 0.3, 0.5, 2, {0.7, -0.4, 0.5}); }

    /// Expects that none moves any more in so many frames.
    static void expect_still(Simulation& simulation, int frames, double drift, double speed)
    {
        const ParticleSet before = simulation.particles();
        run(simulation, frames);
        const ParticleSet after = simulation.particles();
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < after.size(); ++i) {
            EXPECT_LE((after[i].position - before[i].position).norm(), drift) << "particle " << after[i].id;
            EXPECT_LE(after[i].velocity.norm(), speed) << "particle " << after[i].id;
        }
        EXPECT_EQ(simulation.problems(), Problems{});
    }
};

TEST_P(Rest, F16_LastsAHundredThousandFramesOnAPlane)
{
    Simulation simulation(among({floor_with(0.3, 0.5)}), initial(), {});
    for (int frame = 0; frame < 600; ++frame)
        ASSERT_EQ(simulation.step({}).counts.impacts_cut_off, 0U) << "frame " << frame;
    expect_still(simulation, 100'000, 1e-6, 1e-6);
    for (const Particle& particle : simulation.particles())
        EXPECT_NEAR(particle.position.z(), 0, 1e-7); // an offset of 0.7, rounded to float once
}

TEST_P(Rest, F17_LastsOnASlopeLessSteepThanItsFriction)
{
    const Vector3d normal(std::sin(M_PI / 6), 0, std::cos(M_PI / 6)); // tan 30 deg = 0.577
    Simulation simulation(among({with(plane({0, 0, 0}, normal), 0, 0.6)}), initial(), {});
    run(simulation, 1200);
    expect_still(simulation, 1000, 1e-4, 1e-4);
}

TEST_P(Rest, F17_TurnsIntoSlidingOnASteeperOne)
{
    const Vector3d normal(std::sin(M_PI / 6), 0, std::cos(M_PI / 6));
    const Vector3d down(std::cos(M_PI / 6), 0, -std::sin(M_PI / 6));
    const double friction = 0.3;
    Simulation simulation(among({with(plane({0, 0, 0}, normal), 0, friction)}), initial(), {});
    run(simulation, 60); // all have landed, and slide
    const ParticleSet before = simulation.particles();
    run(simulation, 60);
    const ParticleSet after = simulation.particles();
    const double expected = fall * (0.5 - friction * std::cos(M_PI / 6));
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_NEAR(down.dot(after[i].velocity - before[i].velocity), expected, 0.01 * expected);
        EXPECT_NEAR(normal.dot(after[i].position), 0, 1e-6);
    }
}

TEST_P(Rest, KeepsItsClusters)
{
    Simulation simulation(among({floor_with(0.3, 0.5)}), initial(), {});
    run(simulation, 600);
    const FrameCounts counts = simulation.step({}).counts;
    EXPECT_GT(counts.struck, 0U);
    EXPECT_EQ(counts.taken_apart, 0U);
    EXPECT_EQ(counts.impacts, 0U);
}

INSTANTIATE_TEST_SUITE_P(Particles, Rest, testing::Values(1, 64));

// Self-gravity acts by kicks at the ends of a frame, but on what may hit something all through it.
TEST(RestUnderKicks, LastsOnATableAboveWhatAttracts)
{
    SimulationSettings settings = quiet_settings();
    settings.gravity.emplace();
    settings.background.max_cluster_size = 1; // what shares a cluster with the heavy one does not feel it
    settings.colliders = {with(box({0, 0, -0.25}, {2, 2, 0.25}), 0.8, 0.5)};
    ParticleSet particles = ball(64, 0.2, 0, 3, {0, 0, 0.5});
    for (Particle& particle : particles)
        particle.mass = 1e-9F;
    particles.push_back({{0, 0, -2}, {0, 0, 0}, 65, 4});
    Simulation simulation(settings, particles, {});
    run(simulation, 3000);
    const ParticleSet before = simulation.particles();
    run(simulation, 1000);
    const ParticleSet after = simulation.particles();
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_LE((after[i].position - before[i].position).norm(), 1e-6) << "particle " << i;
        EXPECT_NEAR(after[i].position.z(), 0, 1e-12) << "particle " << i;
        EXPECT_LE(after[i].velocity.norm(), 1e-6) << "particle " << i;
    }
}

} // namespace
} // namespace slod::test
