#include "effects/sinks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "effects/shape_keys.hpp"

namespace slod {
namespace {

double from_plane(const SinkSettings& plane, const Vector3d& x)
{
    return plane.normal.dot(x - plane.position);
}

double from_box(const SinkSettings& box, const Vector3d& x)
{
    const Vector3d beyond = (x - box.position).cwiseAbs() - box.half_extent; // of each pair of faces
    const double outside = beyond.cwiseMax(0.0).norm();
    return outside > 0 ? outside : beyond.maxCoeff();
}

double from_sphere(const SinkSettings& sphere, const Vector3d& x)
{
    return (x - sphere.position).norm() - sphere.radius;
}

/// The way is within a pair of faces for some of the time, and within all three pairs at some time.
bool crosses_box(const SinkSettings& box, const Vector3d& from, const Vector3d& to)
{
    double entry = 0, exit = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double start = from[axis] - box.position[axis], way = to[axis] - from[axis];
        if (way == 0) {
            if (!(std::abs(start) < box.half_extent[axis]))
                return false;
            continue;
        }
        const double lower = (-box.half_extent[axis] - start) / way;
        const double upper = (box.half_extent[axis] - start) / way;
        entry = std::max(entry, std::min(lower, upper));
        exit = std::min(exit, std::max(lower, upper));
    }
    return entry < exit;
}

/// By the point of the way that is nearest to the centre.
bool crosses_sphere(const SinkSettings& sphere, const Vector3d& from, const Vector3d& to)
{
    const Vector3d way = to - from;
    const double length_squared = way.squaredNorm();
    const double share = length_squared > 0 ? (sphere.position - from).dot(way) / length_squared : 0.0;
    return from_sphere(sphere, from + std::clamp(share, 0.0, 1.0) * way) < 0;
}

/// A shape, and which of the keys say what it takes.
struct SinkKind {
    Sinks::Distance distance;
    Sinks::Crosses crosses = nullptr; ///< null: whoever does so ends up in it
    bool normal = false, half_extent = false, radius = false, outside = false;
};

/// In the order of SinkShape.
constexpr std::array<SinkKind, 3> kinds{{
    {.distance = from_plane, .normal = true},
    {.distance = from_box, .crosses = crosses_box, .half_extent = true, .outside = true},
    {.distance = from_sphere, .crosses = crosses_sphere, .radius = true, .outside = true},
}};
static_assert(kinds.size() == names(SinkShape{}).size());

const SinkKind& kind_of(const SinkSettings& sink)
{
    return kinds[std::size_t(sink.shape)];
}

double distance(const SinkSettings& sink, const Vector3d& x)
{
    const double from_shape = kind_of(sink).distance(sink, x);
    return sink.outside ? -from_shape : from_shape;
}

/// A straight way that begins and ends in a convex shape never leaves it, nor one half of space.
bool is_thin(const SinkSettings& sink)
{
    return kind_of(sink).crosses != nullptr && !sink.outside;
}

} // namespace

Sinks::Sinks(std::vector<SinkSettings> settings) : all_(std::move(settings))
{
    for (SinkSettings& sink : all_)
        sink.normal.stableNormalize();
    thin_ = std::any_of(all_.begin(), all_.end(), is_thin);
}

bool Sinks::hold(const Vector3d& position) const
{
    return reach(position, 0);
}

bool Sinks::meet(const Vector3d& from, const Vector3d& to) const
{
    return std::any_of(all_.begin(), all_.end(), [&](const SinkSettings& sink) {
        return distance(sink, to) < 0 || (is_thin(sink) && kind_of(sink).crosses(sink, from, to));
    });
}

bool Sinks::reach(const Vector3d& centre, double radius) const
{
    return std::any_of(all_.begin(), all_.end(),
                       [&](const SinkSettings& sink) { return distance(sink, centre) < radius; });
}

Problems problems(const SinkSettings& sink)
{
    Problems found;
    const SinkKind& kind = kind_of(sink);
    const SinkSettings defaults;
    const std::array<ShapeKey, 4> keys{{{"normal", sink.normal != defaults.normal, kind.normal},
                                        {"half_extent", !sink.half_extent.isZero(0), kind.half_extent},
                                        {"radius", sink.radius != 0, kind.radius},
                                        {"outside", sink.outside, kind.outside}}};
    refuse_unused(keys, names(sink.shape)[std::size_t(sink.shape)], found);
    if (kind.normal && sink.normal.isZero(0))
        found.push_back(
            "normal = [0, 0, 0] has no direction; use one away from what dies, such as [0, 0, 1].");
    if (kind.half_extent && !(sink.half_extent.array() > 0).all())
        found.push_back("half_extent leaves a box without an inside; use more than 0 for each.");
    if (kind.radius && !(sink.radius > 0))
        found.push_back("radius = 0 leaves a sphere without an inside; use more than 0.");
    return found;
}

} // namespace slod
