#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/disc_measures.hpp"
#include "support/leapfrog.hpp"
#include "support/small_scenes.hpp"
#include "support/stellar_systems.hpp"

// Three bodies and a thousand: what comes back, what collapses, and what stays as it is.
namespace slod::test {
namespace {

constexpr double softening = 0.05;

SimulationSettings direct_settings(double step, double softening_length, Precision precision)
{
    SimulationSettings settings = quiet_settings();
    settings.time.step = step;
    settings.kinds.front().softening = softening_length;
    settings.gravity.emplace();
    settings.gravity->precision = precision;
    settings.gravity->direct_below = 1'000'000;
    settings.background.max_cluster_size = 1;
    return settings;
}

class FigureEight : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, FigureEight, testing::Values(Precision::Mixed, Precision::Double),
                         [](const auto& tested) {
                             return std::string(names(tested.param)[std::size_t(tested.param)]);
                         });

// A leapfrog's error of the phase grows with the square of the step and with time alone, as the orbit is
// stable: ten times as many turns take it ten times as far. A pull in float is wrong by 2^-24 in each step,
// which adds up as a random walk to 2^-24 sqrt(1e5) = 2e-5 of the speeds, without a tendency.
TEST_P(FigureEight, G06_Closes)
{
    constexpr int steps = 1000, turns = 100;
    const ParticleSet start = figure_eight();
    Simulation simulation(direct_settings(figure_eight_turn / steps, 0, GetParam()), start, {});
    const double energy = total_energy(start, 1, 0);
    double worst = 0, after_ten = 0;
    CaseCurve distances{"distance from the start", {}, {}};
    for (int now = 1; now <= turns; ++now) {
        for (int step = 0; step < steps; ++step) {
            simulation.step({});
            worst = std::max(worst, std::abs(total_energy(simulation.particles(), 1, 0) / energy - 1));
        }
        distances.x.push_back(now);
        distances.y.push_back(largest_distance(simulation.particles(), start));
        after_ten = now == 10 ? distances.y.back() : after_ten;
    }
    expect_at_most("largest error of the energy", worst, 5e-5);
    expect_at_most("distance from the start after ten turns", after_ten, 5e-3);
    expect_at_most("distance from the start after a hundred turns", distances.y.back(), 5e-2);
    report_picture({"Figure of eight", "turns", "distance from the start", {distances}});
}

// What the way back has rounded otherwise is 1e-16 a step, which the cloud's encounters amplify by less than
// a hundred in three units of time.
TEST(TimeReversal, G08_BringsAHundredStarsBack)
{
    const ParticleSet start = plummer_in_equilibrium(100, 1);
    const SimulationSettings settings = direct_settings(0x1p-6, softening, Precision::Double);
    const auto reversed_after = [&](const ParticleSet& initial) {
        Simulation simulation(settings, initial, {});
        for (int step = 0; step < 100; ++step)
            simulation.step({});
        ParticleSet particles = simulation.particles();
        for (Particle& particle : particles)
            particle.velocity = -particle.velocity;
        return particles;
    };
    const ParticleSet there = reversed_after(start), back = reversed_after(there);
    double velocities = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
        velocities = std::max(velocities, (back[i].velocity - start[i].velocity).norm());
    expect_at_least("farthest way gone", largest_distance(there, start), 1);
    expect_at_most("largest distance from the start", largest_distance(back, start), 1e-12);
    expect_at_most("largest error of a velocity", velocities, 1e-12);
}

/// A uniform sphere of 1000 stars at rest, of mass and radius 1.
ParticleSet cold_sphere()
{
    return cloud(1000, 9, [](Random& random) { return point_in_ball(random, 1); });
}

/// For so many times of free fall.
SystemHistory collapse(const SimulationSettings& settings, const std::string& name, double falls,
                       double& momentum)
{
    const ParticleSet start = cold_sphere();
    Simulation simulation(settings, start, {});
    SystemHistory history{name, {0}, {measure_system(start, softening)}};
    const double free_fall = 1.1107207345395915; // pi / 2 sqrt(R^3 / (2 G M))
    const int steps = int(std::ceil(falls * free_fall / settings.time.step));
    for (int step = 1; step <= steps; ++step) {
        simulation.step({});
        if (step % 20 != 0 && step != steps)
            continue;
        history.times.push_back(step * settings.time.step);
        history.looks.push_back(measure_system(simulation.particles(), softening));
        momentum = std::max(momentum, history.looks.back().momentum.norm());
    }
    for (const Particle& particle : simulation.particles())
        EXPECT_TRUE(particle.position.allFinite() && particle.velocity.allFinite()) << particle.id;
    return history;
}

double smallest_half_mass_radius(const SystemHistory& history)
{
    double smallest = INFINITY;
    for (const SystemMeasures& look : history.looks)
        smallest = std::min(smallest, look.r50);
    return smallest / history.looks.front().r50;
}

class ColdCollapse : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, ColdCollapse, testing::Values(Precision::Mixed, Precision::Double),
                         [](const auto& tested) {
                             return std::string(names(tested.param)[std::size_t(tested.param)]);
                         });

/// A float's rounding in each of the three factors of a pull; impulses inwards and outwards add up to twice
/// the sum of m |v| at the bounce, 3.
constexpr double mixed_momentum = 3 * 0x1p-24 * 2 * 3;

// Uniform noise lets a thousand stars collapse to N^(-1/3) = 0.1 of their radius (Aarseth, Lin and Papaloizou
// 1988, ApJ 324, 288). There, for a moment, half of the mass within 0.08 makes omega = 30, and a leapfrog's
// error oscillates by (omega step)^2 / 8 = 5e-4 of the kinetic energy, which is four times the total one.
TEST_P(ColdCollapse, G09_OfAThousandStarsKeepsEnergyAndMomentum)
{
    double momentum = 0;
    const bool in_double = GetParam() == Precision::Double;
    const SystemHistory history =
        collapse(direct_settings(0.002, softening, GetParam()), "single stars", in_double ? 2 : 5, momentum);
    expect_at_most("error of the energy after the bounce",
                   std::abs(history.change_at_the_end(&SystemMeasures::energy)), 3e-4);
    expect_at_most("error of the energy at the bounce", history.largest_change(&SystemMeasures::energy),
                   2e-3);
    expect_within("smallest half-mass radius, of the first", smallest_half_mass_radius(history), 0.05, 0.15);
    expect_at_most("largest momentum", momentum, in_double ? 1e-14 : mixed_momentum);
    report_history("Cold collapse", std::array{history});
}

class ClusteredCollapse : public testing::TestWithParam<Motion> {};

INSTANTIATE_TEST_SUITE_P(In, ClusteredCollapse, testing::Values(Motion::Flow, Motion::Rigid),
                         [](const auto& tested) {
                             return std::string(names(tested.param)[std::size_t(tested.param)]);
                         });

// What clusters of 64 do to a collapse that has a radius of fewer is no error of rounding, and shown.
TEST_P(ClusteredCollapse, G09_InClustersOf64StaysFiniteThroughTheBounce)
{
    SimulationSettings settings = direct_settings(0.002, softening, Precision::Mixed);
    settings.motion.motion = GetParam();
    settings.background.max_cluster_size = 64;
    double momentum = 0;
    const std::string name = "clusters, " + std::string(names(GetParam())[std::size_t(GetParam())]);
    const SystemHistory history = collapse(settings, name, 5, momentum);
    expect_at_most("largest momentum", momentum, mixed_momentum);
    report_value("smallest half-mass radius, of the first", smallest_half_mass_radius(history));
    report_value("largest error of the energy", history.largest_change(&SystemMeasures::energy));
    report_history("Cold collapse in clusters of 64", std::array{history});
}

} // namespace
} // namespace slod::test
