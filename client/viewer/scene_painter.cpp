#include "viewer/scene_painter.hpp"

namespace slod::viewer {

void ScenePainter::paint(const client::ClusterFrame* frame, const Look& look, const view::Viewport& viewport,
                         const std::vector<OutlinedRegion>& regions, GLuint target)
{
    const view::Lens lens(look.camera, viewport);
    static const client::ClusterFrame nothing;
    const client::ClusterFrame& shown = frame ? *frame : nothing;
    view::project(shown, lens, colouring_.colours(shown, look.colours), look.detail, splats_);
    splat_renderer_.draw(splats_, viewport, look.exposure, look.finest, target);

    line_renderer_.begin(lens);
    for (const OutlinedRegion& region : regions) {
        for (const view::Segment& segment : region.segments)
            line_renderer_.add_line(segment.from, segment.to, region.colour);
        for (const view::Vector& handle : region.handles)
            line_renderer_.add_dot(handle, region.colour);
    }
    line_renderer_.draw();
}

} // namespace slod::viewer
