#include <cstring>
#include <ostream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/attracting_world.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/small_scenes.hpp"
#include "support/totals.hpp"

// What the walk costs, and what it keeps.
namespace slod::test {
namespace {

struct Fit {
    double slope = 0, explained = 0; ///< and R^2
};

Fit fit(const std::vector<double>& x, const std::vector<double>& y)
{
    const double n = double(x.size());
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    return {xy / xx, xy * xy / (xx * yy)};
}

// Sizes a factor of four apart, so that groups, which come by halving, have the same size in all.
TEST(GravityWalk, CostPerBodyGrowsAsTheLogarithmOfTheirNumber)
{
    std::vector<double> logarithms, per_body;
    for (const std::size_t count : {2'000U, 8'000U, 32'000U, 128'000U, 512'000U}) {
        AttractingWorld world(cloud(count, 1, [](Random& random) { return point_in_ball(random, 1); }));
        world.clusters().columns.tide = false;
        world.settings.direct_below = 0;
        world.settings.opening = OpeningCriterion::Geometric;
        world.settings.opening_angle = 0.7;
        logarithms.push_back(std::log10(double(count)));
        per_body.push_back(double(world.evaluate().interactions) / double(count));
    }
    const Fit line = fit(logarithms, per_body);
    EXPECT_GT(line.explained, 0.98);
    EXPECT_GT(line.slope, 0);
}

struct Summation {
    const char* name;
    bool walks;
    Multipoles multipoles = Multipoles::Monopole;

    friend std::ostream& operator<<(std::ostream& out, const Summation& summation)
    {
        return out << summation.name;
    }
};

class GravityMomentum : public testing::TestWithParam<Summation> {};

// A turning cloud by itself, every star by itself. The direct sum in double gains what 300 steps round.
TEST_P(GravityMomentum, G33_IsKept)
{
    const bool walks = GetParam().walks;
    SmallScene scene{"cloud", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = 1;
    scene.settings.gravity.emplace();
    scene.settings.gravity->multipoles = GetParam().multipoles;
    scene.settings.gravity->direct_below = walks ? 0 : 1'000'000;
    scene.settings.gravity->precision = walks ? Precision::Mixed : Precision::Double;
    add_cloud(scene.initial, {.count = walks ? 3'000U : 500U}, 1);
    for (Particle& particle : scene.initial)
        particle.velocity += 0.3 * Vector3d(-particle.position.y(), particle.position.x(), 0);
    const ConservedQuantities before = totals(scene.initial);
    double momentum_size = 0;
    for (const Particle& particle : scene.initial)
        momentum_size += double(particle.mass) * particle.velocity.norm();
    Simulation simulation(scene.settings, scene.initial, {});
    for (int step = 0; step < 300; ++step)
        simulation.step({});
    const double bound = walks ? 1e-3 : 1e-12;
    const ConservedQuantities after = totals(simulation.particles());
    expect_at_most("change of the momentum, of sum m |v|",
                   (after.momentum - before.momentum).norm() / momentum_size, bound);
    expect_at_most("relative change of the angular momentum",
                   (after.angular_momentum - before.angular_momentum).norm() / before.angular_momentum.norm(),
                   bound);
}

INSTANTIATE_TEST_SUITE_P(AllWays, GravityMomentum,
                         testing::Values(Summation{"Direct", false}, Summation{"WalkedByMonopoles", true},
                                         Summation{"WalkedByQuadrupoles", true, Multipoles::Quadrupole}),
                         [](const auto& tested) { return tested.param.name; });

TEST(GravityWalk, GivesTheSameBitsOnEveryInstructionSetAndAnyNumberOfThreads)
{
    AttractingWorld world = walked(plummer_sphere(5'000, 2));
    for (const Multipoles multipoles : {Multipoles::Monopole, Multipoles::Quadrupole}) {
        for (const Precision precision : {Precision::Mixed, Precision::Double}) {
            world.settings.multipoles = multipoles;
            world.settings.precision = precision;
            world.rebuild();
            world.evaluate_again();
            const AlignedVector<double> pulls = world.clusters().pull;
            world.evaluate();
            const std::vector<Vector3d> expected = world.by_id();
            for (const simd::KernelTable* kernels : simd::runnable_kernels()) {
                for (const int threads : {1, 2, 3, 8, 16}) {
                    world.clusters().pull = pulls;
                    ThreadTeam(threads).run([&] {
                        world.rebuild();
                        world.evaluate(*kernels);
                    });
                    const std::vector<Vector3d> found = world.by_id();
                    EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(Vector3d)), 0)
                        << names(multipoles)[std::size_t(multipoles)] << ", " << kernels->name << " on "
                        << threads;
                }
            }
        }
    }
}

// Masses of a galaxy in kilograms, lengths in anything: by powers of two nothing else changes, not even a
// bit.
TEST(GravityWalk, DoesTheSameInAnyUnits)
{
    const ParticleSet particles = plummer_sphere(4'000, 3);
    for (const OpeningCriterion opening : {OpeningCriterion::Geometric, OpeningCriterion::Relative}) {
        AttractingWorld here = walked(particles, 0.01);
        here.settings.opening = opening;
        const ForceCounts first_here = here.evaluate(), second_here = here.evaluate();
        for (const auto& [mass, length] : {std::pair{120, 0}, std::pair{120, 12}, std::pair{-90, -40}}) {
            ParticleSet scaled = particles;
            for (Particle& particle : scaled) {
                particle.position *= std::ldexp(1.0, length);
                particle.mass = std::ldexp(particle.mass, mass);
            }
            AttractingWorld there = walked(scaled, std::ldexp(0.01, length));
            there.settings.opening = opening;
            const ForceCounts first = there.evaluate(), second = there.evaluate();
            EXPECT_EQ(first.interactions, first_here.interactions) << mass << " " << length;
            EXPECT_EQ(second.interactions, second_here.interactions) << mass << " " << length;
            EXPECT_EQ(second.far_nodes, second_here.far_nodes);
            const std::vector<Vector3d> expected = here.by_id(), found = there.by_id();
            for (std::size_t i = 0; i < found.size(); ++i)
                ASSERT_EQ(found[i], expected[i] * std::ldexp(1.0, mass - 2 * length)) << i;
        }
    }
}

} // namespace
} // namespace slod::test
