#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

/// What a sink looks like.
enum class SinkShape : std::uint8_t {
    Plane, ///< all that is behind a plane
    Box,   ///< sides along the axes
    Sphere,
};

constexpr std::array<std::string_view, 3> names(SinkShape)
{
    return {"plane", "box", "sphere"};
}

/// Sinks in one scene.
inline constexpr std::size_t max_sinks = 64;

/// A part of space in which particles die.
struct SinkSettings {
    std::string name{};
    SinkShape shape = SinkShape::Plane;
    Vector3d position{0, 0, 0};    ///< scene length
    Vector3d normal{0, 0, 1};      ///< of a plane, away from what is behind it; any length but 0
    Vector3d half_extent{0, 0, 0}; ///< of a box, scene length
    double radius = 0;             ///< of a sphere, scene length
    bool outside = false;          ///< takes what is outside of a box or a sphere

    friend bool operator==(const SinkSettings&, const SinkSettings&) = default;
};

/// What is wrong with a sink, the key first; empty when nothing is.
Problems problems(const SinkSettings& settings);

template <class Visitor>
void for_each_field(SinkSettings& sink, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the sink: 1 to 32 of a-z, 0-9, _ and -."}, sink.name);
    visit(Field{"shape", "",
                "What particles die in: all that is behind a plane, the inside of a box or a sphere."},
          sink.shape);
    visit(Field{"position", "length", "A point of a plane, the centre of a box or a sphere.", -1e30, 1e30},
          sink.position);
    visit(Field{"normal", "", "Of a plane, away from what is behind it; any length but 0."}, sink.normal);
    visit(Field{"half_extent", "length", "Half the sides of a box.", 0, 1e30}, sink.half_extent);
    visit(Field{"radius", "length", "Of a sphere.", 0, 1e30}, sink.radius);
    visit(Field{"outside", "", "A box or a sphere takes what is outside of it instead."}, sink.outside);
}

} // namespace slod
