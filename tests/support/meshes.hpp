#pragma once

#include <memory>
#include <utility>

#include "effects/collider_settings.hpp"

namespace slod::test {

/// A mesh's sheet, with the thickness that it has in a scene where nothing else is said.
inline ColliderSettings sheet(Mesh mesh, double thickness = 1e-3)
{
    ColliderSettings settings{.name = "sheet", .shape = ColliderShape::Mesh, .thickness = thickness};
    settings.mesh = std::make_shared<const Mesh>(std::move(mesh));
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
