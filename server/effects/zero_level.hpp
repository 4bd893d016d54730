#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "effects/mesh.hpp"

namespace slod {

/// Distances to a surface at the points of a regular grid.
struct DistanceGrid {
    std::array<std::size_t, 3> size; ///< points along x, y and z, at least 2 each
    Vector3d origin;                 ///< the point of the lowest coordinates
    double spacing;                  ///< from point to point along each axis, above 0
    std::vector<double> distances{}; ///< finite, below 0 inside; x fastest, then y, then z
};

/// Where the distances are 0: each cell is cut into six tetrahedra along its diagonal from the lowest corner
/// to the highest, and in each of these distances are linear (marching tetrahedra, Doi and Koide 1991, IEICE
/// Transactions E74, 214). Neighbours cut the face between them alike and share their vertices, one for each
/// edge that is crossed, so the surface has no cracks; where it leaves the grid it is open. A distance of 0
/// is outside. Where one is within a millionth of the spacing of 0, the surface goes through the point
/// itself.
///
/// Without triangles where there is no surface; none where it has more than `max_mesh_vertices` or
/// `max_mesh_triangles`.
std::optional<Mesh> zero_level(const DistanceGrid& grid);

} // namespace slod
