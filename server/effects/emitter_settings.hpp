#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

/// What an emitter's particles start from, everywhere alike: in number by volume, area or length.
enum class EmitterShape : std::uint8_t {
    Point,
    Disc, ///< across the direction, with a hole where there is an inner radius
    Ring, ///< a circle across the direction
    Sphere,
    Box, ///< sides along the axes
};

constexpr std::array<std::string_view, 5> names(EmitterShape)
{
    return {"point", "disc", "ring", "sphere", "box"};
}

/// What of a sphere or a box.
enum class Fill : std::uint8_t { Volume, Surface };

constexpr std::array<std::string_view, 2> names(Fill)
{
    return {"volume", "surface"};
}

/// Throws out particles of one kind, from a shape, within a cone about a direction.
struct EmitterSettings {
    std::string name{};
    std::string kind{}; ///< of the scene's kinds
    EmitterShape shape = EmitterShape::Point;
    Vector3d position{0, 0, 0};    ///< of the shape's centre at time 0, scene length
    Vector3d velocity{0, 0, 0};    ///< of the emitter itself, scene length / time
    double inherit = 0;            ///< share of that velocity that its particles have besides their own
    double radius = 0;             ///< of a disc, a ring or a sphere, scene length
    double inner_radius = 0;       ///< of a disc or a sphere's volume, scene length
    Vector3d half_extent{0, 0, 0}; ///< of a box, scene length
    Fill fill = Fill::Volume;      ///< of a sphere or a box
    Vector3d direction{0, 0, 1};   ///< any length but 0
    double speed = 1;              ///< scene length / time
    double speed_spread = 0;       ///< half width of a uniform distribution, as a share of the speed
    double cone_angle_deg = 0;     ///< half angle; directions are uniform in the cone
    double rate = 100;             ///< particles per time, evenly spaced
    NumberPairs schedule{};        ///< time since the start, and rate from then on; instead of the rate
    std::uint32_t burst = 0;       ///< particles at once, at the start, besides those of the rate
    double burst_period = std::numeric_limits<double>::infinity(); ///< time from one burst to the next
    double lifetime = std::numeric_limits<double>::infinity();     ///< time
    double particle_mass = 1;                                      ///< scene mass
    double start = 0;                                              ///< time of the first particle
    double stop = std::numeric_limits<double>::infinity();         ///< no particle from here on

    friend bool operator==(const EmitterSettings&, const EmitterSettings&) = default;
};

/// What is wrong with an emitter's shape, times and numbers, the key first; empty when nothing is.
Problems problems(const EmitterSettings& settings);

template <class Visitor>
void for_each_field(EmitterSettings& emitter, Visitor&& visit)
{
    constexpr double unlimited = no_maximum;
    visit(Field{"name", "", "Name of the emitter: 1 to 32 of a-z, 0-9, _ and -."}, emitter.name);
    visit(Field{"kind", "", "Kind of the particles, by name."}, emitter.kind);
    visit(Field{"shape", "", "What particles start from, everywhere alike."}, emitter.shape);
    visit(Field{"position", "length", "Where particles start, or the centre of that, at time 0."},
          emitter.position);
    visit(Field{"velocity", "length/time", "Velocity of the emitter itself.", -1e30, 1e30}, emitter.velocity);
    visit(Field{"inherit", "", "Share of the emitter's velocity that its particles get.", 0, 1},
          emitter.inherit);
    visit(Field{"radius", "length", "Of a disc, a ring or a sphere.", 0, 1e30}, emitter.radius);
    visit(Field{"inner_radius", "length", "Of a disc's hole, or of a sphere's hollow.", 0, 1e30},
          emitter.inner_radius);
    visit(Field{"half_extent", "length", "Half the sides of a box; some may be 0.", 0, 1e30},
          emitter.half_extent);
    visit(Field{"fill", "", "What of a sphere or a box particles start from."}, emitter.fill);
    visit(
        Field{"direction", "", "Axis of the cone of directions, and of a disc or a ring; any length but 0."},
        emitter.direction);
    visit(Field{"speed", "length/time", "Mean speed at birth.", 0, 1e30}, emitter.speed);
    visit(Field{"speed_spread", "", "Speeds are uniform within this share of the mean on either side.", 0, 1},
          emitter.speed_spread);
    visit(Field{"cone_angle", "deg", "Half angle of the cone; directions are uniform in it.", 0, 180},
          emitter.cone_angle_deg);
    visit(Field{"rate", "1/time", "Particles per unit of time, evenly spaced.", 0, 1e12}, emitter.rate);
    visit(Field{"schedule", "time, 1/time",
                "Pairs of a time since the start and the rate from then on; instead of the rate.", 0, 1e12},
          emitter.schedule);
    visit(Field{"burst", "particles", "Born at once at the start, besides those of the rate, which may be 0.",
                0, 1e9},
          emitter.burst);
    visit(Field{"burst_period", "time", "From one burst to the next; inf: there is one.", 1e-12, unlimited,
                true},
          emitter.burst_period);
    visit(Field{"lifetime", "time", "Age at which a particle vanishes.", 0, unlimited, true},
          emitter.lifetime);
    visit(Field{"particle_mass", "mass", "Mass of each particle.", 0, 1e30}, emitter.particle_mass);
    visit(Field{"start", "time", "When the first particle starts.", 0, 1e30}, emitter.start);
    visit(Field{"stop", "time", "From here on no particle starts.", 0, unlimited, true}, emitter.stop);
}

} // namespace slod
