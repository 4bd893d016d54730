#include "app/density_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slod {
namespace {

constexpr double outlier_share = 0.005;    // on either side of each axis
constexpr double margin = 1.1;             // of the half width
constexpr double particles_per_value = 30; // a value rests on so many: noise below a fifth
constexpr std::array<std::size_t, 6> radii{1, 2, 4, 8, 16, 32}; // cells; of one box filter

using Grid = std::vector<double>;

/// The central interval of the particles along one axis, outliers left out.
std::pair<double, double> central_interval(const ParticleSet& particles, int axis)
{
    std::vector<double> places(particles.size());
    std::transform(particles.begin(), particles.end(), places.begin(),
                   [&](const Particle& particle) { return particle.position[axis]; });
    const auto outliers = std::ptrdiff_t(outlier_share * double(places.size()));
    std::nth_element(places.begin(), places.begin() + outliers, places.end());
    const double low = places[std::size_t(outliers)];
    std::nth_element(places.begin(), places.end() - 1 - outliers, places.end());
    return {low, *(places.end() - 1 - outliers)};
}

/// Means over 2 radius + 1 values of a row, fewer near its ends; `count` values lie `stride` apart.
void box_filter(double* row, std::size_t count, std::size_t stride, std::size_t radius,
                std::vector<double>& scratch)
{
    scratch.assign(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i)
        scratch[i + 1] = scratch[i] + row[i * stride];
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = i - std::min(i, radius);
        const std::size_t last = std::min(count, i + radius + 1);
        row[i * stride] = std::max(0.0, (scratch[last] - scratch[first]) / double(last - first));
    }
}

/// Two box filters along each axis: a pyramid of base 4 radius + 1.
Grid smoothed(Grid grid, std::size_t side, std::size_t radius)
{
    std::vector<double> scratch;
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t line = 0; line < side; ++line)
            box_filter(&grid[line * side], side, 1, radius, scratch);
        for (std::size_t line = 0; line < side; ++line)
            box_filter(&grid[line], side, side, radius, scratch);
    }
    return grid;
}

/// Cells that the smoothing kernel of a radius covers effectively: 1 / (sum of its squared weights).
double kernel_area(std::size_t radius)
{
    const double width = 2 * double(radius) + 1;
    const double sum_of_squares = (2 * width * width + 1) / (3 * width * width * width);
    return 1 / (sum_of_squares * sum_of_squares);
}

/// Replaces each value by that of the narrowest smoothing with enough particles, blending two where the
/// number lies between theirs.
void smooth(Grid& values, const Grid& numbers, std::size_t side)
{
    Grid result = values;
    Grid found = numbers; // particles that the result rests on
    for (const std::size_t radius : radii) {
        const Grid wider_values = smoothed(values, side, radius);
        const Grid wider_numbers = smoothed(numbers, side, radius);
        const double area = kernel_area(radius);
        for (std::size_t cell = 0; cell < result.size(); ++cell) {
            const double here = wider_numbers[cell] * area;
            if (found[cell] >= particles_per_value || here <= found[cell])
                continue;
            const double share = std::min(1.0, (particles_per_value - found[cell]) / (here - found[cell]));
            result[cell] = std::lerp(result[cell], wider_values[cell], share);
            found[cell] = std::lerp(found[cell], here, share);
        }
    }
    values = std::move(result);
}

/// The value that only the sparsest of the cells with particles fall short of.
double faint_value(const Grid& values, const Grid& numbers)
{
    constexpr double sparsest = 0.02;
    Grid populated;
    for (std::size_t cell = 0; cell < values.size(); ++cell)
        if (numbers[cell] > 0)
            populated.push_back(values[cell]);
    if (populated.empty())
        return 0;
    const auto faint = populated.begin() + std::ptrdiff_t(sparsest * double(populated.size()));
    std::nth_element(populated.begin(), faint, populated.end());
    return *faint;
}

} // namespace

Square square_around(const ParticleSet& particles, const Plane& plane)
{
    if (particles.empty())
        return {};
    const auto [left, right] = central_interval(particles, plane.right);
    const auto [bottom, top] = central_interval(particles, plane.up);
    const double half_width = margin * std::max(right - left, top - bottom) / 2;
    return {.centre_right = (left + right) / 2,
            .centre_up = (bottom + top) / 2,
            .half_width = half_width > 0 ? half_width : 1};
}

DensityMap density_map(const ParticleSet& particles, const Plane& plane, const Square& square,
                       std::size_t side)
{
    DensityMap map{.square = square, .side = side, .by_number = true, .values = Grid(side * side)};
    for (const Particle& particle : particles)
        map.by_number = map.by_number && !(particle.mass > 0);

    Grid numbers(side * side);
    const double cells_per_length = 1 / map.cell_width();
    const auto cells = double(side);
    for (const Particle& particle : particles) {
        const double column =
            (particle.position[plane.right] - square.centre_right + square.half_width) * cells_per_length;
        const double row =
            (square.centre_up + square.half_width - particle.position[plane.up]) * cells_per_length;
        if (!(column >= 0 && column < cells && row >= 0 && row < cells))
            continue;
        const std::size_t cell = std::size_t(row) * side + std::size_t(column);
        numbers[cell] += 1;
        map.values[cell] +=
            (map.by_number ? 1.0 : double(particle.mass)) * cells_per_length * cells_per_length;
    }
    smooth(map.values, numbers, side);
    map.faint = faint_value(map.values, numbers);
    return map;
}

} // namespace slod
