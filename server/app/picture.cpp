#include "app/picture.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <spdlog/fmt/fmt.h>

#include "app/scales.hpp"

namespace slod {
namespace {

using Layout = PictureLayout;
using Font = Canvas::Font;
using Align = Canvas::Align;

constexpr Colour paper{14, 15, 20};
constexpr Colour ink{214, 216, 222};
constexpr Colour faint_ink{128, 132, 142};
constexpr int tick_length = 6;
constexpr int map_right = Layout::map_left + Layout::map_side - 1;
constexpr int map_bottom = Layout::map_top + Layout::map_side - 1;

/// Logarithmic scale of densities, low < high.
struct LogScale {
    double low, high; // decimal logarithms

    double share(double value) const { return value > 0 ? (std::log10(value) - low) / (high - low) : 0; }
};

/// From the sparsest populated places to the very peak, one to six decades.
LogScale scale_of(const DensityMap& map)
{
    const double peak = *std::max_element(map.values.begin(), map.values.end());
    if (!(peak > 0))
        return {.low = 0, .high = 1};
    const double high = std::log10(peak);
    const double low = map.faint > 0 ? std::log10(map.faint) : high - 6;
    return {.low = std::clamp(low, high - 6, high - 1), .high = high};
}

void draw_map(Canvas& canvas, const DensityMap& map, const LogScale& scale)
{
    for (int row = 0; row < Layout::map_side; ++row)
        for (int column = 0; column < Layout::map_side; ++column) {
            const double value = map.values[std::size_t(row) * map.side + std::size_t(column)];
            canvas.set_pixel(Layout::map_left + column, Layout::map_top + row, colour_of(scale.share(value)));
        }
    canvas.frame(Layout::map_left - 1, Layout::map_top - 1, map_right + 1, map_bottom + 1, faint_ink);
}

void draw_axes(Canvas& canvas, const Square& square, const Plane& plane, const Units& units)
{
    constexpr int most_intervals = 9;
    const double pixels_per_length = Layout::map_side / (2 * square.half_width);
    const auto ticks = [&](double centre) {
        return round_numbers(centre - square.half_width, centre + square.half_width, most_intervals);
    };
    const auto pixels = [&](double length) { return int(std::lround(length * pixels_per_length)); };

    for (const double tick : ticks(square.centre_right)) {
        const int x = Layout::map_left + pixels(tick - square.centre_right + square.half_width);
        canvas.line(x, map_bottom + 1, x, map_bottom + tick_length, faint_ink);
        canvas.text(x, map_bottom + tick_length + 11, fmt::format("{:g}", tick), ink, Font::Medium,
                    Align::Centre);
    }
    for (const double tick : ticks(square.centre_up)) {
        const int y = Layout::map_top + pixels(square.centre_up + square.half_width - tick);
        canvas.line(Layout::map_left - tick_length, y, Layout::map_left - 1, y, faint_ink);
        canvas.text(Layout::map_left - tick_length - 5, y, fmt::format("{:g}", tick), ink, Font::Medium,
                    Align::Right);
    }
    const auto label = [&](int axis) {
        return fmt::format("{} [{}]", Plane::axis_names[std::size_t(axis)], length_unit(units));
    };
    canvas.text(Layout::map_left + Layout::map_side / 2, map_bottom + 42, label(plane.right), ink,
                Font::Large, Align::Centre);
    canvas.text_upwards(22, Layout::map_top + Layout::map_side / 2, label(plane.up), ink, Font::Large);
}

/// A power of ten with a raised exponent, or a plain 1, 10 or 100.
void draw_power(Canvas& canvas, int x, int y, int exponent)
{
    if (exponent >= 0 && exponent <= 2) {
        canvas.text(x, y, std::to_string(int(std::lround(std::pow(10, exponent)))), ink);
        return;
    }
    canvas.text(x, y, "10", ink);
    canvas.text(x + canvas.text_width("10", Font::Medium), y - 6, std::to_string(exponent), ink, Font::Small);
}

void draw_colour_bar(Canvas& canvas, const LogScale& scale, const std::string& label)
{
    constexpr int bar_right = Layout::bar_left + Layout::bar_width - 1;
    for (int row = 0; row < Layout::map_side; ++row)
        canvas.line(Layout::bar_left, map_bottom - row, bar_right, map_bottom - row,
                    colour_of(row / double(Layout::map_side - 1)));
    canvas.frame(Layout::bar_left - 1, Layout::map_top - 1, bar_right + 1, map_bottom + 1, faint_ink);

    const auto y_of = [&](double logarithm) {
        return map_bottom -
               int(std::lround((logarithm - scale.low) / (scale.high - scale.low) * (Layout::map_side - 1)));
    };
    for (int exponent = int(std::floor(scale.low)); exponent <= int(std::floor(scale.high)); ++exponent)
        for (int digit = 1; digit <= 9; ++digit) {
            const double logarithm = exponent + std::log10(digit);
            if (logarithm < scale.low || logarithm > scale.high)
                continue;
            const int y = y_of(logarithm);
            canvas.line(bar_right + 2, y, bar_right + (digit == 1 ? tick_length : tick_length / 2), y,
                        faint_ink);
            if (digit == 1)
                draw_power(canvas, bar_right + tick_length + 5, y, exponent);
        }
    canvas.text_upwards(Layout::width - 20, Layout::map_top + Layout::map_side / 2, label, ink, Font::Large);
}

std::string density_label(const DensityMap& map, const Units& units)
{
    return fmt::format("surface density [{} / {}^2]", map.by_number ? "particles" : mass_unit(units),
                       length_unit(units));
}

} // namespace

Plane viewing_plane(const SimulationSettings& settings)
{
    if (!settings.uniform_gravity)
        return {};
    const Vector3d pull = settings.uniform_gravity->acceleration.cwiseAbs();
    return pull.z() > std::max(pull.x(), pull.y()) ? Plane{.right = 0, .up = 2} : Plane{};
}

Canvas draw_picture(const ParticleSet& particles, const Plane& plane, const PictureCaption& caption)
{
    const DensityMap map = density_map(particles, plane, square_around(particles, plane), Layout::map_side);
    const LogScale scale = scale_of(map);

    Canvas canvas(Layout::width, Layout::height, paper);
    canvas.text(Layout::map_left, 28, caption.scene, ink, Font::Large);
    canvas.text(Layout::map_left, 50,
                fmt::format("t = {}, {} particles in {} clusters",
                            duration_text(caption.time * caption.units.time_s), grouped(particles.size()),
                            grouped(caption.clusters)),
                faint_ink, Font::Medium);
    draw_map(canvas, map, scale);
    draw_axes(canvas, map.square, plane, caption.units);
    draw_colour_bar(canvas, scale, density_label(map, caption.units));
    return canvas;
}

} // namespace slod
