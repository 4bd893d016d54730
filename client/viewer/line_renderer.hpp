#pragma once

#include <cstdint>
#include <vector>

#include "view/lens.hpp"
#include "viewer/gl_objects.hpp"

namespace slod::viewer {

/// Collects lines and dots in the scene, and draws them over what is there, a pixel wide.
class LineRenderer {
public:
    LineRenderer();

    /// Starts anew, for one lens.
    void begin(const view::Lens& lens);

    /// Colours are bytes red, green, blue, 255.
    void add_line(const view::Vector& from, const view::Vector& to, std::uint32_t colour);
    void add_dot(const view::Vector& place, std::uint32_t colour);

    /// Draws into the bound framebuffer.
    void draw();

private:
    struct Vertex {
        float right, up, forward; ///< from the eye, in scene length
        std::uint32_t colour;
    };

    Vertex vertex(const view::Vector& place, std::uint32_t colour) const;
    void draw(GLenum mode, const std::vector<Vertex>& vertices);

    view::Lens lens_;
    std::vector<Vertex> lines_, dots_;
    Program program_;
    Buffer buffer_;
    VertexArray vertices_;
};

} // namespace slod::viewer
