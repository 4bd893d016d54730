#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/default_fields.hpp"
#include "support/one_cluster.hpp"
#include "support/small_scenes.hpp"

// How particles move in each effect of place, against what its differential equation gives: exactly where the
// leapfrog's own solution is known. Angles below are those it turns by in a frame.
namespace slod::test {
namespace {

constexpr double rounding = 0x1p-52;

template <class F>
SimulationSettings settings_with(const typename F::Settings& element)
{
    SimulationSettings settings = settings_for({});
    add_element(settings.fields.of<F>(), element);
    return settings;
}

ParticleSet one(const Vector3d& position, const Vector3d& velocity)
{
    return {{position, velocity, 0, 1}};
}

Particle run_one(const SimulationSettings& settings, const ParticleSet& initial, int frames)
{
    Simulation simulation(settings, initial, {});
    for (int frame = 0; frame < frames; ++frame)
        simulation.step({});
    return simulation.particles().front();
}

// Kicks and drifts in a linear field are a rotation by theta, cos theta = 1 - k h^2 / 2, sheared: after n
// frames x = x0 cos n theta + v0 h sin n theta / sin theta.
TEST(SpringMotion, F26_IsTheHarmonicOneForEveryMemberOfACluster)
{
    constexpr int frames = 200;
    const double stiffness = 9;
    const SimulationSettings settings = settings_with<Spring>({.anchor = {1, 0, 0}, .stiffness = stiffness});
    const double h = settings.time.step;
    const double theta = std::acos(1 - 0.5 * stiffness * h * h);
    const Vector3d anchor(1, 0, 0);
    const auto expected = [&](const Particle& start) -> Vector3d {
        return anchor + std::cos(frames * theta) * (start.position - anchor) +
               h * std::sin(frames * theta) / std::sin(theta) * start.velocity;
    };
    const ParticleSet alone = one({2, 1, 1}, {0.3, -0.2, 0.1});
    // A frame adds some eight roundings of coordinates below 4, and turns those before.
    expect_at_most("distance from the closed form, one particle",
                   (run_one(settings, alone, frames).position - expected(alone.front())).norm(),
                   frames * 32 * rounding);

    const ParticleSet many = about(64, {2, 1, 1}, {0.3, -0.2, 0.1}, 0.5);
    Simulation simulation(settings, many, {});
    EXPECT_EQ(simulation.snapshot({}).counts.clusters, 1U);
    for (int frame = 0; frame < frames; ++frame)
        simulation.step({});
    // Maps and offsets are rounded to float: four operations a frame on offsets of 1 at most.
    for (const Particle& particle : simulation.particles())
        expect_at_most("distance from the closed form, members",
                       (particle.position - expected(many[particle.id - 1])).norm(), frames * 4 * 0x1p-24);
}

// On a circle the leapfrog turns by theta, cos theta = 1 - w^2 h^2 / 2, if it is started at r sin theta / h.
TEST(AttractorMotion, StaysOnACircleForAHundredTurns)
{
    const AttractorSettings sun{.position = {3, 2, 1}, .strength = 40, .softening = 0.3};
    const SimulationSettings settings = settings_with<Attractor>(sun);
    const double h = settings.time.step, r = 2;
    const double rate_squared = sun.strength / std::pow(r * r + 0.09, 1.5);
    const double theta = std::acos(1 - 0.5 * rate_squared * h * h);
    const auto frames = int(100 * 2 * std::numbers::pi / theta);
    const Particle end =
        run_one(settings, one(sun.position + Vector3d(r, 0, 0), {0, r * std::sin(theta) / h, 0}), frames);
    const Vector3d expected =
        sun.position + r * Vector3d(std::cos(frames * theta), std::sin(frames * theta), 0);
    // Roundings of a frame are some ten of 4; they turn an orbit at a rate that differs, so that they grow
    // with the square of the frames: by three times the angle.
    EXPECT_LE((end.position - expected).norm(), 40 * rounding * frames * (1 + 3 * frames * theta));
}

// In the core the acceleration is linear, i k z of a complex place: z = z0 cosh n l + v0 h sinh n l / sinh l
// with cosh l = 1 + i k h^2 / 2.
TEST(VortexMotion, F08_SpiralsOutOfTheCore)
{
    const VortexSettings vortex{.strength = 2e8, .core_radius = 1e4};
    const SimulationSettings settings = settings_with<Vortex>(vortex);
    const double h = settings.time.step, k = 2;
    constexpr int frames = 100;
    using Complex = std::complex<double>;
    const Complex l = std::acosh(1.0 + Complex(0, 0.5 * k * h * h));
    const Complex z0(1, 0.5), v0(0.1, -0.3);
    const Complex expected =
        z0 * std::cosh(double(frames) * l) + v0 * h * std::sinh(double(frames) * l) / std::sinh(l);
    const Particle end =
        run_one(settings, one({z0.real(), z0.imag(), 0.3}, {v0.real(), v0.imag(), 0}), frames);
    // The core is not wholly linear: by (r / core)^2 with r below 4; acosh near 1 loses half its digits.
    expect_at_most("distance from the closed form",
                   std::abs(Complex(end.position.x(), end.position.y()) - expected), 4 * 16e-8 + 1e-7);
    EXPECT_EQ(end.position.z(), 0.3);
}

TEST(BuoyancyMotion, RisesLikeAParabolaInDeepWater)
{
    SimulationSettings settings = settings_with<Buoyancy>({.level = 100, .lift = 15});
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -10}};
    const double time = 64 * settings.time.step;
    const Particle end = run_one(settings, one({0, 0, 0}, {1, 0, -2}), 64);
    EXPECT_NEAR(end.position.z(), -2 * time + 2.5 * time * time, 64 * 16 * rounding);
    EXPECT_NEAR(end.position.x(), time, 64 * 16 * rounding);
}

// The leapfrog's energy is off by (w h)^2 / 8 of the largest energy at most, w^2 the steepest lift's
// slope, 1.5 lift / transition; with drag it is no less off.
TEST(BuoyancyMotion, F29_BobsWithAnEnergyThatDragOnlyTakes)
{
    const BuoyancySettings water{.lift = 20, .transition = 1};
    SimulationSettings settings = settings_with<Buoyancy>(water);
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -10}};
    settings.linear_drag = LinearDragSettings{0.5};
    CasePicture picture{.title = "Bobbing in water with drag",
                        .x_axis = "time",
                        .y_axis = "energy per mass, length^2 / time^2",
                        .curves = {}};
    for (const ParticleSet& initial :
         {one({0, 0, 1.5}, {0, 0, 0}), about(64, {0, 0, 1.5}, {0, 0, 0}, 0.02)}) {
        Simulation simulation(settings, initial, {});
        const double h = settings.time.step, mass = double(initial.size());
        const auto energy = [&] {
            const Snapshot& now = simulation.snapshot({.conserved = true, .potential_energy = true});
            return (now.conserved.kinetic_energy + now.potential_energy) / mass;
        };
        double least = energy();
        std::vector<double> time, energies;
        const double tolerance = 30 * h * h / 8 * (least + 5); // the energy at rest is above -5
        for (int frame = 0; frame < 2000; ++frame) {
            simulation.step({});
            const double now = energy();
            expect_at_most("energy gained over the least so far, of 15", now - least, tolerance);
            least = std::min(least, now);
            if (frame < 600) {
                time.push_back(frame * h);
                energies.push_back(now);
            }
        }
        // Half of it is under water where gravity and lift cancel; drag has taken exp(-k t / 2), 4e-4.
        for (const Particle& particle : simulation.particles())
            expect_at_most("height at rest off the level", std::abs(particle.position.z()), 0.001);
        picture.curves.push_back({initial.size() == 1 ? "one particle" : "64 in a cluster", time, energies});
    }
    report_picture(picture);
}

template <class F>
class MotionIn : public testing::Test {};

TYPED_TEST_SUITE(MotionIn, TestTypes<ForceFields>::Types, FieldName);

// Were the mass of the cluster taken for that of a particle, it would be 64 times as fast. Members within
// 1e-3 move it by second derivatives of order 1 to 10, times half the square.
TYPED_TEST(MotionIn, F03_CarriesAClusterOf64AsOneParticle)
{
    const SimulationSettings settings = settings_with<TypeParam>({});
    const Vector3d x(0.6, 0.5, 0.1), v(0.2, -0.1, 0.15);
    const Particle alone = run_one(settings, one(x, v), 100);
    Simulation simulation(settings, about(64, x, v, 1e-3), {});
    EXPECT_EQ(simulation.snapshot({}).counts.clusters, 1U);
    for (int frame = 0; frame < 100; ++frame)
        simulation.step({});
    Vector3d centre(0, 0, 0);
    for (const Particle& particle : simulation.particles())
        centre += particle.position / 64;
    expect_at_most("distance of the centre from one particle", (centre - alone.position).norm(), 1e-5);
    EXPECT_GT((alone.position - x - 100 * settings.time.step * v).norm(), 0.05) << "it does not only drift";
}

// What leapfrog conserves differs from the energy by h^2 (v . G v / 12 + a^2 / 24) and terms of h^4, G the
// potential's second derivative (Hairer, Lubich and Wanner 2006, IX.3): at most so at both ends.
TYPED_TEST(MotionIn, KeepsItsEnergyWhereItHasAPotential)
{
    if constexpr (HasPotential<TypeParam>) {
        const SimulationSettings settings = settings_with<TypeParam>({});
        const FieldSet<ForceFields> field(settings.fields, {});
        Simulation simulation(settings, one({0.6, 0.5, 0.1}, {0.2, -0.1, 0.15}), {});
        const double h = settings.time.step;
        double start = 0, largest = 0, bound = 0;
        for (int frame = 0; frame < 2000; ++frame) {
            const Snapshot& now =
                simulation.step({.clusters = true, .conserved = true, .potential_energy = true});
            const double energy = now.conserved.kinetic_energy + now.potential_energy;
            const FieldValue here = field.at(now.clusters.position.front(), 0);
            const double speed = now.clusters.velocity.front().norm();
            if (frame == 0)
                start = energy;
            largest = std::max(largest, std::abs(energy - start));
            bound = std::max(
                bound, h * h * (speed * speed * here.gradient.norm() / 12 + here.value.squaredNorm() / 24));
        }
        EXPECT_LE(largest, 2.1 * bound + 2000 * 16 * rounding);
    }
}

} // namespace
} // namespace slod::test
