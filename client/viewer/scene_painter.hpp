#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/colour_scale.hpp"
#include "view/region_shape.hpp"
#include "view/splats.hpp"
#include "viewer/line_renderer.hpp"
#include "viewer/splat_renderer.hpp"

namespace slod::viewer {

/// How a frame is looked at.
struct Look {
    view::Camera camera;
    view::ColourScale colours;
    view::LevelOfDetail detail;
    double exposure = 1;
    bool finest = false; ///< however long it takes
};

/// A region's outline, and the handles it is dragged by.
struct OutlinedRegion {
    std::vector<view::Segment> segments;
    std::vector<view::Vector> handles;
    std::uint32_t colour = 0; ///< bytes red, green, blue, 255
};

/// Draws the scene, without anything around it.
class ScenePainter {
public:
    /// Fills the framebuffer `target`. `frame` may be null: nothing has come yet.
    void paint(const client::ClusterFrame* frame, const Look& look, const view::Viewport& viewport,
               const std::vector<OutlinedRegion>& regions, GLuint target);

    /// What the ends of the colours stand for.
    const view::Range& range() const { return colouring_.range(); }

    const view::Splats& splats() const { return splats_; }

private:
    view::Colouring colouring_;
    view::Splats splats_;
    SplatRenderer splat_renderer_;
    LineRenderer line_renderer_;
};

} // namespace slod::viewer
