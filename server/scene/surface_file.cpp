#include "scene/surface_file.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scene/text_lines.hpp"

namespace slod {

namespace {

/// Lines of an OBJ file that do not change what is solid.
constexpr std::array<std::string_view, 15> passed_over{"vt",    "vn",       "vp",       "o",   "g",
                                                       "s",     "usemtl",   "l",        "p",   "mtllib",
                                                       "bevel", "c_interp", "d_interp", "lod", "mg"};

void add_vertex(const TextLines& lines, Mesh& mesh)
{
    const auto& words = lines.words();
    if (words.size() < 4)
        lines.refuse("a vertex has three coordinates; write \"v x y z\", or get the whole file.");
    if (mesh.vertices.size() == max_mesh_vertices)
        lines.refuse("more than " + std::to_string(max_mesh_vertices) + " vertices; use a coarser surface.");
    mesh.vertices.push_back({lines.number(words[1]), lines.number(words[2]), lines.number(words[3])});
}

/// "7", "7/2", "7/2/5", "7//5" or "-1".
std::uint32_t vertex_of(const TextLines& lines, std::string_view word, std::size_t count)
{
    const auto index = integer(word.substr(0, word.find('/')));
    if (!index || word.find_first_not_of("-0123456789/") != std::string_view::npos)
        lines.refuse("\"" + std::string(word) + "\" is no vertex; write its number, counted from 1.");
    const std::int64_t from_start = *index < 0 ? std::int64_t(count) + *index : *index - 1;
    if (from_start < 0 || from_start >= std::int64_t(count))
        lines.refuse("there is no vertex " + std::to_string(*index) + " yet; use 1 to " +
                     std::to_string(count) + ", or -1 for the last.");
    return std::uint32_t(from_start);
}

void add_face(const TextLines& lines, Mesh& mesh)
{
    const auto& words = lines.words();
    if (words.size() < 4)
        lines.refuse("a face has at least three vertices; write \"f 1 2 3\", or get the whole file.");
    if (words.size() - 1 > max_face_vertices)
        lines.refuse("a face of " + std::to_string(words.size() - 1) + " vertices, where " +
                     std::to_string(max_face_vertices) + " are the most; cut it up.");
    const auto vertex = [&](std::size_t word) { return vertex_of(lines, words[word], mesh.vertices.size()); };
    const std::uint32_t first = vertex(1);
    for (std::size_t word = 2; word + 1 < words.size(); ++word) {
        if (mesh.triangles.size() == max_mesh_triangles)
            lines.refuse("more than " + std::to_string(max_mesh_triangles) +
                         " triangles; use a coarser surface.");
        mesh.triangles.push_back({first, vertex(word), vertex(word + 1)});
    }
}

void refuse_crowded_vertices(const TextLines& lines, const Mesh& mesh)
{
    const std::vector<std::uint32_t> first_at = first_at_each_place(mesh.vertices);
    std::vector<std::uint32_t> meeting(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles)
        if (first_at[a] != first_at[b] && first_at[b] != first_at[c] && first_at[c] != first_at[a])
            for (const std::uint32_t vertex : {a, b, c})
                ++meeting[first_at[vertex]];
    const auto crowded = std::find_if(meeting.begin(), meeting.end(),
                                      [](std::uint32_t count) { return count > max_vertex_triangles; });
    if (crowded != meeting.end())
        lines.refuse_file(std::to_string(*crowded) + " triangles meet at vertex " +
                          std::to_string(crowded - meeting.begin() + 1) + ", where " +
                          std::to_string(max_vertex_triangles) + " are the most; cut the faces about it up.");
}

Mesh obj_mesh(TextLines& lines)
{
    Mesh mesh;
    while (lines.next()) {
        const std::string_view keyword = lines.words().front();
        if (keyword == "v")
            add_vertex(lines, mesh);
        else if (keyword == "f")
            add_face(lines, mesh);
        else if (std::find(passed_over.begin(), passed_over.end(), keyword) == passed_over.end())
            lines.refuse("this is no line of a Wavefront OBJ file of triangles; name another file, or write "
                         "this one anew.");
    }
    if (mesh.triangles.empty())
        lines.refuse_file("there is no face in it; write some (\"f 1 2 3\"), or name another file.");
    refuse_crowded_vertices(lines, mesh);
    return mesh;
}

void add_row(const TextLines& lines, std::size_t row, std::size_t columns, Mesh& mesh)
{
    const auto& words = lines.words();
    if (words.size() != columns)
        lines.refuse(std::to_string(words.size()) + " heights where the lines before have " +
                     std::to_string(columns) + "; give all as many, or get the whole file.");
    if (mesh.vertices.size() + columns > max_mesh_vertices)
        lines.refuse("more than " + std::to_string(max_mesh_vertices) + " heights; use a coarser grid.");
    for (std::size_t column = 0; column < columns; ++column)
        mesh.vertices.push_back({double(column), double(row), lines.number(words[column])});
}

Mesh height_mesh(TextLines& lines)
{
    Mesh mesh;
    std::size_t rows = 0, columns = 0;
    for (; lines.next(); ++rows) {
        if (rows == 0)
            columns = lines.words().size();
        add_row(lines, rows, columns, mesh);
    }
    if (rows < 2 || columns < 2)
        lines.refuse_file(std::to_string(rows) + " lines of " + std::to_string(columns) +
                          " heights make no surface; give at least 2 of 2.");
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto here = std::uint32_t(row * columns + column);
            const auto up = here + std::uint32_t(columns);
            mesh.triangles.push_back({here, here + 1, up + 1});
            mesh.triangles.push_back({here, up + 1, up});
        }
    }
    return mesh;
}

} // namespace

std::variant<Mesh, Problems> read_obj(const std::filesystem::path& file)
{
    return read_text(file, max_surface_file_bytes, obj_mesh);
}

std::variant<Mesh, Problems> read_heights(const std::filesystem::path& file)
{
    return read_text(file, max_surface_file_bytes, height_mesh);
}

} // namespace slod
