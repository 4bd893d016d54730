#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "cluster/particles.hpp"

namespace slod {

/// The plane that particles are projected on; the first axis points right, the second up.
struct Plane {
    int right = 0; ///< 0: x, 1: y, 2: z
    int up = 1;

    static constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};
};

/// A square of the plane, in scene units of length.
struct Square {
    double centre_right = 0;
    double centre_up = 0;
    double half_width = 1; ///< > 0
};

/// The square that shows nearly all particles, however far the few others are: it holds all but a
/// few in a thousand along each axis, with a margin.
Square square_around(const ParticleSet& particles, const Plane& plane);

/// Surface density on a grid of square cells.
struct DensityMap {
    Square square;
    std::size_t side = 0;       ///< cells along each axis
    bool by_number = false;     ///< particles per area, because none has a mass; otherwise mass per area
    std::vector<double> values; ///< row by row, the top row first
    double faint = 0;           ///< all but the sparsest few per cent of the cells with particles are denser

    double cell_width() const { return 2 * square.half_width / double(side); }
};

/// Projects particles and smooths what is thinly populated: a value is the mean over the narrowest
/// neighbourhood that holds a few particles, so that noise does not hide a faint halo nor smoothing a
/// sharp centre. For the eye: the sum over the map is only roughly kept.
DensityMap density_map(const ParticleSet& particles, const Plane& plane, const Square& square,
                       std::size_t side);

} // namespace slod
