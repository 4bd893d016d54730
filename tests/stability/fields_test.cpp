#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/field_tables.hpp"
#include "support/one_cluster.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Accelerations of place where they are singular, stiff or crowded: on one particle, and on 64 in a cluster.
namespace slod::test {
namespace {

class InFields : public testing::TestWithParam<Crowd> {
protected:
    /// The same for a cluster as for a particle, whatever they weigh.
    static ParticleSet start(const Vector3d& position, const Vector3d& velocity, double radius)
    {
        return about(GetParam().particles, position, velocity, radius, 5);
    }

    /// The longest way of the centre from a place, in so many frames.
    static double farthest(Simulation& simulation, const Vector3d& place, int frames)
    {
        double way = 0;
        for (int frame = 0; frame < frames; ++frame) {
            simulation.step({});
            way = std::max(way, (only_centre(simulation).position - place).norm());
        }
        return way;
    }
};

INSTANTIATE_TEST_SUITE_P(Crowds, InFields, testing::ValuesIn(crowds()), name_of);

// On the line nothing acts. A cluster's centre is off it by the rounding of a mean, 1e-15, which the core's
// rate of sqrt(strength) / core = 2 magnifies by e^(2 * 1.6 / sqrt 2) = 10 in 100 frames.
TEST_P(InFields, F08_AVortexLeavesWhatIsOnItsLineWhereItIs)
{
    SimulationSettings settings = settings_for(GetParam());
    settings.fields.of<Vortex>() = {{.position = {1, 2, 3}, .strength = 1, .core_radius = 0.5}};
    const Vector3d place(1, 2, 7);
    Simulation simulation(settings, start(place, {0, 0, 0}, 0.1), {});
    expect_at_most("way of the centre off the line", farthest(simulation, place, 100), 1e-12);
    for (const Particle& particle : simulation.particles())
        EXPECT_TRUE(particle.position.allFinite() && particle.velocity.allFinite());
}

// A spring of stiffness w^2 holds on any circle what turns at the rate w; on that of radius r, where
// k w r = s r / (r^2 + core^2), the vortex drives it as the drag k slows it down: farther out less, further
// in more. A frame turns it by w h = 0.098, and leapfrogs miss such a radius by about the square's twelfth,
// 1e-3.
TEST_P(InFields, F08_AVortexDrivesACircleForAHundredTurns)
{
    const double rate = 2 * std::numbers::pi, drag = 0.5, radius = 2, core = 0.5;
    SimulationSettings settings = settings_for(GetParam());
    settings.linear_drag = LinearDragSettings{drag};
    const Vector3d middle(10, 10, 10);
    settings.fields.of<Spring>() = {{.anchor = middle, .stiffness = rate * rate}};
    settings.fields.of<Vortex>() = {
        {.position = middle, .strength = drag * rate * (radius * radius + core * core), .core_radius = core}};
    Simulation simulation(settings, start(middle + Vector3d(radius, 0, 0), {0, rate * radius, 0}, 1e-3), {});
    double drift = 0;
    for (int frame = 0; frame < 6400; ++frame) {
        simulation.step({});
        drift = std::max(drift, std::abs((only_centre(simulation).position - middle).norm() / radius - 1));
    }
    expect_at_most("drift of the radius in 100 turns, share", drift, 0.01);
}

// What is at the attractor feels nothing; it binds a cluster's centre, which is off by the rounding of a
// mean.
TEST_P(InFields, F09_AnAttractorDoesNotMoveWhatIsAtItsPlace)
{
    const Vector3d place(3, 2, 1);
    SimulationSettings settings = settings_for(GetParam());
    settings.fields.of<Attractor>() = {{.position = place, .strength = 40, .softening = 0.3}};
    const bool alone = GetParam().particles == 1;
    Simulation simulation(settings, start(place, {0, 0, 0}, alone ? 0 : 0.01), {});
    if (alone)
        expect_at_most("way of a particle", farthest(simulation, place, 200), 0);
    else
        expect_at_most("way of the centre", farthest(simulation, place, 200), 1e-12);
    for (const Particle& particle : simulation.particles())
        EXPECT_TRUE(particle.position.allFinite() && particle.velocity.allFinite());
}

// Kicks and drifts keep v^2 + w^2 x^2 (1 - (w h)^2 / 4). What starts at rest is nowhere farther out than
// there, so that its energy v^2 + w^2 x^2 is nowhere larger, up to the w h of 2 beyond which scenes are
// refused.
TEST_P(InFields, F26_ASpringDoesNotGainEnergyHoweverStiff)
{
    const Vector3d anchor(11, 12, 13);
    for (const double turn : {0.1, 1.0, 1.99}) { // w h
        SimulationSettings settings = settings_for(GetParam());
        const double stiffness = std::pow(turn / settings.time.step, 2);
        settings.fields.of<Spring>() = {{.anchor = anchor, .stiffness = stiffness}};
        ASSERT_EQ(problems(settings), Problems{});
        Simulation simulation(settings, start(anchor + Vector3d(1, -1, 0.5), {0, 0, 0}, 1e-3), {});
        const auto energy = [&] {
            const Centre now = only_centre(simulation);
            return now.velocity.squaredNorm() + stiffness * (now.position - anchor).squaredNorm();
        };
        const double first = energy();
        double most = 0;
        for (int frame = 0; frame < 5000; ++frame) {
            simulation.step({});
            most = std::max(most, energy() / first);
        }
        expect_at_most("largest energy, of the first", most, 1 + 1e-9);
        EXPECT_GT(most, 0.9) << "it swings";
    }
    int refused = 0;
    for (const double turn : {2.0, 100.0}) {
        SimulationSettings settings = settings_for(GetParam());
        settings.fields.of<Spring>() = {{.stiffness = std::pow(turn / settings.time.step, 2)}};
        refused += problems(settings).empty() ? 0 : 1;
    }
    expect_at_least("scenes of w h = 2 and 100 refused", refused, 2);
}

TEST_P(InFields, F27_ASpringOfNoLengthDoesNothing)
{
    const Vector3d anchor(1, 2, 3);
    SimulationSettings settings = settings_for(GetParam());
    settings.fields.of<Spring>() = {{.anchor = anchor, .stiffness = 3.9 / std::pow(settings.time.step, 2)}};
    Simulation simulation(settings, start(anchor, {0, 0, 0}, 0), {});
    expect_at_most("way of the centre", farthest(simulation, anchor, 1000), 0);
    for (const Particle& particle : simulation.particles())
        expect_at_most("way of members", (particle.position - anchor).norm(), 0);
}

/// Ten thousand particles in one place under all that can act at once, in clusters of 16.
SimulationSettings all_at_once(Motion motion)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.motion = motion;
    settings.background.max_cluster_size = 16;
    settings.background.max_breadth = 1024;
    settings.gravity.emplace();
    settings.uniform_gravity.emplace();
    settings.linear_drag = LinearDragSettings{0.3};
    settings.quadratic_drag = QuadraticDragSettings{0.1};
    AllFields::for_each([&]<class F> { add_element(settings.fields.of<F>(), typename F::Settings{}); });
    settings.speed_limit = SpeedLimitSettings{50};
    settings.colliders = {with(plane({0, 0, 0}, {0.1, 0, 1}), 0.5, 0.2)};
    settings.sinks = {{.name = "far", .position = {0, 0, -1e6}}};
    return settings;
}

// A cluster looks at 256 others at most for those it merges with, a field is asked once for a cluster and
// once for a particle that flies by itself, and a particle has eight meetings at most in a frame. Planes that
// divide nothing are not laid again and again: particles are divided by number, into clusters that are half
// full on average. What has bounced is alone until clusters are formed anew or merge.
TEST(Crowding, F28_TenThousandCoincidentParticlesStayFiniteAndTheirWorkBounded)
{
    constexpr int count = 10'000;
    for (const Motion motion : {Motion::Flow, Motion::Rigid}) {
        ParticleSet initial(count, Particle{{0.3, 0.2, 0.5}, {1, -1, -3}, 0, 1e-4F});
        for (std::size_t i = 0; i < initial.size(); ++i)
            initial[i].id = i + 1;
        Simulation simulation(all_at_once(motion), initial, {});
        std::uint64_t impacts = 0;
        double before = count;
        for (int frame = 0; frame < 60; ++frame) {
            const FrameCounts& counts = simulation.step({}).counts;
            const auto clusters = double(counts.clusters);
            impacts += counts.impacts;
            if (impacts == 0)
                expect_at_most("clusters of 16 before an impact, share of the particles", clusters / count,
                               0.125);
            expect_at_most("others looked at for a merge, by cluster", double(counts.pair_tests) / before,
                           256);
            expect_at_most("impacts by particle", double(counts.impacts) / count, 8);
            expect_at_most("pairs summed, of all", double(counts.interactions) / (clusters * clusters), 1);
            for (const FieldCount& field : counts.fields)
                expect_at_most("evaluations of a field by particle", double(field.clusters) / count, 2);
            before = clusters;
        }
        EXPECT_GT(impacts, std::uint64_t(count));
        EXPECT_EQ(simulation.problems(), Problems{});
        int lost = 0;
        const ParticleSet particles = simulation.particles();
        for (const Particle& particle : particles)
            lost += particle.position.allFinite() && particle.velocity.allFinite() ? 0 : 1;
        expect_at_most("particles without a finite place and velocity", lost, 0);
        EXPECT_EQ(particles.size(), initial.size());
    }
}

} // namespace
} // namespace slod::test
