#pragma once

#include "core/settings.hpp"

namespace slod {

/// No particle starts faster into a frame.
struct SpeedLimitSettings {
    double speed = 100; ///< scene length / time

    friend bool operator==(const SpeedLimitSettings&, const SpeedLimitSettings&) = default;
};

/// Every particle is kicked at random in every frame.
struct BrownianSettings {
    /// Root mean square change of each component of the velocity in unit time: length / time^(3/2).
    double strength = 0.1;

    friend bool operator==(const BrownianSettings&, const BrownianSettings&) = default;
};

template <class Visitor>
void for_each_field(SpeedLimitSettings& limit, Visitor&& visit)
{
    visit(Field{"speed", "length/time", "What is faster at a frame's start goes on at this speed.", 0, 1e30},
          limit.speed);
}

template <class Visitor>
void for_each_field(BrownianSettings& brownian, Visitor&& visit)
{
    visit(Field{"strength", "length/time^1.5",
                "Root mean square change of each component of the velocity in unit time.", 0, 1e30},
          brownian.strength);
}

} // namespace slod
