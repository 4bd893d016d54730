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
inline constexpr std::size_t max_face_vertices = 64; ///< of a file's faces, which are divided

/// Triangles that meet at a place: what touches one there looks at all of them.
inline constexpr std::uint32_t max_vertex_triangles = 256;

/// For each vertex the first one at the same place, which may be itself. O(n log n).
std::vector<std::uint32_t> first_at_each_place(const std::vector<Vector3d>& vertices);

/// Edges that are of one triangle alone, where the surface is open; vertices at the same place are one. O(n
/// log n).
std::size_t rim_edges(const Mesh& mesh);

} // namespace slod
