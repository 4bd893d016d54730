#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/frame_assembler.hpp"
#include "view/lens.hpp"

namespace slod::view {

/// A cluster that is smaller than a pixel, or close to it.
struct PointSplat {
    float x, y;           ///< px
    float light;          ///< particles per square pixel
    std::uint32_t colour; ///< bytes red, green, blue, 255
};

/// A cluster's shadow in the picture: an ellipse about (x, y), inside of which
/// u = a dx^2 + 2 b dx dy + c dy^2 is below 1. Light falls off as (1 - u)^2 from the middle, which has the
/// cluster's covariance when the ellipse's half axes are sqrt(8) standard deviations.
struct EllipseSplat {
    float x, y;                    ///< px
    float half_width, half_height; ///< of the box about the ellipse, px
    float a, b, c;                 ///< px^-2
    float light;                   ///< particles per square pixel, in the middle
    std::uint32_t colour;          ///< bytes red, green, blue, 255
};

/// Which clusters keep their shape in the picture.
struct LevelOfDetail {
    /// Smaller ones are points: the larger standard deviation of their shadow [px].
    double point_below_px = 0.8;
    bool shapes = true; ///< false: all are points
};

/// One frame seen through one lens. Light adds up, so the order does not matter.
struct Splats {
    std::vector<PointSplat> points;
    std::vector<EllipseSplat> ellipses;
    std::size_t coarse_count = 0; ///< the first ellipses are smooth enough for a picture of fewer pixels,
    int coarse_px = 1;            ///< each as wide and high as so many
    double typical_light = 0;     ///< particles per square pixel where most of them are; 0: nothing is seen
};

/// Side of the square that a point is drawn as [px].
inline constexpr int point_size_px = 2;

/// Makes splats, re-using their memory. `colours` has one for each cluster of the frame, in order.
void project(const client::ClusterFrame& frame, const Lens& lens, std::span<const std::uint32_t> colours,
             const LevelOfDetail& detail, Splats& splats);

/// Chooses how coarse the smooth ellipses are drawn, so that all boxes together have about `budget_px`
/// pixels: as fine as that allows, at most eight times coarser than the picture. Thin ellipses stay fine.
/// Reorders the ellipses.
void coarsen(Splats& splats, const Viewport& viewport, double budget_px);

/// Light of points, summed up in a picture of four floats a pixel: red, green, blue and light itself. Rows
/// run upwards. On a processor this takes a tenth of the time that OpenGL's own points do.
class PointSum {
public:
    /// The light of all points times `scale`; valid until the next call.
    std::span<const float> sum(std::span<const PointSplat> points, const Viewport& viewport, float scale);

private:
    std::vector<float> light_;
};

} // namespace slod::view
