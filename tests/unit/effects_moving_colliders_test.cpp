#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/falling_particle.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

// Colliders in uniform motion: what happens to a particle is what who moves with them sees.
namespace slod::test {
namespace {

ColliderSettings moving(ColliderSettings collider, const Vector3d& velocity)
{
    collider.velocity = velocity;
    return collider;
}

/// Where a particle is after so many frames from the start on.
State flown(Colliders& colliders, State state, int frames)
{
    for (int i = 1; i <= frames; ++i) {
        colliders.set_frame_end(i * frame);
        colliders.fly(state.position, state.velocity, frame);
    }
    return state;
}

TEST(MovingWall, ReflectsElasticallyInItsFrame)
{
    for (const double wall : {-3.0, 0.5, 40.0}) {
        Colliders colliders({moving(with(plane({0, 0, 0}, {1, 0, 0}), 1, 0), {wall, 0, 0})}, {}, frame);
        const double speed = -50, place = 0.2;
        const State state = flown(colliders, {{place, 0, 0}, {speed, 2, 0}}, 1);
        const double met = place / (wall - speed);
        EXPECT_NEAR(state.velocity.x(), 2 * wall - speed, 1e-13);
        EXPECT_EQ(state.velocity.y(), 2);
        EXPECT_NEAR(state.position.x(), wall * met + (2 * wall - speed) * (frame - met), 1e-13);
    }
}

// Everything moves past an observer: solids, air and particles. Positions are below 30, so that each of a
// hundred frames rounds them and the shift between the two by 30 half ulps each, 1e-12 in all at worst. An
// impact on what is round, with a radius of half a hundredth, turns that into a velocity that is off by as
// much over the radius times the speed; at speeds below 15 and with errors of a few roundings before it,
// 1e-11.
TEST(MovingColliders, AreColliderAtRestToWhoMovesWithThem)
{
    UniformFields fields = falling();
    fields.drag = 0.5;
    fields.wind = {1, 2, 0};
    const Vector3d motion(2, -1, 3);
    UniformFields seen = fields;
    seen.wind += motion;
    std::vector<ColliderSettings> scene{with(plane({0, 0, -1}, {0.1, 0, 1}), 0.6, 0.2),
                                        with(box({0, 0.2, 0}, {0.7, 0.5, 0.3}), 0.9, 0.1),
                                        with(sheet(box_mesh({0.2, 0.3, 1}), 0.01), 0.8, 0)};
    Colliders at_rest(scene, fields, frame);
    for (ColliderSettings& each : scene)
        each.velocity = motion;
    Colliders in_motion(scene, seen, frame);
    std::uint32_t impacts = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        Random random(1, 0, i);
        State a{Vector3d(0, 0, 2) + random.uniform() * random_direction(random),
                2 * random_direction(random)};
        State b{a.position, a.velocity + motion};
        std::uint32_t own = 0; // three, before errors have grown from one to the next
        for (int step = 1; step <= 100 && own < 3; ++step) {
            at_rest.set_frame_end(step * frame);
            in_motion.set_frame_end(step * frame);
            own += at_rest.fly(a.position, a.velocity, frame).impacts;
            in_motion.fly(b.position, b.velocity, frame);
            ASSERT_LE((a.position + step * frame * motion - b.position).norm(), 1e-11) << i << " at " << step;
            ASSERT_LE((a.velocity + motion - b.velocity).norm(), 1e-10) << i << " at " << step;
        }
        impacts += own;
    }
    EXPECT_GT(impacts, 200U);
}

TEST(MovingFloor, CarriesWhatRestsOnIt)
{
    const Vector3d motion(0.3, 0, 0.7);
    for (const ColliderSettings& floor :
         {plane({0, 0, 0}, {0, 0, 1}), sheet(flat_mesh(9, 9, 0.5)), box({0, 0, 0}, {4, 4, 0.1})}) {
        Colliders colliders({moving(with(floor, 0.2, 0.5), motion)}, falling(), frame);
        const State landed = flown(colliders, {{1.5, 1.5, 0.6}, {0, 0, 0}}, 300);
        EXPECT_LE((landed.velocity - motion).norm(), 1e-12) << floor.name;
        EXPECT_GT(landed.position.z(), 0.7 * 300 * frame) << floor.name;
        EXPECT_LT(landed.position.z(), 0.7 * 300 * frame + 0.11) << floor.name;
    }
}

// A belt takes along what lies on it, at no more than the friction's deceleration.
TEST(MovingFloor, AcceleratesByItsFriction)
{
    Colliders belt({moving(with(plane({0, 0, 0}, {0, 0, 1}), 0, 0.2), {1, 0, 0})}, falling(), frame);
    const int frames = 20;
    const State slides = flown(belt, {{0, 0, 0}, {0, 0, 0}}, frames);
    EXPECT_NEAR(slides.velocity.x(), 0.2 * fall * frames * frame, 1e-12);
    EXPECT_NEAR(slides.position.x(), 0.1 * fall * std::pow(frames * frame, 2), 1e-12);
    EXPECT_EQ(flown(belt, {{0, 0, 0}, {0, 0, 0}}, 60).velocity, Vector3d(1, 0, 0));
}

// What two hold that move differently keeps to both, and to neither's motion along the other.
TEST(MovingWall, PushesWhatLiesOnAFloorAlongIt)
{
    Colliders colliders({with(plane({0, 0, 0}, {0, 0, 1}), 0, 0),
                         moving(with(plane({0, 0, 0}, {1, 0, -0.5}), 0, 0), {0.8, 0.4, 0})},
                        falling(), frame);
    UniformFields blown = falling();
    blown.gravity.x() = -20; // against the wall
    colliders.set_fields(blown);
    const State pushed = flown(colliders, {{0, 0, 0}, {0, 0, 0}}, 100);
    EXPECT_NEAR(pushed.position.x(), 0.8 * 100 * frame, 1e-10);
    EXPECT_NEAR(pushed.position.z(), 0, 1e-12);
    EXPECT_LE((pushed.velocity - Vector3d(0.8, 0, 0)).head<1>().norm(), 1e-12);
}

// The air's drag pulls on what would move up with the wall, and not on what lies on the floor.
TEST(MovingWall, LeavesWhatIsBlownOffAFloorBesideItAlone)
{
    UniformFields fields = falling();
    fields.drag = 0.5;
    fields.wind = {0, 0, 40};
    Colliders colliders({moving(with(plane({0, 0, 0}, {1, 0, 0}), 0, 0), {0, 0, 100}),
                         with(plane({0, 0, 0}, {0, 0, 1}), 0, 0)},
                        fields, frame);
    const State state = flown(colliders, {{0, 0, 0}, {0, 0, 0}}, 1);
    const Elapsed whole(fields.drag, frame);
    EXPECT_NEAR(state.velocity.z(), whole.drift * (0.5 * 40 - fall), 1e-15); // a rounding of 0.17, thrice
    EXPECT_NEAR(state.position.z(), whole.fall * (0.5 * 40 - fall), 1e-17);
}

TEST(MovingWall, F10_PassesNobody)
{
    const ColliderSettings wall = sheet(flat_mesh(41, 41, 1), 1e-3);
    int passed = 0;
    for (const double speed : {200.0, 1e4}) {
        Colliders colliders({moving(with(wall, 0.5, 0), {0, 0, speed})}, {}, frame);
        Random random(2, 0, 0);
        for (int i = 0; i < 20'000; ++i) {
            State state{{10 + 20 * random.uniform(), 10 + 20 * random.uniform(), 1 + 2 * random.uniform()},
                        random_direction(random)};
            if (i % 2 == 0) // onto a vertex
                state = {{std::round(state.position.x()), std::round(state.position.y()), 1}, {0, 0, 0}};
            state = flown(colliders, state, 1);
            passed += state.position.z() > speed * frame ? 0 : 1;
            ASSERT_GT(state.velocity.z(), 1.4 * speed) << "particle " << i << " at speed " << speed;
        }
    }
    expect_at_most("particles passed", passed, 0);
}

TEST(MovingColliders, NeverMissAClusterWhoseMemberTouches)
{
    std::vector<ColliderSettings> all = one_of_each();
    all.push_back(sheet(box_mesh({0.3, 0.5, 0.2}), 0.05));
    Random directions(3, 0, 0);
    for (ColliderSettings& each : all)
        each.velocity = 15 * random_direction(directions);
    Colliders colliders(all, falling(), 0.1);
    colliders.set_frame_end(0.2);
    expect_no_touch_missed(colliders, 50'000, 5'000);
}

} // namespace
} // namespace slod::test
