#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "gravity/potential.hpp"
#include "support/attracting_world.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"

// Bodies where tree codes stumble: on one another, on a line, in a plane, far away, and where no force is.
namespace slod::test {
namespace {

AttractingWorld sound_world(const ParticleSet& particles, double softening = 0.05)
{
    AttractingWorld world = walked(particles, softening);
    EXPECT_EQ(problems(world.view, world.clusters()), Problems{});
    return world;
}

void expect_finite(const AttractingWorld& world)
{
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        ASSERT_TRUE(world.acceleration(body).allFinite()) << body;
}

/// `count` particles at x.
ParticleSet all_at(const Vector3d& x, std::size_t count)
{
    return cloud(count, 1, [&](Random&) { return x; });
}

TEST(GravityDegenerate, G15_DuplicatesAmongOthersAreSummedLikeThem)
{
    ParticleSet particles = cloud(2'200, 1, [](Random& random) { return point_in_ball(random, 1); });
    for (std::size_t i = 0; i < 200; ++i)
        particles[i].position = Vector3d(0.3, 0.2, -0.1);
    AttractingWorld world = sound_world(particles);
    world.evaluate_again();
    expect_at_most("largest error of a pull", force_errors(world, 2'200).largest, 0.02);
}

// A node of coincident bodies has no extent and acts as one at any distance, so a hundred thousand of them
// are less work than as many spread out.
TEST(GravityDegenerate, G15_AllBodiesAtOnePointCostNoMoreThanSpreadOut)
{
    constexpr std::size_t count = 100'000;
    AttractingWorld spread =
        sound_world(cloud(count, 2, [](Random& random) { return point_in_ball(random, 1); }));
    const ForceCounts apart = spread.evaluate();
    AttractingWorld world = sound_world(all_at({0.7, -0.3, 0.1}, count));
    const ForceCounts together = world.evaluate();
    expect_at_most("pairs summed, of those spread out",
                   double(together.interactions) / double(apart.interactions), 2);
    expect_at_most("nodes tested, of those spread out",
                   double(together.nodes_tested) / double(apart.nodes_tested), 2);
    double largest = 0;
    for (std::size_t body = 0; body < count; ++body)
        largest = worse(largest, world.acceleration(body).norm());
    expect_at_most("largest pull", largest, 0);
}

// The others' pulls are those of the direct sum in double; what is rounded is float.
TEST(GravityDegenerate, G16_CoincidentBodiesWithoutSofteningDoNotPullEachOther)
{
    ParticleSet particles = all_at({1, 2, 3}, 50);
    for (Particle& particle : all_at({2, 2, 3}, 20)) {
        particle.id += 50;
        particles.push_back(particle);
    }
    AttractingWorld world = sound_world(particles, 0);
    world.evaluate_again();
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        expect_at_most("largest relative error of a pull",
                       (world.acceleration(body) - world.exact(body)).norm() / world.exact(body).norm(),
                       1e-6);
}

// 79,800 pairs of one sign: their roundings are a random walk, of either side.
TEST(GravityDegenerate, G17_CoincidentBodiesAreInThePotential)
{
    ParticleSet particles = cloud(400, 3, [](Random& random) { return point_in_ball(random, 1); });
    for (std::size_t i = 0; i < 100; ++i)
        particles[i].position = Vector3d(0.1, 0.1, 0.1);
    AttractingWorld world = sound_world(particles);
    const double exact = potential_energy_of(world.bodies, 1);
    expect_at_most("relative error of the potential energy",
                   std::abs(potential_energy(world.view, simd::kernels(), 1) / exact - 1), 1e-12);
}

TEST(GravityDegenerate, G18_BodiesOneUnitOfRoundingApartAreHeld)
{
    std::uint64_t index = 0;
    AttractingWorld world = sound_world(
        cloud(1'000, 4, [&](Random&) { return Vector3d(1 + double(index++ % 2) * 0x1p-52, 1, 1); }));
    world.evaluate_again();
    expect_finite(world);
    // 500 on each side pull over 2^-52, by their softening as a spring: 1/2 2^-52 / 0.05^3.
    const double spring = 0.5 * 0x1p-52 / std::pow(0.05, 3);
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        expect_within("pull, of that of half of them", world.acceleration(body).norm() / spring, 1 - 1e-5,
                      1 + 1e-5);
}

TEST(GravityDegenerate, G19_CollinearBodiesAreSummedRight)
{
    AttractingWorld three = sound_world([] {
        ParticleSet particles = all_at({0, 0, 0}, 3);
        particles[1].position.x() = 1;
        particles[2].position.x() = 10;
        return particles;
    }());
    three.evaluate_again();
    // Too few for a node to act as one: float rounding.
    expect_at_most("largest error of a pull among three", force_errors(three).largest, 1e-6);
    AttractingWorld many =
        sound_world(cloud(100'000, 5, [](Random& random) { return Vector3d(random.uniform(), 0, 0); }), 1e-3);
    many.evaluate_again();
    expect_finite(many);
    // Where the forces of both sides cancel, errors are held to a share of the gross pull, which on a line is
    // twenty times the mean.
    double mean = 0;
    for (std::size_t body = 0; body < many.bodies.size(); body += 100)
        mean += many.acceleration(body).norm() / 1000;
    for (std::size_t body = 0; body < many.bodies.size(); body += 100) {
        const Vector3d exact = many.exact(body);
        expect_at_most("largest error of a pull among 100,000, of it or the mean",
                       (many.acceleration(body) - exact).norm() / std::max(exact.norm(), mean), 0.02);
    }
}

TEST(GravityDegenerate, G20_NothingPullsOutOfAPlane)
{
    AttractingWorld world = sound_world(cloud(100'000, 6, [](Random& random) {
        const Vector3d point = point_in_ball(random, 1);
        return Vector3d(point.x(), point.y(), 0);
    }));
    world.evaluate();
    std::size_t out_of_plane = 0;
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        out_of_plane += world.acceleration(body).z() != 0 ? 1 : 0;
    expect_at_most("pulls out of the plane", double(out_of_plane), 0);
}

TEST(GravityDegenerate, G35_OneBodyFarAwayCostsTheOthersNothing)
{
    ParticleSet particles = plummer_sphere(5'000, 7);
    AttractingWorld alone = sound_world(particles);
    alone.evaluate_again();
    particles[2'500].position = {1e9, -1e9, 1e9};
    AttractingWorld world = sound_world(particles);
    world.evaluate_again();
    expect_finite(world);
    // Cells are larger now, so the nodes are others, no worse.
    expect_at_most("99th percentile of the errors, of that without it",
                   force_errors(world, 5'000).p99 / force_errors(alone, 5'000).p99, 1.5);
}

// Half of the cloud is the other half's mirror image: nothing pulls the body in the middle.
TEST(GravityDegenerate, G37_WhereNoForceIsTheCriterionDoesNotOpenEverything)
{
    constexpr std::size_t count = 100'001;
    ParticleSet particles = cloud(count, 8, [](Random& random) { return point_in_ball(random, 1); });
    for (std::size_t i = 1; i < count; i += 2)
        particles[i + 1].position = -particles[i].position;
    particles[0].position.setZero();
    AttractingWorld world = sound_world(particles);
    world.evaluate_again();
    for (std::size_t run = 0; run < world.lists.runs.size(); ++run) {
        const TargetRun& group = world.lists.runs[run];
        expect_at_most("largest interactions per body, of all bodies",
                       double(world.lists.counts[run].interactions) /
                           (double(group.last - group.first) * double(count)),
                       0.1);
    }
}

} // namespace
} // namespace slod::test
