#pragma once

#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

struct UniformGravitySettings {
    Vector3d acceleration{0, 0, -9.81}; ///< scene length / time^2

    friend bool operator==(const UniformGravitySettings&, const UniformGravitySettings&) = default;
};

/// Air resistance proportional to the velocity relative to the air.
struct LinearDragSettings {
    double rate = 0.1; ///< 1 / time

    friend bool operator==(const LinearDragSettings&, const LinearDragSettings&) = default;
};

/// The air's velocity; acts through the drag alone.
struct UniformWindSettings {
    Vector3d velocity{0, 0, 0}; ///< scene length / time

    friend bool operator==(const UniformWindSettings&, const UniformWindSettings&) = default;
};

template <class Visitor>
void for_each_field(UniformGravitySettings& gravity, Visitor&& visit)
{
    visit(Field{"acceleration", "length/time^2", "Acceleration of everything.", -1e30, 1e30},
          gravity.acceleration);
}

template <class Visitor>
void for_each_field(LinearDragSettings& drag, Visitor&& visit)
{
    visit(Field{"rate", "1/time", "Velocity relative to the air decays at this rate.", 0, 1e30}, drag.rate);
}

template <class Visitor>
void for_each_field(UniformWindSettings& wind, Visitor&& visit)
{
    visit(Field{"velocity", "length/time", "Velocity of the air; acts through the drag.", -1e30, 1e30},
          wind.velocity);
}

} // namespace slod
