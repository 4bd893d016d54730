#include "view/lens.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace slod::view {

Lens::Lens(const Camera& camera, const Viewport& viewport)
    : viewport_(viewport), eye_(camera.eye()), forward_(camera.forward()), right_(camera.right()),
      up_(camera.up()),
      focal_px_(viewport.height / (2 * std::tan(camera.field_of_view_deg * std::numbers::pi / 360))),
      near_depth_(1e-3 * camera.distance)
{}

Vector Lens::seen(const Vector& place) const
{
    const Vector from_eye = place - eye_;
    return {from_eye.dot(right_), from_eye.dot(up_), from_eye.dot(forward_)};
}

std::optional<Pixel> Lens::project(const Vector& place) const
{
    const Vector at = seen(place);
    if (!(at.z() > near_depth_))
        return {};
    return Pixel{viewport_.width / 2.0 + focal_px_ * at.x() / at.z(),
                 viewport_.height / 2.0 - focal_px_ * at.y() / at.z()};
}

Ray Lens::ray(const Pixel& pixel) const
{
    const Vector direction = focal_px_ * forward_ + (pixel.x - viewport_.width / 2.0) * right_ +
                             (viewport_.height / 2.0 - pixel.y) * up_;
    return {eye_, direction.normalized()};
}

} // namespace slod::view
