#include "effects/emitter_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/number_text.hpp"
#include "core/portable_math.hpp"
#include "effects/shape_keys.hpp"

namespace slod {
namespace {

/// A point of the unit circle across the emitter's direction.
Vector3d on_circle(const EmitterAxes& axes, DrawnNumbers& random)
{
    const auto turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    return turn.cosine * axes.side + turn.sine * axes.other_side;
}

double symmetric(DrawnNumbers& random)
{
    return 2 * random.uniform() - 1;
}

Vector3d of_point(const EmitterSettings&, const EmitterAxes&, DrawnNumbers)
{
    return {0, 0, 0};
}

Vector3d of_ring(const EmitterSettings& settings, const EmitterAxes& axes, DrawnNumbers random)
{
    return settings.radius * on_circle(axes, random);
}

/// The area within a radius grows with its square.
Vector3d of_disc(const EmitterSettings& settings, const EmitterAxes& axes, DrawnNumbers random)
{
    const double hole = settings.inner_radius / settings.radius;
    const double r = std::sqrt(hole * hole + random.uniform() * (1 - hole * hole));
    return settings.radius * r * on_circle(axes, random);
}

/// Archimedes: what lies between two parallel planes is in proportion to their distance. The volume within a
/// radius grows with its cube.
Vector3d of_sphere(const EmitterSettings& settings, const EmitterAxes& axes, DrawnNumbers random)
{
    const double height = symmetric(random);
    const Vector3d direction =
        height * axes.forward + std::sqrt(1 - height * height) * on_circle(axes, random);
    if (settings.fill == Fill::Surface)
        return settings.radius * direction;
    const double hollow = settings.inner_radius / settings.radius;
    const double inner = hollow * hollow * hollow;
    const double r = portable_exp(portable_log(inner + random.uniform() * (1 - inner)) / 3);
    return settings.radius * r * direction;
}

/// On a surface one pair of faces is drawn by its area.
Vector3d of_box(const EmitterSettings& settings, const EmitterAxes&, DrawnNumbers random)
{
    const Vector3d& half = settings.half_extent;
    Vector3d share{symmetric(random), symmetric(random), symmetric(random)};
    if (settings.fill == Fill::Surface) {
        const Vector3d largest = half / half.maxCoeff(); // so that no area leaves the range of numbers
        const Vector3d area{largest.y() * largest.z(), largest.z() * largest.x(), largest.x() * largest.y()};
        const double drawn = random.uniform() * (area.x() + area.y() + area.z());
        const int face = drawn < area.x() ? 0 : drawn < area.x() + area.y() ? 1 : 2;
        share[face] = std::copysign(1.0, share[face]);
    }
    return half.cwiseProduct(share);
}

/// In the order of EmitterShape.
constexpr std::array<EmitterShapeKind, 5> kinds{{
    {.draw = of_point},
    {.draw = of_disc, .numbers = 2, .radius = true, .inner_radius = true},
    {.draw = of_ring, .numbers = 1, .radius = true},
    {.draw = of_sphere, .numbers = 3, .radius = true, .inner_radius = true, .fill = true},
    {.draw = of_box, .numbers = 4, .half_extent = true, .fill = true},
}};
static_assert(kinds.size() == names(EmitterShape{}).size());
static_assert(std::ranges::max(kinds, {}, &EmitterShapeKind::numbers).numbers ==
              EmitterShapeKind::most_numbers);

} // namespace

const EmitterShapeKind& kind_of(EmitterShape shape)
{
    return kinds[std::size_t(shape)];
}

Problems shape_problems(const EmitterSettings& settings)
{
    Problems found;
    const EmitterShapeKind& kind = kind_of(settings.shape);
    const std::string_view name = names(settings.shape)[std::size_t(settings.shape)];
    const bool surface = settings.fill == Fill::Surface;
    const std::array<ShapeKey, 4> keys{{{"radius", settings.radius != 0, kind.radius},
                                        {"inner_radius", settings.inner_radius != 0, kind.inner_radius},
                                        {"half_extent", !settings.half_extent.isZero(0), kind.half_extent},
                                        {"fill", surface, kind.fill}}};
    refuse_unused(keys, name, found);
    if (kind.radius && !(settings.radius > 0))
        found.push_back("radius = 0 is that of a point; use more than 0, or shape = \"point\".");
    else if (kind.inner_radius && settings.inner_radius >= settings.radius)
        found.push_back("inner_radius = " + number_text(settings.inner_radius) +
                        " leaves nothing of radius = " + number_text(settings.radius) + "; use less.");
    if (kind.inner_radius && surface && settings.inner_radius != 0)
        found.push_back("inner_radius is no key of a surface; leave it out, or use fill = \"volume\".");
    if (kind.half_extent && settings.half_extent.isZero(0))
        found.push_back("half_extent = [0, 0, 0] is that of a point; use more than 0, or shape = \"point\".");
    else if (kind.half_extent && surface && (settings.half_extent.array() > 0).count() < 2)
        found.push_back("half_extent leaves a box without a surface; use more than 0 for two sides.");
    return found;
}

} // namespace slod
