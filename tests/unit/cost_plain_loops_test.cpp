#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "cost/plain_loops.hpp"
#include "cost/setting.hpp"
#include "effects/uniform_fields.hpp"
#include "sim/simulation.hpp"
#include "support/small_scenes.hpp"

namespace slod::cost {
namespace {

// The same scheme, by other sums. A float of order 1 rounds by 6e-8: were anything but masses in single
// precision in either, they would be farther apart than a sixtieth of that.
TEST(PlainStars, MoveAsTheSimulationsDoInDouble)
{
    SimulationSettings scene = test::quiet_settings();
    scene.gravity.emplace().precision = Precision::Double;
    ParticleSet stars;
    test::add_cloud(stars, {.count = 300}, 1);
    PlainStars plain(scene, stars);
    Simulation simulation(with_setting(scene, {.max_cluster_size = 1}), stars, {.isa = "auto", .tick = {}});
    for (int step = 0; step < 10; ++step) {
        plain.step();
        simulation.step({});
    }
    const ParticleSet wanted = simulation.particles();
    ASSERT_EQ(plain.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_LT((plain.position(i) - wanted[i].position).norm(), 1e-9) << i;
        EXPECT_LT((plain.velocity(i) - wanted[i].velocity).norm(), 1e-9) << i;
    }
}

SimulationSettings two_jets()
{
    SimulationSettings scene = test::quiet_settings();
    scene.uniform_gravity = UniformGravitySettings{{0, 0, -9.81}};
    scene.linear_drag = LinearDragSettings{0.5};
    scene.uniform_wind = UniformWindSettings{{1, 0, 0}};
    scene.emitters = {test::jet("one"), test::jet("two")};
    for (EmitterSettings& emitter : scene.emitters)
        emitter.cone_angle_deg = emitter.speed_spread = 0;
    return scene;
}

// 640 droplets a unit of time that live for half of one. Each of 16 pools owes less than one droplet, and
// steps of 1/64 count the last of 32 as the age has been rounded: within a step's births and the pools'.
TEST(PlainDroplets, AreAsManyAsAreBornInALifetime)
{
    PlainDroplets droplets(two_jets());
    for (int step = 0; step < 100; ++step)
        droplets.step();
    const double wanted = 2 * 320, tolerance = 2 * (10 + 16);
    EXPECT_NEAR(double(droplets.size()), wanted, tolerance);
    const std::size_t before = droplets.size();
    droplets.step();
    EXPECT_NEAR(double(droplets.size()), double(before), tolerance);
}

// Up at 4 from the origin: where the exact flight is between birth and the lifetime. Euler's steps of 1/64
// are off by half a step's change of velocity each: by 0.5 (1/64) (9.81 + drag 0.5 * 5) 0.5 over the flight.
TEST(PlainDroplets, FlyAsGravityDragAndWindSay)
{
    const SimulationSettings scene = two_jets();
    PlainDroplets droplets(scene);
    for (int step = 0; step < 60; ++step)
        droplets.step();
    const UniformFields fields(scene.uniform_gravity, scene.linear_drag, scene.uniform_wind);
    const double tolerance = 0.5 / 64 * (9.81 + 0.5 * 5) * 0.5;
    double farthest = 0;
    for (const Vector3d& place : droplets.positions()) {
        double nearest = 1e9;
        for (double age = 0; age < 0.52; age += 1e-3) {
            const Propagator flight = fields.over(age);
            const Vector3d velocity(0, 0, 4);
            nearest = std::min(nearest, (flight.shift + flight.drift * velocity - place).norm());
        }
        farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, tolerance);
    EXPECT_GT(farthest, 0);
}

} // namespace
} // namespace slod::cost
