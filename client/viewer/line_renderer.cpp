#include "viewer/line_renderer.hpp"

#include <cstddef>

#include "viewer/shaders.hpp"

namespace slod::viewer {

namespace {

constexpr float dot_size_px = 9;

} // namespace

LineRenderer::LineRenderer()
    : lens_(view::Camera{}, view::Viewport{}), program_(shaders::line_vert, shaders::line_frag)
{
    glBindVertexArray(vertices_.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offsetof(Vertex, colour)));
}

void LineRenderer::begin(const view::Lens& lens)
{
    lens_ = lens;
    lines_.clear();
    dots_.clear();
}

LineRenderer::Vertex LineRenderer::vertex(const view::Vector& place, std::uint32_t colour) const
{
    const view::Vector seen = lens_.seen(place);
    return {float(seen.x()), float(seen.y()), float(seen.z()), colour};
}

void LineRenderer::add_line(const view::Vector& from, const view::Vector& to, std::uint32_t colour)
{
    lines_.push_back(vertex(from, colour));
    lines_.push_back(vertex(to, colour));
}

void LineRenderer::add_dot(const view::Vector& place, std::uint32_t colour)
{
    dots_.push_back(vertex(place, colour));
}

void LineRenderer::draw()
{
    const view::Viewport& viewport = lens_.viewport();
    program_.use();
    program_.set("focal", float(2 * lens_.focal_px() / viewport.width),
                 float(2 * lens_.focal_px() / viewport.height));
    program_.set("near", float(lens_.near_depth()));
    program_.set("size", dot_size_px);
    glEnable(GL_PROGRAM_POINT_SIZE);
    draw(GL_LINES, lines_);
    draw(GL_POINTS, dots_);
}

void LineRenderer::draw(GLenum mode, const std::vector<Vertex>& vertices)
{
    glBindVertexArray(vertices_.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(mode, 0, GLsizei(vertices.size()));
}

} // namespace slod::viewer
