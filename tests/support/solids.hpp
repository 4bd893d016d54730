#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "effects/collider_settings.hpp"

namespace slod {

inline void PrintTo(const ColliderSettings& collider, std::ostream* out)
{
    *out << collider.name;
}

} // namespace slod

namespace slod::test {

inline ColliderSettings plane(const Vector3d& point, const Vector3d& normal)
{
    return {.name = "plane", .shape = ColliderShape::Plane, .position = point, .normal = normal};
}

inline ColliderSettings sphere(const Vector3d& centre, double radius)
{
    return {.name = "sphere", .shape = ColliderShape::Sphere, .position = centre, .radius = radius};
}

inline ColliderSettings box(const Vector3d& centre, const Vector3d& half_extent)
{
    return {.name = "box", .shape = ColliderShape::Box, .position = centre, .half_extent = half_extent};
}

/// The same solid, turned about its position [deg].
inline ColliderSettings turned(ColliderSettings collider, const Vector3d& rotation)
{
    collider.name = "turned_" + collider.name;
    collider.rotation = rotation;
    return collider;
}

inline ColliderSettings cone(const Vector3d& apex, const Vector3d& axis, double radius)
{
    return {.name = "cone", .shape = ColliderShape::Cone, .position = apex, .radius = radius, .axis = axis};
}

inline ColliderSettings capsule(const Vector3d& end, const Vector3d& axis, double radius)
{
    return {
        .name = "capsule", .shape = ColliderShape::Capsule, .position = end, .radius = radius, .axis = axis};
}

/// The same solid with another surface.
inline ColliderSettings with(ColliderSettings collider, double restitution, double friction)
{
    collider.restitution = restitution;
    collider.friction = friction;
    return collider;
}

/// One of each shape and a box that is turned, of about the size 1 and away from the origin, in no symmetric
/// position.
inline std::vector<ColliderSettings> one_of_each()
{
    return {plane({0.3, -0.2, 0.1}, {0.2, -0.4, 1}),
            sphere({0.4, 0.1, -0.3}, 0.8),
            box({-0.2, 0.3, 0.5}, {0.7, 0.2, 0.4}),
            cone({0.1, 0.2, 0.9}, {0.3, 0.4, -1.2}, 0.6),
            capsule({0.5, -0.4, 0.2}, {-0.6, 0.3, 0.7}, 0.35),
            turned(box({0.1, 0.4, -0.2}, {0.5, 0.3, 0.8}), {30, -50, 110})};
}

} // namespace slod::test
