#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "view/camera.hpp"

namespace slod::viewer {

/// Pixels as OpenGL gives them: bytes red, green, blue, 255, rows from the bottom.
struct Pixels {
    view::Viewport size;
    std::vector<std::uint8_t> bytes;
};

/// What is in the bound framebuffer.
Pixels read_pixels(const view::Viewport& size);

/// Writes a PNG file: whole or, with a std::runtime_error that says why, not at all.
void write_png(const Pixels& pixels, const std::filesystem::path& path);

} // namespace slod::viewer
