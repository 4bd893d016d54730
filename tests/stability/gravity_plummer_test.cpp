#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gravity/potential.hpp"
#include "sim/simulation.hpp"
#include "support/attracting_world.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/small_scenes.hpp"
#include "support/stellar_systems.hpp"

// A Plummer sphere, whose field is known, and which stays as it is.
namespace slod::test {
namespace {

// Five crossing times are a fifth of the relaxation time of two thousand stars, 0.1 N / ln N = 26. The
// half-mass radius at one moment is off by 0.5 / sqrt(N) of the mass, 2 % in radius, which the mean over the
// run has not; that of the model is 0.7584, as what is cut off holds 1.5 % of the mass.
TEST(PlummerSphere, G10_OfTwoThousandStarsStaysInBalanceForFiveCrossings)
{
    constexpr double softening = 0.05, model = 0.7584;
    SimulationSettings settings = quiet_settings();
    settings.kinds.front().softening = softening;
    settings.gravity.emplace();
    settings.gravity->direct_below = 1'000'000;
    settings.background.max_cluster_size = 1;
    const ParticleSet start = plummer_in_equilibrium(2000, 1);
    Simulation simulation(settings, start, {});
    SystemHistory history{"single stars", {0}, {measure_system(start, softening)}};
    double mean_r50 = 0;
    const int steps = int(std::ceil(5 * crossing_time / settings.time.step));
    for (int step = 1; step <= steps; ++step) {
        simulation.step({});
        if (step % 50 != 0)
            continue;
        history.times.push_back(step * settings.time.step);
        history.looks.push_back(measure_system(simulation.particles(), softening));
        expect_within("2 K / |W|", history.looks.back().virial_ratio, 0.95, 1.05);
        mean_r50 += (history.looks.back().r50 - mean_r50) / double(history.looks.size() - 1);
    }
    expect_within("mean half-mass radius, of the model's", mean_r50 / model, 0.95, 1.05);
    expect_at_most("largest error of the energy", history.largest_change(&SystemMeasures::energy), 1e-4);
    report_history("Plummer sphere of 2,000 stars", std::array{history});
}

constexpr std::size_t count = 30'000;
constexpr double cut = 10; // of plummer_sphere(), in scale lengths
const double mass_within_cut = std::pow(1 + 1 / (cut * cut), -1.5);

struct Shell {
    double inner, outer;

    bool holds(const Vector3d& place) const { return place.norm() >= inner && place.norm() < outer; }
};

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// What lies beyond the cut does not pull, and the rest has all of the mass.
TEST(PlummerSphere, G11_HasItsAnalyticPulls)
{
    AttractingWorld world = walked(plummer_sphere(count, 21));
    world.evaluate_again();
    for (const Shell& shell : {Shell{0.2, 0.5}, Shell{0.5, 1}, Shell{1, 2}}) {
        std::vector<double> ratios;
        for (std::size_t body = 0; body < count; ++body) {
            const Vector3d& place = world.bodies[body].position;
            const double exact = place.norm() * std::pow(1 + place.squaredNorm(), -1.5) / mass_within_cut;
            if (shell.holds(place))
                ratios.push_back(-world.acceleration(body).dot(place.normalized()) / exact);
        }
        expect_within("median pull, of the exact one", median(ratios), 0.95, 1.05);
    }
}

// The energy of all pairs is quadratic in the masses of a shell's bodies, so that its difference between
// twice those masses and none is twice the sum of m phi over the shell.
TEST(PlummerSphere, G11_HasItsAnalyticPotential)
{
    AttractingWorld world(plummer_sphere(count, 21), 0.01);
    const double beyond = std::pow(1 + cut * cut, -1.5); // the potential that the rest would make
    const Shell shell{0.2, 2};
    double exact = 0;
    for (const PointMass& body : world.bodies)
        if (shell.holds(body.position))
            exact -= body.mass * (1 / std::sqrt(1 + body.position.squaredNorm()) - beyond) / mass_within_cut;
    const auto energy = [&](float factor) {
        ForceView view = world.view;
        for (std::size_t body = 0; body < count; ++body)
            if (shell.holds(world.bodies[body].position))
                view.mass[body] *= factor;
        return potential_energy(view, simd::kernels(), 1);
    };
    expect_within("mean potential, of the exact one", 0.5 * (energy(2) - energy(0)) / exact, 0.97, 1.03);
}

} // namespace
} // namespace slod::test
