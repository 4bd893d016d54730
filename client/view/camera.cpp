#include "view/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slod::view {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Scene length per pixel at look_at's depth.
double length_per_px(const Camera& camera, const Viewport& viewport)
{
    return 2 * camera.distance * std::tan(camera.field_of_view_deg * degree / 2) / viewport.height;
}

} // namespace

Vector Camera::eye() const
{
    return look_at - distance * forward();
}

Vector Camera::forward() const
{
    const double azimuth = azimuth_deg * degree, elevation = elevation_deg * degree;
    return {-std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
            -std::sin(elevation)};
}

Vector Camera::right() const
{
    return {-std::sin(azimuth_deg * degree), std::cos(azimuth_deg * degree), 0};
}

Vector Camera::up() const
{
    const double azimuth = azimuth_deg * degree, elevation = elevation_deg * degree;
    return {-std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
            std::cos(elevation)};
}

Camera orbited(Camera camera, double right_px, double down_px)
{
    constexpr double degrees_per_px = 0.3;
    camera.azimuth_deg = std::remainder(camera.azimuth_deg - degrees_per_px * right_px, 360.0);
    camera.elevation_deg = std::clamp(camera.elevation_deg + degrees_per_px * down_px, -90.0, 90.0);
    return camera;
}

Camera panned(Camera camera, const Viewport& viewport, double right_px, double down_px)
{
    const double scale = length_per_px(camera, viewport);
    camera.look_at += scale * (down_px * camera.up() - right_px * camera.right());
    return camera;
}

Camera zoomed(Camera camera, const Viewport& viewport, double x_px, double y_px, double factor)
{
    const double scale = length_per_px(camera, viewport);
    const Vector under_cursor = camera.look_at + scale * (x_px - viewport.width / 2.0) * camera.right() -
                                scale * (y_px - viewport.height / 2.0) * camera.up();
    camera.look_at = under_cursor + factor * (camera.look_at - under_cursor);
    camera.distance *= factor;
    return camera;
}

Camera seen_from(Camera camera, AxisView view)
{
    constexpr std::array<double, 6> azimuths{-90, 90, 0, 180, -90, -90};
    constexpr std::array<double, 6> elevations{0, 0, 0, 0, 90, -90};
    camera.azimuth_deg = azimuths[std::size_t(view)];
    camera.elevation_deg = elevations[std::size_t(view)];
    return camera;
}

Camera fitted(Camera camera, const Vector& centre, double radius)
{
    if (!(radius > 0))
        return camera;
    constexpr double share_of_height = 0.85;
    camera.look_at = centre;
    camera.distance = radius / (share_of_height * std::sin(camera.field_of_view_deg * degree / 2));
    return camera;
}

} // namespace slod::view
