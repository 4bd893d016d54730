#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "effects/collider_settings.hpp"
#include "effects/zero_level.hpp"

namespace slod::test {

/// A mesh's sheet, with the thickness that it has in a scene where nothing else is said.
inline ColliderSettings sheet(Mesh mesh, double thickness = 1e-3)
{
    ColliderSettings settings{.name = "sheet", .shape = ColliderShape::Mesh, .thickness = thickness};
    settings.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return settings;
}

/// Likewise where the distances are 0.
inline ColliderSettings sheet(const DistanceGrid& grid, double thickness = 1e-3)
{
    ColliderSettings settings = sheet(zero_level(grid).value(), thickness);
    settings.shape = ColliderShape::DistanceGrid;
    return settings;
}

/// Squares over a grid of so many by so many vertices from the origin on, each divided by its diagonal.
template <class Height>
Mesh grid_mesh(std::uint32_t columns, std::uint32_t rows, double spacing, const Height& height)
{
    Mesh mesh;
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            mesh.vertices.push_back({spacing * x, spacing * y, height(x, y)});
            const std::uint32_t here = y * columns + x, up = here + columns;
            if (x + 1 == columns || y + 1 == rows)
                continue;
            mesh.triangles.push_back({here, here + 1, up + 1});
            mesh.triangles.push_back({here, up + 1, up});
        }
    }
    return mesh;
}

inline Mesh flat_mesh(std::uint32_t columns, std::uint32_t rows, double spacing)
{
    return grid_mesh(columns, rows, spacing, [](std::uint32_t, std::uint32_t) { return 0.0; });
}

/// Of the vertex in that column and row of a hilly mesh.
inline double hill(int column, int row)
{
    return 0.1 * ((column * 7 + row * 5) % 4);
}

/// 8 by 8 squares with sides of a half, and hills of up to 0.3.
inline Mesh hilly_mesh()
{
    return grid_mesh(9, 9, 0.5, [](auto x, auto y) { return hill(int(x), int(y)); });
}

/// Of the hilly mesh, below or above `x`; none beside it.
inline std::optional<double> hilly_height(const Vector3d& x)
{
    const int column = int(std::floor(2 * x.x())), row = int(std::floor(2 * x.y()));
    if (column < 0 || column > 7 || row < 0 || row > 7)
        return {};
    const double along = 2 * x.x() - column, up = 2 * x.y() - row;
    const double corner = hill(column, row), far = hill(column + 1, row + 1);
    const double side = along > up ? hill(column + 1, row) : hill(column, row + 1);
    return corner + std::max(along, up) * (side - corner) + std::min(along, up) * (far - side);
}

/// What `distance` is at so many points from `origin` on.
template <class Distance>
DistanceGrid sampled(const std::array<std::size_t, 3>& size, const Vector3d& origin, double spacing,
                     const Distance& distance)
{
    DistanceGrid grid{size, origin, spacing};
    for (std::size_t z = 0; z < size[2]; ++z)
        for (std::size_t y = 0; y < size[1]; ++y)
            for (std::size_t x = 0; x < size[0]; ++x)
                grid.distances.push_back(
                    distance(origin + spacing * Vector3d(double(x), double(y), double(z))));
    return grid;
}

/// Distances to a ball about the origin, at least one spacing further out than it reaches.
inline DistanceGrid ball_grid(double radius, double spacing)
{
    const auto half = std::size_t(radius / spacing) + 2;
    return sampled({2 * half + 1, 2 * half + 1, 2 * half + 1}, Vector3d::Constant(-spacing * double(half)),
                   spacing, [&](const Vector3d& x) { return x.norm() - radius; });
}

/// The hilly mesh's heights above the ground, in a grid whose tetrahedra have the mesh's diagonals below
/// them: it is where they are 0.
inline DistanceGrid hilly_grid()
{
    return sampled({9, 9, 3}, {0, 0, -0.5}, 0.5,
                   [](const Vector3d& x) { return x.z() - hill(int(2 * x.x()), int(2 * x.y())); });
}

/// The twelve triangles of a box about the origin.
inline Mesh box_mesh(const Vector3d& half_extent)
{
    Mesh mesh;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(half_extent.cwiseProduct(
            Vector3d(corner & 1U ? 1 : -1, corner & 2U ? 1 : -1, corner & 4U ? 1 : -1)));
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t across = 1U << axis, a = 1U << (axis + 1) % 3, b = 1U << (axis + 2) % 3;
        for (const std::uint32_t side : {0U, across}) {
            mesh.triangles.push_back({side, side + a, side + a + b});
            mesh.triangles.push_back({side, side + a + b, side + b});
        }
    }
    return mesh;
}

} // namespace slod::test
