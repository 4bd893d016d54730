#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/one_cluster.hpp"
#include "support/rigid_scenes.hpp"

// What air and uniform gravity do, against closed forms: to one particle, and to 64 in a cluster. The centre
// is in double; what members have about it is rounded to float when the cluster is formed, and in rigid
// motion stays as it was then.
namespace slod::test {
namespace {

constexpr double float_rounding = 0x1p-24;
const Vector3d downwards(0, 0, -9.81);

class InAir : public testing::TestWithParam<Crowd> {
protected:
    static bool rigid() { return GetParam().motion == Motion::Rigid; }

    /// At 30 m/s or so, members within half a unit of place and velocity.
    static ParticleSet thrown(const Vector3d& velocity, double radius = 0.5)
    {
        return about(GetParam().particles, {100, 100, 1000}, velocity, radius, 5);
    }

    static SimulationSettings windy(double drag, const Vector3d& wind)
    {
        SimulationSettings settings = settings_for(GetParam());
        settings.uniform_gravity = UniformGravitySettings{downwards};
        settings.linear_drag = LinearDragSettings{drag};
        settings.uniform_wind = UniformWindSettings{wind};
        return settings;
    }
};

// v = v_t + (v_0 - v_t) e^(-k t). A velocity of about 30 is rounded some five times in a frame.
TEST_P(InAir, F01_DragDecaysWithoutOvershootHoweverStiff)
{
    const Vector3d start(30, 4, 12), wind(5, -2, 1);
    for (const double stiffness : {0.1, 1.0, 2.0, 10.0, 1e6}) {
        SimulationSettings settings = settings_for(GetParam());
        const double drag = stiffness / settings.time.step;
        settings = windy(drag, wind);
        const Vector3d terminal = wind + downwards / drag, way = start - terminal;
        const ParticleSet initial = thrown(start);
        Simulation simulation(settings, initial, {});
        double before = 1;
        for (int frame = 1; frame <= 30; ++frame) {
            simulation.step({});
            const double left = std::exp(-stiffness * frame);
            const Vector3d velocity = only_centre(simulation).velocity - terminal;
            expect_at_most("error of the centre's velocity, share",
                           (velocity - left * way).norm() / way.norm(), 1e-12);
            const double share = velocity.dot(way) / way.squaredNorm();
            expect_at_most("gain of what is left, share", share - before, 1e-15);
            expect_at_least("what is left, share", share, -1e-15);
            before = share;
            if (rigid())
                continue;
            for (const Particle& particle : simulation.particles()) {
                const Vector3d own = initial[particle.id - 1].velocity - terminal;
                expect_at_most("error of members' velocities",
                               (particle.velocity - terminal - left * own).norm(), 4 * float_rounding);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Crowds, InAir, testing::ValuesIn(crowds()), name_of);

// v = v_0 / (1 + c |v_0| t) in each direction. Members of a cluster have their own speeds, each with its own
// decay, of which the cluster knows the first derivative; they are so near that it does not matter.
TEST_P(InAir, F02_QuadraticDragKeepsTheSignHoweverStiff)
{
    const Vector3d start(18, -6, 4);
    for (const double stiffness : {0.1, 10.0, 1e6}) { // c |v_0| h
        SimulationSettings settings = settings_for(GetParam());
        settings.quadratic_drag = QuadraticDragSettings{stiffness / (start.norm() * settings.time.step)};
        Simulation simulation(settings, thrown(start, 1e-6), {});
        for (int frame = 1; frame <= 30; ++frame) {
            simulation.step({});
            const Vector3d velocity = only_centre(simulation).velocity;
            const Vector3d expected = start / (1 + stiffness * frame);
            expect_at_most("error of the velocity, share", (velocity - expected).norm() / expected.norm(),
                           1e-9);
            expect_at_least("velocity left, share in each direction",
                            (velocity.array() / start.array()).minCoeff(), 0);
        }
    }
}

// After 50 / k transients are e^-50 of what they were. Of the quadratic drag k is the rate 2 g / v_t at which
// they end. A cluster whose weight were taken 64 times would fall 64 or 8 times as fast.
TEST_P(InAir, F03_FallingEndsAtTheTerminalVelocity)
{
    for (const bool quadratic : {false, true}) {
        SimulationSettings settings = settings_for(GetParam());
        settings.time.step = 1.0 / 60;
        settings.uniform_gravity = UniformGravitySettings{downwards};
        const double coefficient = quadratic ? 0.1 : 2;
        if (quadratic)
            settings.quadratic_drag = QuadraticDragSettings{coefficient};
        else
            settings.linear_drag = LinearDragSettings{coefficient};
        const double g = -downwards.z(), speed = quadratic ? std::sqrt(g / coefficient) : g / coefficient;
        const double rate = quadratic ? 2 * g / speed : coefficient;
        Simulation simulation(settings, thrown({7, 7, 7}), {});
        run(simulation, int(std::ceil(50 / (rate * settings.time.step))));
        const Vector3d terminal(0, 0, -speed);
        expect_at_most(quadratic ? "distance of the centre from sqrt(g / c)"
                                 : "distance of the centre from g / k",
                       (only_centre(simulation).velocity - terminal).norm(), 1e-9);
        if (rigid())
            continue;
        for (const Particle& particle : simulation.particles())
            expect_at_most(quadratic ? "distance of members from sqrt(g / c)"
                                     : "distance of members from g / k",
                           (particle.velocity - terminal).norm(), 1e-9);
    }
}

// Two units of time, after which it is 19.62 lower. Places below 64 are rounded to 2^-47 in each frame,
// 7e-15, 120 times.
TEST_P(InAir, F04_FreeFallIsAParabolaAtAnyStep)
{
    const Vector3d place(50, 50, 50);
    for (const double step : {1.0 / 60, 1.0 / 30, 1.0 / 15}) {
        SimulationSettings settings = settings_for(GetParam());
        settings.time.step = step;
        settings.uniform_gravity = UniformGravitySettings{downwards};
        const ParticleSet initial = about(GetParam().particles, place, {3, 0, 2}, 0.5, 5);
        Simulation simulation(settings, initial, {});
        run(simulation, int(std::lround(2 / step)));
        const auto after = [](const Vector3d& x, const Vector3d& v) -> Vector3d {
            return x + 2 * v + 2 * downwards;
        };
        const Vector3d fallen = after(place, {3, 0, 2});
        expect_at_most("error of the centre's place, share of the fall",
                       (only_centre(simulation).position - fallen).norm() / 19.62, 1e-12);
        for (const Particle& particle : simulation.particles()) {
            const Particle& start = initial[particle.id - 1];
            const Vector3d own =
                rigid() ? Vector3d(start.position + fallen - place) : after(start.position, start.velocity);
            expect_at_most("error of members' places", (particle.position - own).norm(), 1e-4);
        }
    }
}

// The propagator is the flow itself, so that one step of 1/30 is two of 1/60 and four of 1/120.
TEST_P(InAir, F05_TheOutcomeDoesNotDependOnTheStep)
{
    const auto after_a_second = [&](double step, ParticleSet& members) {
        SimulationSettings settings = windy(0.7, {3, -2, 1});
        settings.time.step = step;
        Simulation simulation(settings, about(GetParam().particles, {1, 2, 3}, {4, 0, 6}, 0.5, 5), {});
        run(simulation, int(std::lround(1 / step)));
        members = simulation.particles();
        return only_centre(simulation);
    };
    ParticleSet expected;
    const Centre coarse = after_a_second(1.0 / 30, expected);
    for (const double step : {1.0 / 60, 1.0 / 120}) {
        ParticleSet found;
        const Centre fine = after_a_second(step, found);
        expect_at_most("difference of the centres' places", (fine.position - coarse.position).norm(), 1e-12);
        expect_at_most("difference of the centres' velocities", (fine.velocity - coarse.velocity).norm(),
                       1e-12);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            expect_at_most("difference of members' places", (found[i].position - expected[i].position).norm(),
                           8 * float_rounding);
    }
}

// A wind that is turned on while the scene runs. 63 % of it are reached after 1 / k, here 4.8 frames.
TEST_P(InAir, F06_AGustIsFollowedWithoutOvershoot)
{
    const double drag = 50, gust = 100;
    SimulationSettings settings = windy(drag, {0, 0, 0});
    settings.time.step = 1.0 / 240;
    settings.uniform_gravity.reset();
    Simulation simulation(settings, thrown({0, 0, 0}, 1e-3), {});
    run(simulation, 10);
    settings.uniform_wind->velocity = {gust, 0, 0};
    ASSERT_EQ(simulation.change_settings(settings), Problems{});
    CaseCurve followed{.name = GetParam().name, .x = {0}, .y = {0}}, exact{"closed form", {0}, {0}};
    double before = only_centre(simulation).velocity.x(), reached = 0;
    for (int frame = 1; frame <= 100; ++frame) {
        simulation.step({});
        const double speed = only_centre(simulation).velocity.x();
        expect_at_least("gain of velocity in a frame", speed - before, 0);
        expect_at_most("velocity in a gust of 100", speed, gust);
        if (reached == 0 && speed >= gust * (1 - std::exp(-1)))
            reached = frame;
        before = speed;
        if (frame > 36)
            continue;
        const double time = frame * settings.time.step;
        followed.x.push_back(time);
        followed.y.push_back(speed);
        exact.x.push_back(time);
        exact.y.push_back(-gust * std::expm1(-drag * time));
    }
    const double expected = 1 / (drag * settings.time.step);
    expect_within("frames to 63 %", reached, expected - 1, expected + 1);
    report_picture({.title = "A gust of 100 that sets in at once, drag 50",
                    .x_axis = "time",
                    .y_axis = "velocity",
                    .curves = {exact, followed}});
}

} // namespace
} // namespace slod::test
