#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "effects/mesh.hpp"

namespace slod {

/// What a collider looks like: a convex solid, or a sheet, whose triangles are such when they are given a
/// thickness. Particles are outside of them.
enum class ColliderShape : std::uint8_t {
    Plane,        ///< all that is below a plane
    Sphere,       ///< a ball
    Box,          ///< sides along the axes, before it is turned
    Cone,         ///< upright on a base that closes it
    Capsule,      ///< all within a radius of a line
    Mesh,         ///< a sheet of a file's triangles
    Heightfield,  ///< a sheet of a file's heights over a grid
    DistanceGrid, ///< a sheet where a file's distances over a grid are 0
};

constexpr std::array<std::string_view, 8> names(ColliderShape)
{
    return {"plane", "sphere", "box", "cone", "capsule", "mesh", "heightfield", "distance_grid"};
}

/// What becomes of a particle that meets a collider.
enum class OnHit : std::uint8_t {
    Bounce, ///< it goes on as restitution and friction say
    Stick,  ///< it stays where it is on the surface for good, and moves with it
    Kill,   ///< it dies
};

constexpr std::array<std::string_view, 3> names(OnHit)
{
    return {"bounce", "stick", "kill"};
}

/// Colliders in one scene.
inline constexpr std::size_t max_colliders = 256;

/// A solid that particles meet.
struct ColliderSettings {
    std::string name;
    ColliderShape shape = ColliderShape::Plane;
    Vector3d position{0, 0, 0};    ///< scene length
    Vector3d normal{0, 0, 1};      ///< of a plane, any length but 0
    double radius = 1;             ///< of a sphere, a capsule, the base of a cone, scene length
    Vector3d half_extent{1, 1, 1}; ///< of a box, scene length
    Vector3d axis{0, 0, -1};       ///< of a cone or a capsule, with its length, scene length
    Vector3d rotation{0, 0, 0};    ///< of a box or a sheet: deg about x, then y, then z
    std::string file{};            ///< of a sheet, from the scene's folder
    double scale = 1;              ///< of a sheet, or a heightfield's heights, scene length
    double spacing = 1;            ///< of a heightfield's grid, scene length
    double thickness = 1e-3;       ///< of a sheet, scene length
    Vector3d velocity{0, 0, 0};    ///< scene length / time
    OnHit on_hit = OnHit::Bounce;
    double restitution = 0.5;           ///< speed along the normal after an impact, as a share of that before
    double friction = 0;                ///< Coulomb's coefficient
    std::shared_ptr<const Mesh> mesh{}; ///< what is in the file, of all copies of these settings

    friend bool operator==(const ColliderSettings&, const ColliderSettings&) = default;
};

template <class Visitor>
void for_each_field(ColliderSettings& collider, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the collider: 1 to 32 of a-z, 0-9, _ and -."}, collider.name);
    visit(Field{"shape", "", "Which of the fields below say what is solid."}, collider.shape);
    visit(Field{"position", "length",
                "A point of a plane, the centre of a sphere or box, a cone's apex, one end of a capsule's "
                "axis, the "
                "origin of a file's coordinates; at time 0.",
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
    visit(Field{"rotation", "deg",
                "Of a box or of what comes from a file, about its position: first about x, then y, then z.",
                -360, 360},
          collider.rotation);
    visit(
        Field{
            "file", "",
            "Of a mesh (Wavefront OBJ, faces of at most 64 vertices, 256 triangles at each), a heightfield "
            "(rows of heights, along x) or a distance_grid (SDFGen's text: numbers of samples, first place, "
            "spacing, and the distances, x fastest; a hollow sheet where they are 0, open where the grid "
            "ends), from the scene's folder."},
        collider.file);
    visit(Field{"scale", "length", "What 1 is in the file; of a heightfield, in its heights.", 0, 1e30},
          collider.scale);
    visit(Field{"spacing", "length", "Of a heightfield's grid, from row to row and in a row.", 0, 1e30},
          collider.spacing);
    visit(Field{"thickness", "length", "Of what comes from a file, half of it on each side.", 0, 1e30},
          collider.thickness);
    visit(Field{"velocity", "length/time",
                "Of uniform motion from its position at time 0, whenever it is set.", -1e30, 1e30},
          collider.velocity);
    visit(Field{"on_hit", "", "What becomes of a particle: it bounces, stays there for good, or dies."},
          collider.on_hit);
    visit(Field{"restitution", "", "Speed away from the surface by speed towards it: 0 stays, 1 is elastic.",
                0, 1},
          collider.restitution);
    visit(Field{"friction", "", "Coulomb's coefficient, of impacts and of sliding.", 0, 1e6},
          collider.friction);
}

} // namespace slod
