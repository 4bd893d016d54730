#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/falling_particle.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// How a single particle fares among colliders.
namespace slod::test {
namespace {

/// Where a particle is after so many frames.
State flown(const Colliders& colliders, State state, int frames = 1, double step = frame)
{
    for (int i = 0; i < frames; ++i)
        colliders.fly(state.position, state.velocity, step);
    return state;
}

double energy(const State& state)
{
    return 0.5 * state.velocity.squaredNorm() + fall * state.position.z();
}

class Tunnelling : public testing::TestWithParam<ColliderSettings> {};

std::string name_of(const testing::TestParamInfo<ColliderSettings>& info)
{
    return info.param.name;
}

// Each is aimed at a point inside, as far beyond it as it starts before, and would be there in one frame.
TEST_P(Tunnelling, F10_IsDoneByNoneOfAMillionFastParticles)
{
    const Colliders colliders({GetParam()}, {}, frame);
    const std::unique_ptr<Solid> solid = make_solid(GetParam());
    Random random(10, 0, 0);
    const auto place = [&](double size) -> Vector3d { return size * random_direction(random); };
    int through = 0, inside = 0;
    for (int i = 0; i < 200'000; ++i) {
        Vector3d aim = place(2 * random.uniform()), start = place(200);
        while (solid->surface(aim).distance > -1e-3)
            aim = place(2 * random.uniform());
        while (solid->surface(start).distance < 0)
            start = place(200);
        Vector3d velocity = 2 * (aim - start) / frame;
        const auto met = colliders.fly(start, velocity, frame);
        through += met.impacts == 0 ? 1 : 0;
        inside += solid->surface(start).distance < -1e-11 ? 1 : 0; // 200 times some fifty roundings
    }
    expect_at_most("particles through", through, 0);
    expect_at_most("particles inside", inside, 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Tunnelling, testing::ValuesIn(one_of_each()), name_of);

TEST(Colliders, F10_StopFastParticlesWithThinWalls)
{
    struct Case {
        double speed, thickness;
    };
    UniformFields windy = falling();
    windy.drag = 0.3;
    windy.wind = {3, 2, -1};
    double nearest = INFINITY;
    for (const UniformFields& fields : {UniformFields(), falling(), windy}) {
        for (const Case& wall : {Case{200, 0.1}, Case{1e4, 1e-3}}) {
            const Colliders colliders({box({0, 0, 0}, {1e6, 1e6, 0.5 * wall.thickness})}, fields, frame);
            Random random(11, 0, 0);
            for (int i = 0; i < 20'000; ++i) {
                State state{{0, 0, 0.5 * wall.thickness + 3 * random.uniform()},
                            wall.speed * random_direction(random)};
                state = flown(colliders, state, 4);
                ASSERT_GT(state.position.z(), 0) << "particle " << i << " at speed " << wall.speed;
                nearest = std::min(nearest, state.position.z() / (0.5 * wall.thickness) - 1);
            }
        }
    }
    // Contacts are found within ten roundings of places up to 700, 1.6e-12, in half thicknesses of 5e-4.
    expect_at_least("height above the wall, half thicknesses", nearest, -4e-9);
}

TEST(Colliders, F11_HaveOneOutcomeForAGrazingHit)
{
    const Colliders floor({with(plane({0, 0, 0}, {0, 0, 1}), 0.5, 0)}, {}, frame);
    const double angle = 1e-6;
    const State grazed = flown(floor, {{0, 0, 0.5 * angle}, {1 / frame, 0, -angle / frame}});
    EXPECT_NEAR(grazed.position.x(), 1, 1e-15);
    // Half the way back at half the speed.
    expect_at_most("error of the grazed height", std::abs(grazed.position.z() - 0.25 * angle), 1e-18);
    EXPECT_NEAR(grazed.velocity.z(), 0.5 * angle / frame, 1e-18);

    // Past a sphere at its radius, more or less: within rounding either is right, and nothing else.
    for (const double off : {-1e-15, 0.0, 1e-15}) {
        const Colliders ball({with(sphere({0, 0, 0}, 1), 1, 0)}, {}, frame);
        State state{{-2, 1 + off, 0}, {4 / frame, 0, 0}};
        const auto met = ball.fly(state.position, state.velocity, frame);
        expect_at_most("impacts on a ball's rim", met.impacts, 1);
        EXPECT_FALSE(met.cut_off);
        EXPECT_LE((state.position - Vector3d(2, 1, 0)).norm(), 1e-6); // an angle of sqrt(1e-15), turned twice
    }
}

TEST(Colliders, F11_HaveOneOutcomeForAnExactEdgeOrCorner)
{
    const Colliders block({with(box({0, 0, 0}, {1, 1, 1}), 1, 0)}, {}, frame);
    for (const Vector3d& corner : {Vector3d(1, 0, 1), Vector3d(1, 1, 1), Vector3d(-1, 1, -1)}) {
        for (const Vector3d& from :
             {Vector3d(0, 0, corner.z()), Vector3d(corner.x(), 0, corner.z()), corner}) {
            State state{corner + from, -2 * from / frame};
            const auto met = block.fly(state.position, state.velocity, frame);
            expect_at_most("impacts on an edge or a corner", met.impacts, 1); // 0: along a face
            EXPECT_TRUE(state.position.allFinite());
            EXPECT_GE(make_solid(box({0, 0, 0}, {1, 1, 1}))->surface(state.position).distance, -1e-14);
            EXPECT_NEAR(state.velocity.norm(), 2 * from.norm() / frame, 1e-12);
        }
    }
}

TEST(Colliders, F12_LetABallBounceToItsHeightAgain)
{
    const Colliders floor({with(plane({0, 0, 0}, {0, 0, 1}), 1, 0)}, falling(), frame);
    State ball{{0.3, 0, 1}, {0.1, 0, 0}};
    const double there_and_back = 2 * std::sqrt(2 / fall);
    const int frames = 60;
    for (int i = 0; i < frames; ++i)
        floor.fly(ball.position, ball.velocity, there_and_back / frames);
    expect_at_most("error of the height after one bounce", std::abs(ball.position.z() - 1), 1e-5);
    EXPECT_NEAR(ball.position.x(), 0.3 + 0.1 * there_and_back, 1e-12);
}

TEST(Colliders, F13_KeepTheSquareOfTheRestitutionOfTheEnergy)
{
    for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
        const Colliders floor({with(plane({0, 0, 0}, {0, 0, 1}), restitution, 0)}, {}, frame);
        const State ball = flown(floor, {{0, 0, 0.01}, {0, 0, -1}});
        expect_at_most("error of the share of energy kept",
                       std::abs(ball.velocity.squaredNorm() - restitution * restitution), 1e-15);
        EXPECT_NEAR(ball.position.z(), restitution * (frame - 0.01), 1e-15);
    }
    // Twice in one frame, as the second floor is met on the way up: 0.9^4, in the exact time.
    const Colliders gap(
        {with(plane({0, 0, 0}, {0, 0, 1}), 0.9, 0), with(plane({0, 0, 1}, {0, 0, -1}), 0.9, 0)}, {}, 1);
    const State ball = flown(gap, {{0, 0, 0.5}, {0, 0, -1}}, 1, 2);
    const double left = 2 - 0.5 - 1 / 0.9;
    expect_at_most("error of the speed after two bounces", std::abs(ball.velocity.z() + 0.81), 1e-15);
    EXPECT_NEAR(ball.position.z(), 1 - 0.81 * left, 1e-14);
}

TEST(Colliders, F14_StopTheNormalVelocityAlone)
{
    for (const Vector3d& normal : {Vector3d(0, 0, 1), Vector3d(1, 2, 3)}) {
        const Vector3d n = normal.normalized();
        const Vector3d along = n.cross(Vector3d(0, 1, 0)).normalized();
        const Colliders wall({with(plane({0, 0, 0}, normal), 0, 0)}, {}, frame);
        const State state = flown(wall, {0.01 * n, 3 * along - 2 * n}, 20);
        if (n.z() == 1)
            expect_at_most("normal velocity on a level floor", std::abs(state.velocity.z()), 0);
        expect_at_most("normal velocity on a tilted wall", std::abs(n.dot(state.velocity)), 1e-15);
        expect_at_most("error of the velocity along", std::abs(along.dot(state.velocity) - 3), 1e-12);
        EXPECT_NEAR(n.dot(state.position), 0, 1e-14);
        EXPECT_NEAR(along.dot(state.position), 20 * frame * 3, 1e-12);
    }
}

TEST(Colliders, GiveTheFrictionOfTheImpulseToTheVelocityAlongTheSurface)
{
    const auto after = [](double slip, double friction) {
        const Colliders floor({with(plane({0, 0, 0}, {0, 0, 1}), 0.5, friction)}, {}, frame);
        return flown(floor, {{0, 0, 0.01}, {slip, 0, -2}}).velocity;
    };
    EXPECT_NEAR(after(10, 0.2).x(), 10 - 0.2 * (2 + 1), 1e-14); // mu (1 + e) of the speed of approach
    EXPECT_NEAR(after(-10, 0.2).x(), -10 + 0.6, 1e-14);
    EXPECT_EQ(after(0.5, 0.2).x(), 0) << "it stops and is not turned round";
    EXPECT_NEAR(after(0.5, 0.2).z(), 1, 1e-15);
}

TEST(Colliders, F18_SendWhatFallsOnAConeToAllSidesAlike)
{
    const Colliders colliders({with(cone({0, 0, 0}, {0, 0, -1}, 1), 1, 0)}, falling(), frame);
    const State centred = flown(colliders, {{0, 0, 0.05}, {0, 0, -4}});
    expect_at_most("way off the axis, dead centre", centred.position.head<2>().norm(), 0);
    EXPECT_GT(centred.velocity.z(), 0) << "it bounces off the apex as off a floor";

    constexpr int count = 10'000, sectors = 20;
    std::array<int, sectors> hits{};
    for (int i = 0; i < count; ++i) {
        Random random(18, 0, std::uint64_t(i));
        const auto [x, y] = random_point_in_disc(random);
        const State state = flown(colliders, {{1e-3 * x, 1e-3 * y, 0.05}, {0, 0, -4}});
        ASSERT_TRUE(state.position.allFinite());
        const double turn = std::atan2(state.velocity.y(), state.velocity.x()) / (2 * M_PI) + 0.5;
        ++hits[std::min(std::size_t(turn * sectors), std::size_t(sectors - 1))];
    }
    double chi_squared = 0;
    for (const int hit : hits)
        chi_squared += (hit - double(count) / sectors) * (hit - double(count) / sectors) * sectors / count;
    expect_at_most("chi squared of the directions", chi_squared, 36.2); // p = 0.01 at 19 degrees of freedom
}

/// Three planes, as the walls and floor of a room with right angles.
std::vector<ColliderSettings> corner(double restitution)
{
    return {with(plane({0, 0, 0}, {1, 0, 0}), restitution, 0),
            with(plane({0, 0, 0}, {0, 1, 0}), restitution, 0),
            with(plane({0, 0, 0}, {0, 0, 1}), restitution, 0)};
}

TEST(Colliders, F19_KeepParticlesInACorner)
{
    std::uint32_t most = 0;
    double deepest = 0, gained = 0;
    for (const double restitution : {0.0, 0.5, 1.0}) {
        const Colliders colliders(corner(restitution), falling(), frame);
        Random random(19, 0, 0);
        for (int i = 0; i < 1000; ++i) {
            State state{random_direction(random).cwiseAbs(), -10 * random_direction(random).cwiseAbs()};
            for (int step = 0; step < 60; ++step) {
                const double before = energy(state);
                const auto met = colliders.fly(state.position, state.velocity, frame);
                most = std::max(most, met.impacts);
                deepest = std::max(deepest, -state.position.minCoeff());
                gained = std::max(gained, (energy(state) - before) / (1 + before));
            }
        }
    }
    expect_at_most("impacts in a frame, corner", most, 8);
    expect_at_most("depth in a wall of the corner", deepest, 1e-13);
    expect_at_most("energy gained in a frame, share", gained, 1e-12);
}

// Thrown into the edge, where it is turned back and forth faster and faster.
TEST(Colliders, F19_KeepParticlesInAWedgeOfADegree)
{
    const double angle = M_PI / 180;
    double deepest = 0, gained = 0;
    std::uint32_t most = 0;
    for (const double restitution : {0.0, 0.9, 1.0}) {
        const Colliders colliders(
            {with(plane({0, 0, 0}, {0, 0, 1}), restitution, 0),
             with(plane({0, 0, 0}, {std::sin(angle), 0, -std::cos(angle)}), restitution, 0)},
            falling(), frame);
        State state{{1, 0, 0.01}, {-30, 0, -1}};
        for (int step = 0; step < 600; ++step) {
            const double before = energy(state);
            most = std::max(most, colliders.fly(state.position, state.velocity, frame).impacts);
            ASSERT_TRUE(state.position.allFinite());
            const double below_the_ceiling =
                std::sin(angle) * state.position.x() - std::cos(angle) * state.position.z();
            deepest = std::max({deepest, -state.position.z(), -below_the_ceiling});
            gained = std::max(gained, (energy(state) - before) / (1 + std::abs(before)));
        }
    }
    expect_at_most("impacts in a frame, wedge", most, 8);
    expect_at_most("depth in a wall of the wedge", deepest, 1e-12);
    expect_at_most("energy gained in a frame, share", gained, 1e-12);
}

// Two slopes that lean against each other carry a particle between them, in any order and however steep.
TEST(Colliders, F19_LetParticlesRestInAValley)
{
    for (const double steepness : {0.5, 1.0, 10.0}) {
        const Colliders valley({with(plane({0, 0, 0}, {steepness, 0, 1}), 0.3, 0),
                                with(plane({0, 0, 0}, {-steepness, 0, 1}), 0.3, 0)},
                               falling(), frame);
        const State state = flown(valley, {{0.01, 0, 0.2}, {0, 0, 0}}, 1200);
        expect_at_most("speed in the valley", state.velocity.norm(), 1e-6);
        expect_at_most("height above the valley's line, steepnesses",
                       std::abs(state.position.z()) / (1 + steepness), 1e-4);
    }
}

TEST(Colliders, F20_PutWhatStartsInsideOntoTheSurfaceWithoutSpeed)
{
    double off = 0, fastest = 0;
    for (const ColliderSettings& collider : one_of_each()) {
        const Colliders colliders({collider}, {}, frame);
        const std::unique_ptr<Solid> solid = make_solid(collider);
        Random random(20, 0, 0);
        for (int i = 0; i < 1000; ++i) {
            State state{2 * random.uniform() * random_direction(random), {0, 0, 0}};
            if (solid->surface(state.position).distance >= 0)
                continue;
            state = flown(colliders, state);
            off = std::max(off, std::abs(solid->surface(state.position).distance));
            fastest = std::max(fastest, state.velocity.norm());
        }
    }
    expect_at_most("distance from the surface after a frame", off, 1e-14);
    expect_at_most("speed given", fastest, 0);
}

TEST(Colliders, F24_OrderTwoEventsInAStepByTime)
{
    std::vector<ColliderSettings> room = corner(1);
    for (const bool swapped : {false, true}) {
        if (swapped)
            std::reverse(room.begin(), room.end());
        const Colliders colliders(room, {}, 1);
        // At the wall after 0.25, at the floor after 0.5 of a unit of time, and in the edge after half of
        // one.
        const State late = flown(colliders, {{0.25, 1, 0.5}, {-1, 0, -1}}, 1, 1);
        expect_at_most("error of the place after both", (late.position - Vector3d(0.75, 1, 0.5)).norm(),
                       1e-15);
        const State both = flown(colliders, {{0.5, 1, 0.5}, {-1, 0, -1}}, 1, 1);
        EXPECT_LE((both.position - Vector3d(0.5, 1, 0.5)).norm(), 1e-15);
        EXPECT_EQ(both.velocity, Vector3d(1, 0, 1));
    }
    const Colliders fallen(corner(1), falling(), 1);
    State state{{0.3, 0.2, 0.4}, {-1.3, -0.7, -0.9}};
    const double before = energy(state);
    for (int step = 0; step < 100; ++step)
        fallen.fly(state.position, state.velocity, 0.5);
    expect_at_most("error of the energy, share", std::abs(energy(state) / before - 1), 1e-9);
}

TEST(Colliders, F19_LetWhatHasTooManyImpactsAtOnceRestWhereItIs)
{
    const Colliders slit(
        {with(plane({0, 0, 0}, {0, 0, 1}), 1, 0), with(plane({0, 0, 1e-3}, {0, 0, -1}), 1, 0)}, {}, frame);
    State state{{0, 0, 5e-4}, {3, 0, 1}}; // seventeen widths in a frame
    const auto met = slit.fly(state.position, state.velocity, frame);
    EXPECT_TRUE(met.cut_off);
    expect_at_most("impacts in a frame, slit", met.impacts, 7);
    EXPECT_EQ(state.velocity, Vector3d(0, 0, 0));
    EXPECT_NEAR(state.position.x(), 3 * 7.5e-3, 1e-15) << "where the eighth would have been";
}

// Seven widths of the slit, and at the eighth meeting the wall at its end.
TEST(Colliders, KillWhatMeetsItsEndAtTheLastMeetingThatItMayHave)
{
    ColliderSettings end = plane({3 * 7e-3, 0, 0}, {-1, 0, 0});
    end.on_hit = OnHit::Kill;
    const Colliders slit(
        {with(plane({0, 0, 0}, {0, 0, 1}), 1, 0), with(plane({0, 0, 1e-3}, {0, 0, -1}), 1, 0), end}, {},
        frame);
    Vector3d position(0, 0, 5e-4), velocity(3, 0, 1);
    const auto met = slit.fly(position, velocity, frame);
    EXPECT_TRUE(met.killed);
    EXPECT_FALSE(met.cut_off);
    EXPECT_EQ(met.impacts, Colliders::most_meetings);
}

// What the bound of a cluster promises: nobody in a ball that cannot touch does.
TEST(Colliders, NeverMissAClusterWhoseMemberTouches)
{
    UniformFields fields = falling();
    fields.drag = 2;
    fields.wind = {4, -3, 1};
    const Colliders colliders(one_of_each(), fields, 0.1);
    expect_no_touch_missed(colliders, 100'000, 10'000);
}

} // namespace
} // namespace slod::test
