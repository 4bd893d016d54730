#pragma once

#include <array>
#include <string>
#include <string_view>
#include <variant>

#include <Eigen/Core>

namespace slod::view {

using Vector = Eigen::Vector3d; ///< scene length

/// A picture's size [px].
struct Viewport {
    int width = 1280;
    int height = 720;

    friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// Where somebody looks from: on a sphere around a point, z upwards.
struct Camera {
    Vector look_at{0, 0, 0};
    double distance = 10;          ///< of the eye from look_at, scene length, above 0
    double azimuth_deg = -60;      ///< of the eye, in the xy plane from x towards y
    double elevation_deg = 25;     ///< of the eye above that plane, [-90, 90]
    double field_of_view_deg = 45; ///< vertical, [1, 150]

    Vector eye() const;
    Vector forward() const; ///< unit vectors: of sight,
    Vector right() const;   ///< to the picture's right
    Vector up() const;      ///< and to its top

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Turned about look_at as if the scene were dragged by so many pixels, to the right and down.
Camera orbited(Camera camera, double right_px, double down_px);

/// Shifted so that the scene at look_at's depth follows the cursor by so many pixels.
Camera panned(Camera camera, const Viewport& viewport, double right_px, double down_px);

/// Moved to `factor` times the distance, so that what is under the cursor at look_at's depth stays there.
Camera zoomed(Camera camera, const Viewport& viewport, double x_px, double y_px, double factor);

/// The side from which a camera looks along an axis.
enum class AxisView : unsigned char { Front, Back, Right, Left, Top, Bottom };

constexpr std::array<std::string_view, 6> names(AxisView)
{
    return {"front", "back", "right", "left", "top", "bottom"};
}

Camera seen_from(Camera camera, AxisView view);

/// The same view, near enough that a ball fills most of the picture's height. An empty ball changes nothing.
Camera fitted(Camera camera, const Vector& centre, double radius);

/// "look_at=0,0,0 distance=10 azimuth=-60 elevation=25 field_of_view=45": what camera_of() reads, to the last
/// bit.
std::string to_text(const Camera& camera);

/// Reads such a text; what it does not mention is as in Camera{}. Otherwise one sentence that says what is
/// wrong.
std::variant<Camera, std::string> camera_of(std::string_view text);

} // namespace slod::view
