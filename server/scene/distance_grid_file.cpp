#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/number_text.hpp"
#include "effects/zero_level.hpp"
#include "scene/surface_file.hpp"
#include "scene/text_lines.hpp"

namespace slod {
namespace {

/// Of 8 bytes each while a file is read: 322 along each axis.
constexpr std::size_t max_samples = std::size_t{1} << 25;

/// Of the largest coordinate: nearer to each other, rounding would turn the triangles between samples.
constexpr double least_spacing = 1e-9;

/// Far corners have coordinates that other files may have too.
constexpr double farthest = 1e30;

/// The next line of those before the distances, which has so many numbers.
const std::vector<std::string_view>& head_line(TextLines& lines, std::size_t count, const std::string& what)
{
    if (!lines.next())
        lines.refuse_file("it ends before " + what + "; get the whole file.");
    if (lines.words().size() != count)
        lines.refuse("this line is to be " + what + "; write it, or name a file of SDFGen's text.");
    return lines.words();
}

std::array<std::size_t, 3> read_size(TextLines& lines)
{
    std::array<std::size_t, 3> size{};
    std::size_t samples = 1;
    const auto& words = head_line(lines, 3, "the numbers of samples, \"nx ny nz\"");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto count = integer(words[axis]);
        if (!count || *count < 2)
            lines.refuse("\"" + std::string(words[axis]) +
                         "\" is no number of samples along an axis; write a whole one, 2 or more.");
        if (std::uint64_t(*count) > max_samples / samples)
            lines.refuse("more than " + std::to_string(max_samples) + " samples; use a coarser grid.");
        size[axis] = std::size_t(*count);
        samples *= size[axis];
    }
    return size;
}

Vector3d read_origin(TextLines& lines)
{
    const auto& words = head_line(lines, 3, "the place of the first sample, \"x y z\"");
    return {lines.number(words[0]), lines.number(words[1]), lines.number(words[2])};
}

double read_spacing(TextLines& lines, const DistanceGrid& grid)
{
    const double spacing = lines.number(head_line(lines, 1, "the spacing of the samples").front());
    if (spacing <= 0)
        lines.refuse("a spacing of " + number_text(spacing) + " leaves no grid; use more than 0.");
    for (int axis = 0; axis < 3; ++axis) {
        const double first = grid.origin[axis];
        const double last = first + spacing * double(grid.size[std::size_t(axis)] - 1);
        if (last > farthest)
            lines.refuse("the grid reaches to " + number_text(last) + "; use -1e30 to 1e30.");
        if (spacing < least_spacing * std::max(std::abs(first), std::abs(last)))
            lines.refuse("samples at " + number_text(last) +
                         " are nearer to each other than a billionth of that; use a wider spacing, or an "
                         "origin nearer to 0.");
    }
    return spacing;
}

std::string in_words(const std::array<std::size_t, 3>& size)
{
    return std::to_string(size[0]) + " by " + std::to_string(size[1]) + " by " + std::to_string(size[2]);
}

void read_distances(TextLines& lines, DistanceGrid& grid)
{
    const std::size_t samples = grid.size[0] * grid.size[1] * grid.size[2];
    while (lines.next()) {
        for (const std::string_view word : lines.words()) {
            if (grid.distances.size() == samples)
                lines.refuse("more than the " + std::to_string(samples) + " distances of a grid of " +
                             in_words(grid.size) + "; correct the first line, or get the file anew.");
            grid.distances.push_back(lines.number(word));
        }
    }
    if (grid.distances.size() < samples)
        lines.refuse_file(std::to_string(grid.distances.size()) + " distances where a grid of " +
                          in_words(grid.size) + " has " + std::to_string(samples) +
                          "; get the whole file, or correct its first line.");
}

Mesh grid_mesh(TextLines& lines)
{
    DistanceGrid grid;
    grid.size = read_size(lines);
    grid.origin = read_origin(lines);
    grid.spacing = read_spacing(lines, grid);
    read_distances(lines, grid);
    std::optional<Mesh> surface = zero_level(grid);
    if (!surface)
        lines.refuse_file("its surface has more than " + std::to_string(max_mesh_vertices) + " vertices or " +
                          std::to_string(max_mesh_triangles) + " triangles; use a coarser grid.");
    if (surface->triangles.empty()) {
        const auto [least, most] = std::minmax_element(grid.distances.begin(), grid.distances.end());
        lines.refuse_file("its distances, of " + number_text(*least) + " to " + number_text(*most) +
                          ", have no surface between inside and outside; give some below 0 and some above, "
                          "by more than rounding.");
    }
    return std::move(*surface);
}

} // namespace

std::variant<Mesh, Problems> read_distance_grid(const std::filesystem::path& file)
{
    return read_text(file, max_surface_file_bytes, grid_mesh);
}

} // namespace slod
