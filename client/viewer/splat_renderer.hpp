#pragma once

#include <optional>

#include "view/splats.hpp"
#include "viewer/gl_objects.hpp"

namespace slod::viewer {

/// Whether OpenGL has no graphics card to draw with: Mesa's software drivers.
bool draws_in_software();

/// Draws splats as light that adds up, and then what a screen can show of it.
class SplatRenderer {
public:
    /// `in_software`: this processor draws. It shades pixels slowly and sets up points more slowly still, so
    /// points are summed up without OpenGL, and large ellipses get coarse sooner.
    explicit SplatRenderer(bool in_software = draws_in_software());

    /// Fills the framebuffer `target`, of the viewport's size. `exposure` is the brightness of what is
    /// typically bright; 1 is sensible. Reorders the splats.
    /// Unless all shall be as fine as can be, many large ellipses are drawn coarser.
    void draw(view::Splats& splats, const view::Viewport& viewport, double exposure, bool finest,
              GLuint target);

private:
    void make_targets(const view::Splats& splats, const view::Viewport& viewport);
    void set_points(const view::Splats& splats, const view::Viewport& viewport, float exposure);
    void add_points(const view::Splats& splats, const view::Viewport& viewport, float exposure);
    void add_ellipses(std::size_t first, std::size_t count, float width, float height, float exposure);

    bool in_software_;
    Program point_program_, ellipse_program_, tone_program_;
    Buffer point_buffer_, ellipse_buffer_;
    VertexArray points_, ellipses_, whole_;
    view::PointSum point_sum_;
    std::optional<Target> light_;  ///< coloured light, and light, of the viewport's size
    std::optional<Target> coarse_; ///< likewise, of smooth ellipses, in coarser pixels
};

} // namespace slod::viewer
