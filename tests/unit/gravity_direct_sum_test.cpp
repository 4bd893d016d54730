#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "gravity/forces.hpp"
#include "gravity/potential.hpp"
#include "support/clouds.hpp"
#include "support/direct_sum_oracle.hpp"
#include "support/little_worlds.hpp"

namespace slod {
namespace {

constexpr double float_rounding = 0x1p-24;
constexpr double double_rounding = 0x1p-53;
constexpr double G = 2.5;

/// A scene of single particles, its force view, and what the oracle needs of it.
class Scene {
public:
    explicit Scene(const ParticleSet& particles, double softening = 0.1, double cell_side = 4)
        : world({MapKind::Identity, 0, 1}, {}, {.max_cluster_size = 16}, cell_side)
    {
        world.store.kind_softening_squared = {softening * softening};
        for (const Particle& particle : particles)
            world.add({particle});
        measure_shapes(world.store, settings, G, 0);
        build(view, world.tree, clusters(), settings);
        for (std::size_t body = 0; body < view.body_count(); ++body)
            bodies.push_back({view.position(body), view.mass[body], view.q[body]});
    }

    ClusterTable& clusters() { return world.store.clusters; }
    const Vector3d& acceleration(std::size_t body) { return clusters().acceleration[view.slot[body].index]; }
    Matrix3d tide(std::size_t body) { return clusters().tide[view.slot[body].index].matrix(); }

    void sum(Precision precision, const simd::KernelTable& kernels = simd::kernels())
    {
        settings.precision = precision;
        evaluate_gravity(view, kernels, settings, G, lists, clusters());
    }

    Vector3d exact(std::size_t body) const
    {
        return test::acceleration_at(bodies[body].position, bodies[body].q, bodies, G, &bodies[body]);
    }

    /// What `rounding` of each pair's terms, and of all places relative to ones `reach` away, can amount
    /// to. A pull's own size is rounded some ten times, and up to 512 are summed before the sum goes to a
    /// double: a random walk of 23, and some more as terms alike are rounded alike. A displaced place
    /// changes it by 2 / r of itself.
    double tolerance(std::size_t body, double rounding, double reach) const
    {
        double sum = 0;
        for (const test::PointMass& other : bodies) {
            const double square =
                (other.position - bodies[body].position).squaredNorm() + bodies[body].q + other.q;
            if (&other != &bodies[body])
                sum +=
                    G * other.mass / square * (50 * rounding + 2 / std::sqrt(square) * 4 * rounding * reach);
        }
        return sum;
    }

    GravitySettings settings{.direct_below = 1'000'000};
    test::World world;
    ForceView view;
    ForceLists lists;
    std::vector<test::PointMass> bodies;
};

// The oracle's own test: two bodies, by hand.
TEST(DirectSumOracle, IsNewtonsLawForTwoBodies)
{
    const std::vector<test::PointMass> pair = {{{1, 2, 3}, 5, 0}, {{1, 2, 7}, 2, 0}};
    EXPECT_EQ(test::acceleration_at(pair[0].position, 0, pair, 4, &pair[0]), Vector3d(0, 0, 0.5));
    EXPECT_EQ(test::acceleration_at(pair[1].position, 0, pair, 4, &pair[1]), Vector3d(0, 0, -1.25));
    EXPECT_EQ(test::potential_energy_of(pair, 4), -10);
    const std::vector<test::PointMass> soft = {{{0, 0, 0}, 1, 4}, {{4, 0, 0}, 1, 5}};
    EXPECT_EQ(test::acceleration_at(soft[0].position, 4, soft, 125, &soft[0]), Vector3d(4, 0, 0));
}

TEST(SumDirectly, InDoubleIsTheDefinition)
{
    Scene scene(test::plummer_sphere(700, 1));
    scene.sum(Precision::Double);
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        ASSERT_LE((scene.acceleration(body) - scene.exact(body)).norm(),
                  scene.tolerance(body, double_rounding, 20) * 10)
            << "body " << body; // the oracle rounds too, and sums 700 terms
}

// The sphere reaches to 10 from its centre, so any two bodies are within 20 of each other.
TEST(SumDirectly, InMixedPrecisionIsTheDefinitionToTheRoundingOfPairs)
{
    Scene scene(test::plummer_sphere(700, 1));
    scene.sum(Precision::Mixed);
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        ASSERT_LE((scene.acceleration(body) - scene.exact(body)).norm(),
                  scene.tolerance(body, float_rounding, 20))
            << "body " << body;
}

TEST(SumDirectly, FarFromTheOriginNothingIsLost)
{
    ParticleSet particles = test::plummer_sphere(700, 1);
    for (Particle& particle : particles)
        particle.position += Vector3d(1e7, -2e7, 5e6); // rounds the places; the oracle has them rounded too
    Scene scene(particles);
    scene.sum(Precision::Mixed);
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        ASSERT_LE((scene.acceleration(body) - scene.exact(body)).norm(),
                  scene.tolerance(body, float_rounding, 20))
            << "body " << body;
}

// In units that are powers of two larger or smaller all numbers are the same but for their exponents.
TEST(SumDirectly, UnitsDoNotMatter)
{
    Scene plain(test::plummer_sphere(300, 1));
    plain.sum(Precision::Mixed);
    for (const int exponent : {-40, 40}) { // 1e-12 and 1e12
        const double unit = std::ldexp(1.0, exponent);
        ParticleSet particles = test::plummer_sphere(300, 1);
        for (Particle& particle : particles) {
            particle.position *= unit;
            particle.mass *= float(1 / unit);
        }
        Scene scaled(particles, 0.1 * unit, 4 * unit);
        scaled.sum(Precision::Mixed);
        const double acceleration_unit = 1 / (unit * unit * unit);
        for (std::size_t body = 0; body < 300; ++body) {
            // The bodies' order depends on the cells alone, which are scaled with the rest.
            ASSERT_EQ(scaled.acceleration(body), Vector3d(acceleration_unit * plain.acceleration(body)));
            ASSERT_EQ(scaled.tide(body), Matrix3d(acceleration_unit / unit * plain.tide(body)));
        }
    }
}

TEST(SumDirectly, AnOutlierCostsTheOthersNothing)
{
    for (const double distance : {1e3, 1e6, 1e12, 1e15}) {
        ParticleSet particles = test::plummer_sphere(300, 1);
        particles[150].position = {distance, -distance, distance};
        Scene scene(particles, 0.01);
        scene.sum(Precision::Mixed);
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            const double reach = scene.bodies[body].position.norm() > 20 ? 2 * distance : 20;
            ASSERT_LE((scene.acceleration(body) - scene.exact(body)).norm(),
                      scene.tolerance(body, float_rounding, reach))
                << "body " << body << ", outlier at " << distance;
        }
    }
}

// Central differences of step d miss by d^2 / 6 of third derivatives, 60 m / r^5 at most, and by the
// rounding of accelerations over d.
TEST(SumDirectly, TidesAreTheDerivativesOfMasslessProbesAccelerations)
{
    Scene scene(test::plummer_sphere(200, 1));
    for (const auto& [precision, rounding] :
         {std::pair(Precision::Double, double_rounding), std::pair(Precision::Mixed, float_rounding)}) {
        scene.sum(precision);
        constexpr double d = 1e-4;
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            const test::PointMass& own = scene.bodies[body];
            Matrix3d measured;
            for (int axis = 0; axis < 3; ++axis) {
                const Vector3d shift = d * Vector3d::Unit(axis);
                measured.col(axis) =
                    (test::acceleration_at(own.position + shift, own.q, scene.bodies, G, &own) -
                     test::acceleration_at(own.position - shift, own.q, scene.bodies, G, &own)) /
                    (2 * d);
            }
            double tolerance = 0;
            for (const test::PointMass& other : scene.bodies) {
                const double r = std::sqrt((other.position - own.position).squaredNorm() + own.q + other.q);
                const double pull = G * other.mass / (r * r * r);
                tolerance += pull * (10 * d * d / (r * r) + 40 * rounding * (1 + 20 / r) +
                                     r / d * 100 * double_rounding);
            }
            ASSERT_LE((scene.tide(body) - measured).cwiseAbs().maxCoeff(), tolerance) << "body " << body;
        }
    }
}

TEST(SumDirectly, AddsNoMomentum)
{
    ParticleSet particles = test::plummer_sphere(700, 2);
    test::give_masses(particles, 1e-4, 1e-2, 2);
    Scene scene(particles);
    for (const auto& [precision, bound] :
         {std::pair(Precision::Double, 1e-12), std::pair(Precision::Mixed, 1e-6)}) {
        scene.sum(precision);
        Vector3d sum{0, 0, 0};
        double size = 0;
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            sum += scene.view.mass[body] * scene.acceleration(body);
            size += scene.view.mass[body] * scene.acceleration(body).norm();
        }
        EXPECT_LE(sum.norm(), bound * size);
    }
}

/// All sums, bit by bit.
std::vector<double> bits_of(Scene& scene)
{
    std::vector<double> all;
    for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
        const Matrix3d tide = scene.tide(body);
        all.insert(all.end(), scene.acceleration(body).data(), scene.acceleration(body).data() + 3);
        all.insert(all.end(), tide.data(), tide.data() + 9);
    }
    return all;
}

TEST(SumDirectly, GivesTheSameBitsOnEveryInstructionSetAndAnyNumberOfThreads)
{
    Scene scene(test::plummer_sphere(700, 3)); // six blocks of targets
    for (const Precision precision : {Precision::Mixed, Precision::Double}) {
        scene.sum(precision, *simd::runnable_kernels().front());
        const std::vector<double> expected = bits_of(scene);
        for (const simd::KernelTable* kernels : simd::runnable_kernels()) {
            for (const int threads : {1, 2, 3, 8, 16}) {
                ThreadTeam(threads).run([&] { scene.sum(precision, *kernels); });
                const std::vector<double> found = bits_of(scene);
                EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(double)), 0)
                    << kernels->name << " on " << threads;
            }
        }
    }
}

TEST(SumDirectly, WithoutATideColumnTheAccelerationsAreTheSame)
{
    Scene scene(test::plummer_sphere(300, 4));
    scene.sum(Precision::Mixed);
    const AlignedVector<Vector3d> with = scene.clusters().acceleration;
    scene.clusters().columns.tide = false;
    scene.sum(Precision::Mixed);
    EXPECT_EQ(scene.clusters().acceleration, with);
}

TEST(SumDirectly, OneBodyFeelsNothingAndNoneIsFine)
{
    for (const std::size_t count : {0U, 1U}) {
        Scene scene(test::ball(count, 1, 0, 1));
        for (const Precision precision : {Precision::Mixed, Precision::Double}) {
            scene.sum(precision);
            for (std::size_t body = 0; body < count; ++body) {
                EXPECT_EQ(scene.acceleration(body), Vector3d(0, 0, 0));
                EXPECT_EQ(scene.tide(body), Matrix3d(Matrix3d::Zero()));
            }
        }
        EXPECT_EQ(potential_energy(scene.view, simd::kernels(), G), 0);
    }
}

TEST(SumDirectly, MasslessBodiesAreAttractedAndAttractNothing)
{
    ParticleSet particles = test::ball(10, 1, 0, 1);
    for (std::size_t i = 1; i < 10; ++i)
        particles[i].mass = 0;
    Scene scene(particles);
    scene.sum(Precision::Double);
    for (std::size_t body = 0; body < 10; ++body) {
        EXPECT_EQ(scene.acceleration(body).norm() > 0, scene.view.mass[body] == 0);
        EXPECT_LE((scene.acceleration(body) - scene.exact(body)).norm(), 1e-14 * scene.exact(body).norm());
    }
}

TEST(PotentialEnergy, IsTheDefinition)
{
    for (const double place : {0.0, 1e7}) {
        ParticleSet particles = test::plummer_sphere(700, 5);
        for (Particle& particle : particles)
            particle.position += Vector3d(place, 0, -place);
        Scene scene(particles);
        const double exact = test::potential_energy_of(scene.bodies, G);
        // 250,000 terms of one sign: their roundings are a random walk, of either side.
        EXPECT_NEAR(potential_energy(scene.view, simd::kernels(), G) / exact, 1, 2 * 500 * double_rounding)
            << place;
        const double once = potential_energy(scene.view, simd::kernels(), G);
        ThreadTeam(8).run([&] { EXPECT_EQ(potential_energy(scene.view, simd::kernels(), G), once); });
    }
}

} // namespace
} // namespace slod
