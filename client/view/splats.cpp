#include "view/splats.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slod::view {

namespace {

/// A pixel's own blur [px^2], added to every shadow so that thin ones do not fall between pixels.
constexpr float pixel_variance = 0.25F;

/// Light of the picture in squares, to find how bright it is where most particles are.
class LightMeter {
public:
    explicit LightMeter(const Viewport& viewport)
        : columns_(viewport.width / square_px + 1), rows_(viewport.height / square_px + 1),
          squares_(std::size_t(columns_ * rows_))
    {}

    /// Particles spread evenly over a box, of which only what is in the picture counts.
    void add(float x, float y, float half_width, float half_height, float particles)
    {
        const int first_column = int(std::floor((x - half_width) / square_px));
        const int last_column = int(std::floor((x + half_width) / square_px));
        const int first_row = int(std::floor((y - half_height) / square_px));
        const int last_row = int(std::floor((y + half_height) / square_px));
        const float each =
            particles / (float(last_column - first_column + 1) * float(last_row - first_row + 1));
        for (int row = std::max(first_row, 0); row <= std::min(last_row, rows_ - 1); ++row)
            for (int column = std::max(first_column, 0); column <= std::min(last_column, columns_ - 1);
                 ++column)
                squares_[std::size_t(row * columns_ + column)] += each;
    }

    /// The mean over particles of the light around them.
    double typical() const
    {
        double sum = 0, squared = 0;
        for (const float light : squares_) {
            sum += light;
            squared += double(light) * light;
        }
        return sum > 0 ? squared / sum / (square_px * square_px) : 0;
    }

private:
    static constexpr int square_px = 12;

    int columns_, rows_;
    std::vector<float> squares_;
};

/// The shadow of a covariance: its terms in pixels squared.
struct Shadow {
    float xx, xy, yy;

    float largest_variance() const
    {
        const float half_difference = 0.5F * (xx - yy);
        return 0.5F * (xx + yy) + std::sqrt(half_difference * half_difference + xy * xy);
    }
};

/// The linear map from the scene about one place to pixels: two rows.
struct Jacobian {
    std::array<float, 3> to_x, to_y;

    Shadow shadow(const float* c) const
    {
        const auto times = [c](const std::array<float, 3>& m) {
            return std::array<float, 3>{c[0] * m[0] + c[1] * m[1] + c[2] * m[2],
                                        c[1] * m[0] + c[3] * m[1] + c[4] * m[2],
                                        c[2] * m[0] + c[4] * m[1] + c[5] * m[2]};
        };
        const auto dot = [](const std::array<float, 3>& l, const std::array<float, 3>& r) {
            return l[0] * r[0] + l[1] * r[1] + l[2] * r[2];
        };
        const std::array<float, 3> x = times(to_x), y = times(to_y);
        return {dot(to_x, x) + pixel_variance, dot(to_y, x), dot(to_y, y) + pixel_variance};
    }
};

/// Projects the clusters of one region, whose positions are relative to one origin.
class Projector {
public:
    Projector(const Lens& lens, const std::array<double, 3>& origin, const LevelOfDetail& detail,
              Splats& splats, LightMeter& meter)
        : splats_(splats), meter_(meter), detail_(detail),
          origin_(lens.seen({origin[0], origin[1], origin[2]})), right_(lens.right()), up_(lens.up()),
          forward_(lens.forward()), width_(float(lens.viewport().width)),
          height_(float(lens.viewport().height)), focal_(float(lens.focal_px())),
          near_(float(lens.near_depth()))
    {}

    void add(const float* position, const float* covariance, float particles, std::uint32_t colour)
    {
        const Vector offset(position[0], position[1], position[2]);
        const auto z = float(origin_.z() + forward_.dot(offset));
        if (!(z > near_))
            return;
        const float to_px = focal_ / z;
        const float from_middle_x = to_px * float(origin_.x() + right_.dot(offset));
        const float from_middle_y = -to_px * float(origin_.y() + up_.dot(offset));
        const float x = 0.5F * width_ + from_middle_x;
        const float y = 0.5F * height_ + from_middle_y;
        const float spread_px = to_px * std::sqrt(covariance[0] + covariance[3] + covariance[5]);
        if (!detail_.shapes || !(spread_px >= float(detail_.point_below_px))) {
            add_point(x, y, particles, colour);
            return;
        }
        // x = f X / Z: dx = f / Z (dX - X / Z dZ), and the picture's y runs downwards.
        Jacobian jacobian;
        for (int i = 0; i < 3; ++i) {
            const auto k = std::size_t(i);
            jacobian.to_x[k] = to_px * float(right_[i]) - from_middle_x / z * float(forward_[i]);
            jacobian.to_y[k] = -to_px * float(up_[i]) - from_middle_y / z * float(forward_[i]);
        }
        const Shadow shadow = jacobian.shadow(covariance);
        if (shadow.largest_variance() - pixel_variance <
            float(detail_.point_below_px * detail_.point_below_px))
            add_point(x, y, particles, colour);
        else
            add_ellipse(x, y, shadow, particles, colour);
    }

private:
    bool inside(float x, float y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    void add_point(float x, float y, float particles, std::uint32_t colour)
    {
        if (!inside(x, y))
            return;
        meter_.add(x, y, 0, 0, particles);
        constexpr float area = point_size_px * point_size_px;
        splats_.points.push_back({x, y, particles / area, colour});
    }

    void add_ellipse(float x, float y, const Shadow& shadow, float particles, std::uint32_t colour)
    {
        constexpr float axis_squared = 8; // half axis of the ellipse, in standard deviations
        const float half_width = std::sqrt(axis_squared * shadow.xx);
        const float half_height = std::sqrt(axis_squared * shadow.yy);
        const bool seen =
            x + half_width > 0 && y + half_height > 0 && x - half_width < width_ && y - half_height < height_;
        const float determinant = shadow.xx * shadow.yy - shadow.xy * shadow.xy;
        if (!seen || !(determinant > 0) || !std::isfinite(determinant))
            return;
        constexpr float core = 0.5F; // most of an ellipse's light is in the middle half of its box
        meter_.add(x, y, core * half_width, core * half_height, particles);
        const float scale = 1 / (axis_squared * determinant);
        // The integral of (1 - u)^2 over the ellipse is a third of its area.
        const float area = std::numbers::pi_v<float> * axis_squared * std::sqrt(determinant) / 3;
        splats_.ellipses.push_back({x, y, half_width, half_height, scale * shadow.yy, -scale * shadow.xy,
                                    scale * shadow.xx, particles / area, colour});
    }

    Splats& splats_;
    LightMeter& meter_;
    LevelOfDetail detail_;
    Vector origin_, right_, up_, forward_; ///< origin as seen from the eye
    float width_, height_, focal_, near_;
};

} // namespace

void project(const client::ClusterFrame& frame, const Lens& lens, std::span<const std::uint32_t> colours,
             const LevelOfDetail& detail, Splats& splats)
{
    splats.points.clear();
    splats.ellipses.clear();
    LightMeter meter(lens.viewport());
    const std::uint32_t* colour = colours.data();
    for (const client::RegionClusters& region : frame.regions) {
        Projector projector(lens, region.origin, detail, splats, meter);
        for (std::size_t i = 0; i < region.mass.size(); ++i)
            projector.add(&region.position[3 * i], &region.covariance[6 * i], float(region.particles[i]),
                          *colour++);
    }
    splats.typical_light = meter.typical();
}

} // namespace slod::view
