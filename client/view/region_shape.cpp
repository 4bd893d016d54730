#include "view/region_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace slod::view {

namespace {

Vector vector_of(const std::array<double, 3>& from)
{
    return {from[0], from[1], from[2]};
}

/// Where on the line centre + t axis the sight through a pixel passes it nearest; nothing when they run
/// almost alike.
std::optional<double> along_axis(const Vector& centre, int axis, const Ray& ray)
{
    const Vector unit = Vector::Unit(axis);
    const double cosine = unit.dot(ray.direction);
    const double sine_squared = 1 - cosine * cosine;
    constexpr double too_alike = 1e-3;
    if (sine_squared < too_alike)
        return {};
    const Vector between = ray.origin - centre;
    return (between.dot(unit) - between.dot(ray.direction) * cosine) / sine_squared;
}

RegionPose moved(RegionPose pose, const Lens& lens, const Pixel& from, const Pixel& to)
{
    const double depth = lens.seen(pose.centre).z();
    const double scale = depth / lens.focal_px();
    pose.centre += scale * ((to.x - from.x) * lens.right() - (to.y - from.y) * lens.up());
    return pose;
}

RegionPose resized(RegionPose pose, const Handle& handle, double shift)
{
    constexpr double least_share = 0.01; // of the size when the drag began: never empty, never inside out
    const int axis = handle.axis;
    if (pose.sphere) {
        pose.radius = std::max(pose.radius + handle.side * shift, least_share * pose.radius);
        return pose;
    }
    const double before = pose.half_extent[axis];
    const double after = std::max(before + 0.5 * handle.side * shift, least_share * before);
    pose.half_extent[axis] = after;
    pose.centre[axis] += handle.side * (after - before);
    return pose;
}

void add_rectangle(const std::array<Vector, 4>& corners, std::vector<Segment>& segments)
{
    for (std::size_t i = 0; i < 4; ++i)
        segments.push_back({corners[i], corners[(i + 1) % 4]});
}

void outline_box(const RegionPose& pose, std::vector<Segment>& segments)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const int first : {-1, 1})
            for (const int second : {-1, 1}) {
                Vector middle = pose.centre;
                const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                middle[u] += first * pose.half_extent[u];
                middle[v] += second * pose.half_extent[v];
                const Vector half = pose.half_extent[axis] * Vector::Unit(axis);
                segments.push_back({middle - half, middle + half});
            }
}

void outline_sphere(const RegionPose& pose, std::vector<Segment>& segments)
{
    constexpr int steps = 64;
    for (int axis = 0; axis < 3; ++axis) {
        const Vector u = pose.radius * Vector::Unit((axis + 1) % 3),
                     v = pose.radius * Vector::Unit((axis + 2) % 3);
        Vector last = pose.centre + u;
        for (int step = 1; step <= steps; ++step) {
            const double angle = 2 * std::numbers::pi * step / steps;
            const Vector next = pose.centre + std::cos(angle) * u + std::sin(angle) * v;
            segments.push_back({last, next});
            last = next;
        }
    }
}

void outline_frustum(const client::RegionInfo& region, double length, std::vector<Segment>& segments)
{
    const Vector eye = vector_of(region.centre);
    const Vector forward = vector_of(region.direction).normalized();
    const Vector right = forward.cross(vector_of(region.up)).normalized();
    const Vector up = right.cross(forward);
    const double half_height = std::tan(region.field_of_view_deg * std::numbers::pi / 360);
    const auto corners = [&](double depth) {
        const Vector x = depth * half_height * region.aspect * right, y = depth * half_height * up;
        const Vector middle = eye + depth * forward;
        return std::array<Vector, 4>{middle + x + y, middle - x + y, middle - x - y, middle + x - y};
    };
    const std::array<Vector, 4> near = corners(region.near_distance);
    const std::array<Vector, 4> far = corners(std::min(region.far_distance, region.near_distance + length));
    add_rectangle(near, segments);
    add_rectangle(far, segments);
    for (std::size_t i = 0; i < 4; ++i)
        segments.push_back({near[i], far[i]});
}

} // namespace

std::optional<RegionPose> pose_of(const client::RegionInfo& region)
{
    if (region.shape != "box" && region.shape != "sphere")
        return {};
    return RegionPose{.sphere = region.shape == "sphere",
                      .centre = vector_of(region.centre),
                      .half_extent = vector_of(region.half_extent),
                      .radius = region.radius};
}

Vector place_of(const Handle& handle, const RegionPose& pose)
{
    if (handle.is_centre())
        return pose.centre;
    const double distance = pose.sphere ? pose.radius : pose.half_extent[handle.axis];
    return pose.centre + handle.side * distance * Vector::Unit(handle.axis);
}

const std::vector<Handle>& all_handles()
{
    static const std::vector<Handle> handles{{-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {2, -1}, {2, 1}};
    return handles;
}

bool can_be_dragged(const Handle& handle, const RegionPose& pose, const Lens& lens)
{
    const auto at = lens.project(place_of(handle, pose));
    return at && (handle.is_centre() || along_axis(pose.centre, handle.axis, lens.ray(*at)));
}

RegionPose dragged(const RegionPose& pose, const Handle& handle, const Lens& lens, const Pixel& from,
                   const Pixel& to)
{
    if (handle.is_centre())
        return moved(pose, lens, from, to);
    const auto before = along_axis(pose.centre, handle.axis, lens.ray(from));
    const auto after = along_axis(pose.centre, handle.axis, lens.ray(to));
    return before && after ? resized(pose, handle, *after - *before) : pose;
}

std::vector<Segment> outline(const client::RegionInfo& region, const RegionPose* pose, double frustum_length)
{
    std::vector<Segment> segments;
    const std::optional<RegionPose> own = pose_of(region);
    if (region.shape == "frustum")
        outline_frustum(region, frustum_length, segments);
    else if (own && (pose ? *pose : *own).sphere)
        outline_sphere(pose ? *pose : *own, segments);
    else if (own)
        outline_box(pose ? *pose : *own, segments);
    return segments;
}

} // namespace slod::view
