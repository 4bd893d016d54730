#pragma once

#include <limits>
#include <string>

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

/// Throws out particles of one kind from a point, within a cone about a direction.
struct EmitterSettings {
    std::string name;
    std::string kind;            ///< of the scene's kinds
    Vector3d position{0, 0, 0};  ///< scene length
    Vector3d direction{0, 0, 1}; ///< any length but 0
    double speed = 1;            ///< scene length / time
    double speed_spread = 0;     ///< half width of a uniform distribution, as a share of the speed
    double cone_angle_deg = 0;   ///< half angle; directions are uniform in the cone
    double rate = 100;           ///< particles per time, evenly spaced
    double lifetime = std::numeric_limits<double>::infinity(); ///< time
    double particle_mass = 1;                                  ///< scene mass
    double start = 0;                                          ///< time of the first particle
    double stop = std::numeric_limits<double>::infinity();     ///< no particle from here on

    friend bool operator==(const EmitterSettings&, const EmitterSettings&) = default;
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

template <class Visitor>
void for_each_field(EmitterSettings& emitter, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the emitter: 1 to 32 of a-z, 0-9, _ and -."}, emitter.name);
    visit(Field{"kind", "", "Kind of the particles, by name."}, emitter.kind);
    visit(Field{"position", "length", "Where particles start."}, emitter.position);
    visit(Field{"direction", "", "Axis of the cone of directions; any length but 0."}, emitter.direction);
    visit(Field{"speed", "length/time", "Mean speed at birth.", 0, 1e30}, emitter.speed);
    visit(Field{"speed_spread", "", "Speeds are uniform within this share of the mean on either side.", 0, 1},
          emitter.speed_spread);
    visit(Field{"cone_angle", "deg", "Half angle of the cone; directions are uniform in it.", 0, 180},
          emitter.cone_angle_deg);
    visit(Field{"rate", "1/time", "Particles per unit of time, evenly spaced.", 0, 1e12}, emitter.rate);
    visit(Field{"lifetime", "time", "Age at which a particle vanishes.", 0, no_maximum, true},
          emitter.lifetime);
    visit(Field{"particle_mass", "mass", "Mass of each particle.", 0, 1e30}, emitter.particle_mass);
    visit(Field{"start", "time", "When the first particle starts.", 0, 1e30}, emitter.start);
    visit(Field{"stop", "time", "From here on no particle starts.", 0, no_maximum, true}, emitter.stop);
}

} // namespace slod
