#include "effects/solid.hpp"

#include <array>

#include <Eigen/Geometry>

#include "effects/shape_keys.hpp"

namespace slod {
namespace {

/// In the order of ColliderShape.
constexpr std::array kinds{&plane_kind,   &sphere_kind, &box_kind,        &cone_kind,
                           &capsule_kind, &mesh_kind,   &heightfield_kind};
static_assert(kinds.size() == names(ColliderShape{}).size());

} // namespace

Problems problems(const ColliderSettings& settings)
{
    const SolidKind& kind = *kinds[std::size_t(settings.shape)];
    const ColliderSettings defaults;
    const std::array<ShapeKey, 8> keys{
        {{"normal", settings.normal != defaults.normal, kind.normal},
         {"radius", settings.radius != defaults.radius, kind.radius},
         {"half_extent", settings.half_extent != defaults.half_extent, kind.half_extent},
         {"axis", settings.axis != defaults.axis, kind.axis},
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
