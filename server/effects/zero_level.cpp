#include "effects/zero_level.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "core/assert.hpp"

namespace slod {
namespace {

/// Of the spacing: nearer to a point, triangles would be so small that rounding turns them. Distances along a
/// plane of points, which ought to be 0, are such.
constexpr double nearest = 1e-6;

/// Of a cell: bit 0 is its place along x, bit 1 along y, bit 2 along z.
using Corner = unsigned;
constexpr Corner corner_count = 8;

/// The surface of one grid, as far as its cells have been gone through.
class SurfaceBuilder {
public:
    explicit SurfaceBuilder(const DistanceGrid& grid) : grid_(grid)
    {
        const auto [nx, ny, nz] = grid.size;
        SLOD_ASSERT(nx >= 2 && ny >= 2 && nz >= 2 && grid.distances.size() == nx * ny * nz);
        for (Corner corner = 0; corner < corner_count; ++corner)
            steps_[corner] = (corner & 1U) + nx * ((corner >> 1 & 1U) + ny * (corner >> 2));
    }

    bool too_large() const
    {
        return mesh_.vertices.size() > max_mesh_vertices || mesh_.triangles.size() > max_mesh_triangles;
    }
    Mesh take() && { return std::move(mesh_); }

    /// A cell is called by its lowest corner.
    void add_cell(std::size_t cell)
    {
        const auto inside = [&](std::size_t step) { return grid_.distances[cell + step] < 0; };
        const auto count = std::count_if(steps_.begin(), steps_.end(), inside);
        if (count == 0 || count == corner_count)
            return;
        for (const Tetrahedron& tetrahedron : tetrahedra)
            add_section(cell, tetrahedron);
    }

private:
    using Tetrahedron = std::array<Corner, 4>;

    /// From the lowest corner along one axis after the other to the highest, in every order of the axes.
    static constexpr std::array<Tetrahedron, 6> tetrahedra{
        {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

    /// A triangle about the corner that is alone on its side, or what lies between two and two.
    void add_section(std::size_t cell, Tetrahedron corners)
    {
        const auto inside = [&](Corner corner) { return grid_.distances[cell + steps_[corner]] < 0; };
        const auto outer = std::partition(corners.begin(), corners.end(), inside);
        const auto crossing = [&](std::size_t in, std::size_t out) {
            return vertex(cell, corners[in], corners[out]);
        };
        switch (outer - corners.begin()) {
        case 1:
            return add(crossing(0, 1), crossing(0, 2), crossing(0, 3));
        case 2:
            add(crossing(0, 2), crossing(0, 3), crossing(1, 3));
            return add(crossing(0, 2), crossing(1, 3), crossing(1, 2));
        case 3:
            return add(crossing(0, 3), crossing(1, 3), crossing(2, 3));
        default:
            return;
        }
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
        if (a != b && b != c && c != a)
            mesh_.triangles.push_back({a, b, c});
    }

    /// Of two corners of a tetrahedron one has all bits of the other, so that a point and the bits that they
    /// differ in name an edge; without any, they name the point.
    std::uint32_t vertex(std::size_t cell, Corner inner, Corner outer)
    {
        const std::size_t inside = cell + steps_[inner], outside = cell + steps_[outer];
        if (is_on_surface(outside))
            return vertex(outside * corner_count, place(outside));
        if (is_on_surface(inside))
            return vertex(inside * corner_count, place(inside));
        const double height = grid_.distances[outside], depth = grid_.distances[inside];
        const Vector3d crossed =
            place(outside) + height / (height - depth) * (place(inside) - place(outside));
        return vertex((cell + steps_[inner & outer]) * corner_count + (inner ^ outer), crossed);
    }

    std::uint32_t vertex(std::size_t name, const Vector3d& place)
    {
        const auto [found, is_new] = vertices_.try_emplace(name, std::uint32_t(mesh_.vertices.size()));
        if (is_new)
            mesh_.vertices.push_back(place);
        return found->second;
    }

    bool is_on_surface(std::size_t point) const
    {
        return std::abs(grid_.distances[point]) <= nearest * grid_.spacing;
    }

    Vector3d place(std::size_t point) const
    {
        const auto [nx, ny, nz] = grid_.size;
        return grid_.origin + grid_.spacing * Vector3d(double(point % nx), double(point / nx % ny),
                                                       double(point / (nx * ny)));
    }

    const DistanceGrid& grid_;
    std::array<std::size_t, corner_count> steps_; ///< from a cell to its corners
    std::unordered_map<std::size_t, std::uint32_t> vertices_;
    Mesh mesh_;
};

} // namespace

std::optional<Mesh> zero_level(const DistanceGrid& grid)
{
    SurfaceBuilder surface(grid);
    const auto [nx, ny, nz] = grid.size;
    for (std::size_t z = 0; z + 1 < nz; ++z)
        for (std::size_t y = 0; y + 1 < ny; ++y)
            for (std::size_t x = 0; x + 1 < nx; ++x) {
                surface.add_cell(x + nx * (y + ny * z));
                if (surface.too_large())
                    return {};
            }
    return std::move(surface).take();
}

} // namespace slod
