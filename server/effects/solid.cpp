#include "effects/solid.hpp"

#include <array>
#include <numbers>

#include <Eigen/Geometry>

#include "core/portable_math.hpp"
#include "effects/shape_keys.hpp"

namespace slod {
namespace {

/// In the order of ColliderShape.
constexpr std::array kinds{&plane_kind,   &sphere_kind, &box_kind,         &cone_kind,
                           &capsule_kind, &mesh_kind,   &heightfield_kind, &distance_grid_kind};
static_assert(kinds.size() == names(ColliderShape{}).size());

} // namespace

Problems problems(const ColliderSettings& settings)
{
    const SolidKind& kind = *kinds[std::size_t(settings.shape)];
    const ColliderSettings defaults;
    const std::array<ShapeKey, 9> keys{
        {{"normal", settings.normal != defaults.normal, kind.normal},
         {"radius", settings.radius != defaults.radius, kind.radius},
         {"half_extent", settings.half_extent != defaults.half_extent, kind.half_extent},
         {"axis", settings.axis != defaults.axis, kind.axis},
         {"rotation", settings.rotation != defaults.rotation, kind.rotation},
         {"file", settings.file != defaults.file, kind.file},
         {"scale", settings.scale != defaults.scale, kind.scale},
         {"spacing", settings.spacing != defaults.spacing, kind.spacing},
         {"thickness", settings.thickness != defaults.thickness, kind.thickness}}};
    Problems found = kind.problems(settings);
    refuse_unused(keys, names(settings.shape)[std::size_t(settings.shape)], found);
    return found;
}

std::unique_ptr<Solid> make_solid(const ColliderSettings& settings)
{
    const SolidKind& kind = *kinds[std::size_t(settings.shape)];
    return kind.make == nullptr ? nullptr : kind.make(settings);
}

Matrix3d rotation_of(const ColliderSettings& settings)
{
    Matrix3d rotation = Matrix3d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto [sine, cosine] = portable_sincos(settings.rotation[axis] * (std::numbers::pi / 180));
        const int y = (axis + 1) % 3, z = (axis + 2) % 3;
        Matrix3d turn = Matrix3d::Identity();
        turn(y, y) = turn(z, z) = cosine;
        turn(z, y) = sine;
        turn(y, z) = -sine;
        rotation = Matrix3d(turn * rotation);
    }
    return rotation;
}

Box box_around(const Vector3d& a, const Vector3d& b, double reach)
{
    return {a.cwiseMin(b).array() - reach, a.cwiseMax(b).array() + reach};
}

Problems radius_problems(const ColliderSettings& settings)
{
    if (settings.radius > 0)
        return {};
    return {"radius = 0 leaves nothing solid; use more than 0."};
}

Problems axis_problems(const ColliderSettings& settings)
{
    if (settings.axis.squaredNorm() > 0)
        return {};
    return {"axis = [0, 0, 0] has no direction; give it with its length, such as [0, 0, -1]."};
}

Vector3d across(const Vector3d& axis)
{
    int flattest = 0;
    axis.cwiseAbs().minCoeff(&flattest);
    return axis.cross(Vector3d(Vector3d::Unit(flattest))).normalized();
}

} // namespace slod
