#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vectors.hpp"

namespace slod {

/// A surface of triangles, as a file gives it. Those that meet share vertices.
struct Mesh {
    using Triangle = std::array<std::uint32_t, 3>; ///< vertices, counted from 0

    std::vector<Vector3d> vertices; ///< before the collider's scale and position
    std::vector<Triangle> triangles;
};

inline constexpr std::size_t max_mesh_vertices = 1U << 20;
inline constexpr std::size_t max_mesh_triangles = 1U << 21;

} // namespace slod
