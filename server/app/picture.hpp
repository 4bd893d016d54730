#pragma once

#include <cstdint>
#include <string>

#include "app/canvas.hpp"
#include "app/density_map.hpp"
#include "cluster/particles.hpp"
#include "sim/settings.hpp"

namespace slod {

/// What the picture's caption says.
struct PictureCaption {
    std::string scene;
    Units units;
    double time = 0;
    std::uint64_t clusters = 0;
};

/// Where things are in the picture, in pixels: the map is a square of `map_side`, its top left pixel at
/// (`map_left`, `map_top`); cell (column, row) of the map is one pixel.
struct PictureLayout {
    static constexpr int width = 1000, height = 900;
    static constexpr int map_left = 88, map_top = 72, map_side = 768;
    static constexpr int bar_left = map_left + map_side + 22, bar_width = 22;
};

/// The plane to look at: upright (x to the right, z up) where things fall along z, else x-y.
Plane viewing_plane(const SimulationSettings& settings);

/// A picture of the particles' surface density on a logarithmic colour scale, with axes in the scene's units.
Canvas draw_picture(const ParticleSet& particles, const Plane& plane, const PictureCaption& caption);

} // namespace slod
