#pragma once

#include <optional>

#include "view/camera.hpp"

namespace slod::view {

/// A place in the picture [px] from its top left corner, y downwards.
struct Pixel {
    double x = 0;
    double y = 0;
};

/// A line of sight: origin + t direction, t > 0.
struct Ray {
    Vector origin;
    Vector direction; ///< of length 1
};

/// A camera with the size of its picture: what goes from the scene to pixels and back.
class Lens {
public:
    Lens(const Camera& camera, const Viewport& viewport);

    /// As seen from the eye: x to the right, y up, z along the sight.
    Vector seen(const Vector& place) const;

    /// Nothing for what is not in front of the eye.
    std::optional<Pixel> project(const Vector& place) const;

    Ray ray(const Pixel& pixel) const;

    const Viewport& viewport() const { return viewport_; }
    const Vector& eye() const { return eye_; }
    const Vector& forward() const { return forward_; }
    const Vector& right() const { return right_; }
    const Vector& up() const { return up_; }

    /// Pixels that a length of 1 takes at a depth of 1.
    double focal_px() const { return focal_px_; }

    /// What is nearer than this is not shown.
    double near_depth() const { return near_depth_; }

private:
    Viewport viewport_;
    Vector eye_, forward_, right_, up_;
    double focal_px_;
    double near_depth_;
};

} // namespace slod::view
