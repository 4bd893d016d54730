#pragma once

#include <cstdint>

#include <gtest/gtest.h>

#include "effects/colliders.hpp"
#include "support/random_draws.hpp"

// A single particle that falls among colliders, in frames of a sixtieth.
namespace slod::test {

constexpr double frame = 1.0 / 60;
constexpr double fall = 9.81;

inline UniformFields falling()
{
    UniformFields fields;
    fields.gravity = {0, 0, -fall};
    return fields;
}

struct State {
    Vector3d position, velocity;
};

/// Looks at balls about moving places among colliders of about the size 1: where one cannot touch anything
/// within 0.1, no particle in it does. At least so many balls must be free, and a thousand particles touch
/// something.
inline void expect_no_touch_missed(const Colliders& colliders, std::uint64_t draws, int least_free)
{
    int free = 0, touching = 0;
    for (std::uint64_t i = 0; i < draws; ++i) {
        Random random(30, 0, i);
        const Vector3d centre = Vector3d(0, 0, 3) + 3 * random.uniform() * random_direction(random);
        const Vector3d velocity = 20 * random.uniform() * random_direction(random);
        const double radius = random.uniform();
        State member{centre + radius * random.uniform() * random_direction(random), velocity};
        const bool may = colliders.may_touch(centre, velocity, radius, 0.1);
        const bool does = colliders.fly(member.position, member.velocity, 0.1).touched;
        ASSERT_FALSE(does && !may) << "draw " << i;
        free += may ? 0 : 1;
        touching += does ? 1 : 0;
    }
    EXPECT_GT(free, least_free);
    EXPECT_GT(touching, 1000);
}

} // namespace slod::test
