#include <algorithm>
#include <cmath>

#include "view/splats.hpp"

namespace slod::view {

namespace {

constexpr int coarsest_px = 8;
constexpr float least_half_axis = 1.5; ///< of an ellipse in a coarse picture, in its pixels

/// Whether the ellipse's smaller half axis is at least so long.
bool is_smooth(const EllipseSplat& splat, float half_axis_px)
{
    const float half_difference = 0.5F * (splat.a - splat.c);
    const float steepest =
        0.5F * (splat.a + splat.c) + std::sqrt(half_difference * half_difference + splat.b * splat.b);
    return steepest * half_axis_px * half_axis_px <= 1;
}

} // namespace

void coarsen(Splats& splats, const Viewport& viewport, double budget_px)
{
    double area = 0;
    for (const EllipseSplat& splat : splats.ellipses)
        area += std::min<double>(2 * splat.half_width, viewport.width) *
                std::min<double>(2 * splat.half_height, viewport.height);
    splats.coarse_px = int(std::clamp(std::ceil(std::sqrt(area / budget_px)), 1.0, double(coarsest_px)));
    splats.coarse_count = 0;
    if (splats.coarse_px == 1)
        return;
    const float half_axis = least_half_axis * float(splats.coarse_px);
    const auto fine =
        std::partition(splats.ellipses.begin(), splats.ellipses.end(),
                       [half_axis](const EllipseSplat& splat) { return is_smooth(splat, half_axis); });
    splats.coarse_count = std::size_t(fine - splats.ellipses.begin());
}

std::span<const float> PointSum::sum(std::span<const PointSplat> points, const Viewport& viewport,
                                     float scale)
{
    constexpr std::size_t channels = 4;
    light_.assign(channels * std::size_t(viewport.width) * std::size_t(viewport.height), 0);
    for (const PointSplat& point : points) {
        const float light = scale * point.light;
        const float red = light / 255 * float(point.colour & 255);
        const float green = light / 255 * float(point.colour >> 8 & 255);
        const float blue = light / 255 * float(point.colour >> 16 & 255);
        // As OpenGL rasterises a square: the pixels whose middles are in it.
        const int left = int(std::floor(point.x - 0.5F * point_size_px + 0.5F));
        const int top = int(std::floor(point.y - 0.5F * point_size_px + 0.5F));
        for (int y = std::max(top, 0); y < std::min(top + point_size_px, viewport.height); ++y)
            for (int x = std::max(left, 0); x < std::min(left + point_size_px, viewport.width); ++x) {
                float* const pixel =
                    &light_[channels * (std::size_t(viewport.height - 1 - y) * std::size_t(viewport.width) +
                                        std::size_t(x))];
                pixel[0] += red;
                pixel[1] += green;
                pixel[2] += blue;
                pixel[3] += light;
            }
    }
    return light_;
}

} // namespace slod::view
