#pragma once

#include <array>
#include <memory>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "effects/collider_settings.hpp"
#include "tree/box.hpp"

namespace slod {

/// Where a solid's surface is, as seen from some point.
struct Surface {
    double distance; ///< to its nearest point, exact; below 0 inside, where it is the way out
    Vector3d normal; ///< unit vector in which the distance grows fastest; one of them where there are several
};

/// Around a place where a solid is touched only because another one, which it is joined to, is nearer: all
/// that is above some planes.
struct Cover {
    struct Limit {
        Vector3d inward; ///< unit vector
        double height;   ///< of the place above the plane, at least 0
    };
    std::array<Limit, 4> limits;
    int count = 0; ///< 0: there is no such other one
};

/// A convex solid. A new one takes a file of its own with its SolidKind, and a line in solid.cpp.
class Solid {
public:
    virtual ~Solid() = default;

    virtual Surface surface(const Vector3d& x) const = 0;

    /// A box that holds it; infinite where it is.
    virtual Box bounds() const = 0;

    /// At `x`, where it is touched.
    virtual Cover cover(const Vector3d& /*x*/) const { return {}; }

    /// The angle that the normal at `x`, where it is touched, may be off by for the rounding of places.
    virtual double slack(const Vector3d& /*x*/) const { return 0; }
};

/// How solids of one shape come about.
struct SolidKind {
    /// What is wrong with the settings of its shape, each with the key in front.
    Problems (*problems)(const ColliderSettings& settings);
    std::unique_ptr<Solid> (*make)(const ColliderSettings& settings); ///< null where it is a sheet
    // Which keys besides the position say where it is and how large.
    bool normal = false, radius = false, half_extent = false, axis = false, rotation = false;
    bool file = false, scale = false, spacing = false, thickness = false;
};

extern const SolidKind plane_kind, sphere_kind, box_kind, cone_kind, capsule_kind, mesh_kind,
    heightfield_kind, distance_grid_kind;

/// What is wrong with a collider's geometry, keys of other shapes among it, each with the key in front; empty
/// when nothing is.
Problems problems(const ColliderSettings& settings);

/// The solid of settings without problems; null where they describe a sheet, which is none but many.
std::unique_ptr<Solid> make_solid(const ColliderSettings& settings);

/// From the solid's own axes, or its file's, to the scene's.
Matrix3d rotation_of(const ColliderSettings& settings);

/// A box around both points and all within `reach` of them.
Box box_around(const Vector3d& a, const Vector3d& b, double reach);

// Sentences that several shapes need.
Problems radius_problems(const ColliderSettings& settings);
Problems axis_problems(const ColliderSettings& settings);

/// A unit vector across `axis`, always the same one.
Vector3d across(const Vector3d& axis);

} // namespace slod
