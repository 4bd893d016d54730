#pragma once

#include <filesystem>
#include <variant>

#include "core/settings.hpp"
#include "effects/mesh.hpp"

namespace slod {

/// Longest file of a surface that is read, bytes.
inline constexpr std::uintmax_t max_surface_file_bytes = 256U << 20;

/// Reads the vertices ("v x y z") and faces ("f 1 2 3", "f 1/1/1 ...", counted backwards when negative) of a
/// Wavefront OBJ file. Faces of more than three vertices are divided into triangles about their first one;
/// all that has to do with looks, names and groups is passed over. A file that is malformed, too large or
/// without a face is refused, with file, line, text and remedy; so is one with a face of more than
/// `max_face_vertices` or a place where more than `max_vertex_triangles` meet.
std::variant<Mesh, Problems> read_obj(const std::filesystem::path& file);

/// Reads heights over a regular grid: lines of as many numbers each, at least 2 by 2; what follows a # is
/// passed over. A vertex has its place in the line as x, that of its line as y, from 0 on, and its height as
/// z; each square is divided along the diagonal from its vertex (0, 0) to (1, 1). Refuses likewise.
std::variant<Mesh, Problems> read_heights(const std::filesystem::path& file);

/// Reads distances to a surface over a regular grid, as SDFGen writes them (Batty,
/// github.com/christopherbatty/SDFGen): a line "nx ny nz" of the numbers of samples, at least 2 each, one "x
/// y z" of the place of the first sample, whose coordinates are the lowest, one of the spacing, and then as
/// many distances in any lines, x fastest, then y, then z, below 0 inside. What follows a # is passed over.
/// The mesh is the zero level. Refuses likewise, and grids of more than 2^25 samples, whose samples are
/// nearer to each other than a billionth of a coordinate, or whose distances have no surface between inside
/// and outside.
std::variant<Mesh, Problems> read_distance_grid(const std::filesystem::path& file);

} // namespace slod
