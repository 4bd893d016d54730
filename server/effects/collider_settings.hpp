#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/settings.hpp"
#include "core/vectors.hpp"

namespace slod {

/// What a collider looks like. All are convex solids: particles are outside of them.
enum class ColliderShape : std::uint8_t {
    Plane,   ///< all that is below a plane
    Sphere,  ///< a ball
    Box,     ///< sides along the axes
    Cone,    ///< upright on a base that closes it
    Capsule, ///< all within a radius of a line
};

constexpr std::array<std::string_view, 5> names(ColliderShape)
{
    return {"plane", "sphere", "box", "cone", "capsule"};
}

/// Colliders in one scene.
inline constexpr std::size_t max_colliders = 256;

/// A solid that stands still and that particles bounce off.
struct ColliderSettings {
    std::string name;
    ColliderShape shape = ColliderShape::Plane;
    Vector3d position{0, 0, 0};    ///< scene length
    Vector3d normal{0, 0, 1};      ///< of a plane, any length but 0
    double radius = 1;             ///< of a sphere, a capsule, the base of a cone, scene length
    Vector3d half_extent{1, 1, 1}; ///< of a box, scene length
    Vector3d axis{0, 0, -1};       ///< of a cone or a capsule, with its length, scene length
    double restitution = 0.5;      ///< speed along the normal after an impact, as a share of that before
    double friction = 0;           ///< Coulomb's coefficient

    friend bool operator==(const ColliderSettings&, const ColliderSettings&) = default;
};

template <class Visitor>
void for_each_field(ColliderSettings& collider, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the collider: 1 to 32 of a-z, 0-9, _ and -."}, collider.name);
    visit(Field{"shape", "", "Which of the fields below say what is solid."}, collider.shape);
    visit(
        Field{
            "position", "length",
            "A point of a plane, the centre of a sphere or box, a cone's apex, one end of a capsule's axis.",
            -1e30, 1e30},
        collider.position);
    visit(Field{"normal", "", "Of a plane, away from the solid below it; any length but 0."},
          collider.normal);
    visit(Field{"radius", "length", "Of a sphere, a capsule or the base of a cone.", 0, 1e30},
          collider.radius);
    visit(Field{"half_extent", "length", "Half the sides of a box.", 0, 1e30}, collider.half_extent);
    visit(
        Field{"axis", "length",
              "From a cone's apex to the centre of its base, from one end of a capsule's axis to the other.",
              -1e30, 1e30},
        collider.axis);
    visit(Field{"restitution", "", "Speed away from the surface by speed towards it: 0 stays, 1 is elastic.",
                0, 1},
          collider.restitution);
    visit(Field{"friction", "", "Coulomb's coefficient, of impacts and of sliding.", 0, 1e6},
          collider.friction);
}

} // namespace slod
