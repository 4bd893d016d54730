#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "cost/flat_fountain.hpp"
#include "simd/kernels.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t per_frame = 4 * flat_lanes, lifetime = 160;

/// Half of the last place of floats between 8 and 16, which bound all coordinates here.
const double rounding = std::ldexp(1.0, -21);

SimulationSettings fountain()
{
    SimulationSettings scene;
    scene.uniform_gravity = UniformGravitySettings{{0, 0, -9.81}};
    scene.linear_drag = LinearDragSettings{0.5};
    scene.uniform_wind = UniformWindSettings{{1, 0.3, 0}};
    scene.colliders.emplace_back();
    scene.colliders.front().restitution = 0.6;
    for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(-0.3, 0.2, 1)}) {
        EmitterSettings emitter;
        emitter.position = {direction.x(), 0, 0.5};
        emitter.direction = direction;
        emitter.speed = 10;
        emitter.speed_spread = 0.1;
        emitter.cone_angle_deg = 10;
        scene.emitters.push_back(emitter);
    }
    return scene;
}

UniformFields fields_of(const SimulationSettings& scene)
{
    return {scene.uniform_gravity, scene.linear_drag, scene.uniform_wind};
}

struct Droplet {
    Vector3d position, velocity;
};

Droplet droplet(const FlatFountain& flat, std::size_t i)
{
    return {flat.position(i), flat.velocity(i)};
}

void expect_near(const Droplet& is, const Droplet& wanted, double distance, double speed)
{
    EXPECT_LE((is.position - wanted.position).cwiseAbs().maxCoeff(), distance);
    EXPECT_LE((is.velocity - wanted.velocity).cwiseAbs().maxCoeff(), speed);
}

/// Once for each instruction set that runs here.
class FlatFountainOf : public testing::TestWithParam<const char*> {
protected:
    FlatFountain make(const SimulationSettings& scene) const
    {
        return {scene, per_frame, lifetime, GetParam()};
    }
};

TEST_P(FlatFountainOf, DropletsFollowTheClosedForm)
{
    const SimulationSettings scene = fountain();
    FlatFountain flat = make(scene);
    flat.step();
    std::vector<Droplet> wanted;
    for (std::size_t i = 0; i < flat.alive(); ++i)
        wanted.push_back(droplet(flat, i));
    constexpr int frames = 60; // they are still in the air
    for (int frame = 0; frame < frames; ++frame)
        flat.step();
    const Propagator whole = fields_of(scene).over(frames * scene.time.step);
    // A velocity is rounded three times in each frame, a position likewise, and the coefficients once.
    const double speed = 4 * frames * rounding, distance = speed + frames * scene.time.step * speed;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        whole.apply(wanted[i].position, wanted[i].velocity);
        expect_near(droplet(flat, i), wanted[i], distance, speed);
    }
}

TEST_P(FlatFountainOf, DropletsStartAtTheirNozzleOverAFrameWithinTheirConeAndSpread)
{
    const SimulationSettings scene = fountain();
    FlatFountain flat = make(scene);
    for (int frame = 0; frame < 3; ++frame)
        flat.step();
    for (std::size_t stream = 0; stream < scene.emitters.size(); ++stream) {
        const EmitterSettings& emitter = scene.emitters[stream];
        double slowest = INFINITY, fastest = 0;
        for (std::size_t i = 0; i < per_frame; ++i) {
            const double age = (1 - (double(i) + 0.5) / per_frame) * scene.time.step;
            const Propagator flight = fields_of(scene).over(age);
            const auto [position, velocity] = droplet(flat, flat.newborn(stream) + i);
            const Vector3d start = (velocity - flight.gain) / (1 + flight.decay_minus_1);
            const Vector3d nozzle = position - flight.drift * start - flight.shift;
            EXPECT_LE((nozzle - emitter.position).norm(), 4 * rounding);
            const double cosine = start.dot(emitter.direction.normalized()) / start.norm();
            // The cosine is a float below 1, and those of the turn are off by the end of their series.
            EXPECT_GE(cosine, std::cos(emitter.cone_angle_deg * std::numbers::pi / 180) - 1e-5);
            slowest = std::min(slowest, start.norm());
            fastest = std::max(fastest, start.norm());
        }
        // Of 64 uniform numbers none is in an end tenth once in 850 times, and these are always the same.
        EXPECT_GE(slowest, 0.9 * emitter.speed * (1 - 1e-5));
        EXPECT_LE(slowest, 0.92 * emitter.speed);
        EXPECT_LE(fastest, 1.1 * emitter.speed * (1 + 1e-5));
        EXPECT_GE(fastest, 1.08 * emitter.speed);
    }
}

TEST_P(FlatFountainOf, TheGroundMirrorsAndShrinksByItsRestitution)
{
    const SimulationSettings scene = fountain();
    const Propagator frame = fields_of(scene).over(scene.time.step);
    const double restitution = scene.colliders.front().restitution;
    FlatFountain flat = make(scene);
    flat.step();
    std::size_t bounces = 0;
    for (std::size_t step = 1; step < lifetime; ++step) {
        std::vector<Droplet> wanted;
        for (std::size_t i = 0; i < 2 * per_frame; ++i)
            wanted.push_back(droplet(flat, i));
        flat.step();
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            auto& [position, velocity] = wanted[i];
            frame.apply(position, velocity);
            if (position.z() < 0) {
                position.z() *= -restitution;
                velocity.z() *= -restitution;
                ++bounces;
            }
            if (position.z() > 4 * rounding) // else rounding may have it on the other side
                expect_near(droplet(flat, i), wanted[i], 4 * rounding, 4 * rounding);
            EXPECT_GE(flat.position(i).z(), 0);
        }
    }
    EXPECT_GE(bounces, 2 * per_frame); // they fall for two seconds of 2.7
}

TEST_P(FlatFountainOf, TheNewbornTakeThePlacesOfThoseWhoseTimeHasCome)
{
    FlatFountain flat = make(fountain());
    for (std::size_t step = 1; step <= lifetime + 2; ++step) {
        flat.step();
        EXPECT_EQ(flat.alive(), std::min(step, lifetime) * 2 * per_frame);
    }
    EXPECT_EQ(flat.newborn(0), 2 * per_frame); // those of the second frame
    for (std::size_t i = 0; i < 4 * per_frame; ++i)
        EXPECT_LT((flat.position(i) - Vector3d(0, 0, 0.5)).norm(), 1); // at the nozzles
}

// Strong drag lets much of the wind be seen in one frame.
TEST_P(FlatFountainOf, TheAirIsThatOfTheSimulation)
{
    SimulationSettings scene = fountain();
    scene.linear_drag->rate = 5;
    scene.fields.of<Turbulence>() = TurbulenceSettings{.amplitude = 2, .length = 6, .octaves = 3, .time = 1};
    const Turbulence air(*scene.fields.of<Turbulence>(), {scene.seed});
    FlatFountain flat = make(scene);
    flat.step();
    std::vector<Droplet> wanted;
    for (std::size_t i = 0; i < flat.alive(); ++i)
        wanted.push_back(droplet(flat, i));
    flat.step();
    double speeds = 0; // of all waves
    for (const Turbulence::Wave& wave : air.waves())
        speeds += wave.velocity.norm();
    // A cosine is off by 3.6e-6, and by 2 pi times its argument's rounding, three times half of the last
    // place of a float below 4.
    const double wind_error = speeds * (4e-6 + 2 * std::numbers::pi * 3 * std::ldexp(1.0, -23));
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        auto& [position, velocity] = wanted[i];
        FieldValue wind;
        air.add(position + 0.5 * scene.time.step * velocity, 1.5 * scene.time.step, wind);
        UniformFields felt = fields_of(scene);
        felt.wind += wind.value;
        const Propagator frame = felt.over(scene.time.step);
        frame.apply(position, velocity);
        const double error = -frame.decay_minus_1 * wind_error + 4 * rounding;
        expect_near(droplet(flat, i), wanted[i], error, error);
    }
}

std::vector<const char*> isas()
{
    std::vector<const char*> names;
    for (const simd::KernelTable* table : simd::runnable_kernels())
        names.push_back(table->name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Isas, FlatFountainOf, testing::ValuesIn(isas()),
                         [](const auto& isa) { return std::string(isa.param); });

} // namespace
} // namespace slod::cost
