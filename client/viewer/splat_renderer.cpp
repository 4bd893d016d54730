#include "viewer/splat_renderer.hpp"

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "viewer/shaders.hpp"

namespace slod::viewer {

namespace {

using view::EllipseSplat;
using view::PointSplat;

/// Sums of many faint splats: floats of 16 bits lose what is less than a thousandth of the sum.
constexpr GLenum light_format = GL_RGBA32F;

/// Describes one member of the vertices in the bound buffer: `count` floats.
void attribute(GLuint place, GLint count, std::size_t stride, std::size_t offset)
{
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, count, GL_FLOAT, GL_FALSE, GLsizei(stride),
                          reinterpret_cast<const void*>(offset)); // OpenGL's own way to say an offset
}

void colour_attribute(GLuint place, std::size_t stride, std::size_t offset)
{
    glEnableVertexAttribArray(place);
    glVertexAttribPointer(place, 4, GL_UNSIGNED_BYTE, GL_TRUE, GLsizei(stride),
                          reinterpret_cast<const void*>(offset));
}

template <class Element>
void upload(const Buffer& buffer, const std::vector<Element>& elements)
{
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(elements.size() * sizeof(Element)), elements.data(),
                 GL_STREAM_DRAW);
}

/// Describes the ellipses in the bound buffer from one on: OpenGL 3.3 has no other way to begin there.
void describe_ellipses(std::size_t first)
{
    constexpr std::size_t stride = sizeof(EllipseSplat);
    const std::size_t start = first * stride;
    attribute(0, 2, stride, start + offsetof(EllipseSplat, x));
    attribute(1, 2, stride, start + offsetof(EllipseSplat, half_width));
    attribute(2, 3, stride, start + offsetof(EllipseSplat, a));
    attribute(3, 1, stride, start + offsetof(EllipseSplat, light));
    colour_attribute(4, stride, start + offsetof(EllipseSplat, colour));
}

} // namespace

bool draws_in_software()
{
    const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view renderer = name ? name : "";
    return renderer.find("llvmpipe") != renderer.npos || renderer.find("softpipe") != renderer.npos;
}

SplatRenderer::SplatRenderer(bool in_software)
    : in_software_(in_software), point_program_(shaders::point_vert, shaders::point_frag),
      ellipse_program_(shaders::ellipse_vert, shaders::ellipse_frag),
      tone_program_(shaders::whole_vert, shaders::tone_frag)
{
    glBindVertexArray(points_.name());
    glBindBuffer(GL_ARRAY_BUFFER, point_buffer_.name());
    attribute(0, 2, sizeof(PointSplat), offsetof(PointSplat, x));
    attribute(1, 1, sizeof(PointSplat), offsetof(PointSplat, light));
    colour_attribute(2, sizeof(PointSplat), offsetof(PointSplat, colour));

    glBindVertexArray(ellipses_.name());
    for (GLuint place = 0; place < 5; ++place)
        glVertexAttribDivisor(place, 1);
}

void SplatRenderer::draw(view::Splats& splats, const view::Viewport& viewport, double exposure, bool finest,
                         GLuint target)
{
    // Pixels of ellipses that can be shaded in a thirtieth of a second, about.
    const double budget_px = in_software_ ? 1.5e6 : 1.5e8;
    view::coarsen(splats, viewport, finest ? std::numeric_limits<double>::infinity() : budget_px);
    make_targets(splats, viewport);
    // Light is scaled before it is summed up: what is typical becomes 1.
    const float scale = splats.typical_light > 0 ? float(exposure / splats.typical_light) : 1;
    const std::size_t coarse = splats.coarse_count;

    upload(ellipse_buffer_, splats.ellipses);
    glClearColor(0, 0, 0, 0);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, coarse_->framebuffer());
    glViewport(0, 0, coarse_->width(), coarse_->height());
    glClear(GL_COLOR_BUFFER_BIT);
    add_ellipses(0, coarse, float(coarse_->width() * splats.coarse_px),
                 float(coarse_->height() * splats.coarse_px), scale);
    glBindFramebuffer(GL_FRAMEBUFFER, light_->framebuffer());
    glViewport(0, 0, viewport.width, viewport.height);
    in_software_ ? set_points(splats, viewport, scale) : add_points(splats, viewport, scale);
    add_ellipses(coarse, splats.ellipses.size() - coarse, float(viewport.width), float(viewport.height),
                 scale);
    glDisable(GL_BLEND);

    glBindFramebuffer(GL_FRAMEBUFFER, target);
    tone_program_.use();
    tone_program_.set("light", 0);
    tone_program_.set("coarse_light", 1);
    tone_program_.set("coarse_size", float(coarse_->width() * splats.coarse_px),
                      float(coarse_->height() * splats.coarse_px));
    tone_program_.set("height", float(viewport.height));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, coarse_->texture());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, light_->texture());
    glBindVertexArray(whole_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SplatRenderer::make_targets(const view::Splats& splats, const view::Viewport& viewport)
{
    const auto make = [](std::optional<Target>& target, int width, int height, GLenum format) {
        if (target && target->width() == width && target->height() == height)
            return;
        target.reset();
        target.emplace(width, height, format);
    };
    const auto coarse = [&splats](int px) { return (px + splats.coarse_px - 1) / splats.coarse_px; };
    make(light_, viewport.width, viewport.height, light_format);
    make(coarse_, coarse(viewport.width), coarse(viewport.height), light_format);
    glBindTexture(GL_TEXTURE_2D, coarse_->texture());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Replaces all light by that of the points.
void SplatRenderer::set_points(const view::Splats& splats, const view::Viewport& viewport, float exposure)
{
    if (splats.points.empty()) {
        glClear(GL_COLOR_BUFFER_BIT);
        return;
    }
    glBindTexture(GL_TEXTURE_2D, light_->texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, viewport.width, viewport.height, GL_RGBA, GL_FLOAT,
                    point_sum_.sum(splats.points, viewport, exposure).data());
}

void SplatRenderer::add_points(const view::Splats& splats, const view::Viewport& viewport, float exposure)
{
    glClear(GL_COLOR_BUFFER_BIT);
    upload(point_buffer_, splats.points);
    point_program_.use();
    point_program_.set("viewport", float(viewport.width), float(viewport.height));
    point_program_.set("exposure", exposure);
    point_program_.set("size", float(view::point_size_px));
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(points_.name());
    glDrawArrays(GL_POINTS, 0, GLsizei(splats.points.size()));
}

/// Draws some of the ellipses that were uploaded, into a picture of so many of the viewport's pixels.
void SplatRenderer::add_ellipses(std::size_t first, std::size_t count, float width, float height,
                                 float exposure)
{
    ellipse_program_.use();
    ellipse_program_.set("viewport", width, height);
    ellipse_program_.set("exposure", exposure);
    glBindVertexArray(ellipses_.name());
    glBindBuffer(GL_ARRAY_BUFFER, ellipse_buffer_.name());
    describe_ellipses(first);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(count));
}

} // namespace slod::viewer
