#include <algorithm>
#include <string>
#include <vector>

#include "core/assert.hpp"
#include "core/number_text.hpp"
#include "effects/sheet.hpp"

namespace slod {
namespace {

/// Of a sheet's reach: thinner ones might be passed by rounding, as places of members are held as floats
/// about their cluster.
constexpr double thinnest = 1e-6;

/// The file's surface where the scene has it.
std::vector<Vector3d> placed_vertices(const ColliderSettings& settings)
{
    const bool heights = settings.shape == ColliderShape::Heightfield;
    const double across = heights ? settings.spacing : settings.scale;
    const Vector3d scale(across, across, settings.scale);
    const Matrix3d rotation = rotation_of(settings);
    std::vector<Vector3d> placed;
    placed.reserve(settings.mesh->vertices.size());
    for (const Vector3d& vertex : settings.mesh->vertices)
        placed.emplace_back(settings.position + rotation * scale.cwiseProduct(vertex));
    return placed;
}

/// The largest coordinate of any vertex.
double reach(const std::vector<Vector3d>& vertices)
{
    double reach = 0;
    for (const Vector3d& vertex : vertices)
        reach = std::max(reach, vertex.cwiseAbs().maxCoeff());
    return reach;
}

bool has_area(const std::vector<Vector3d>& vertices, const std::vector<Mesh::Triangle>& triangles)
{
    return std::any_of(triangles.begin(), triangles.end(), [&](const Mesh::Triangle& triangle) {
        const auto corner = [&](std::size_t i) { return vertices[triangle[i]]; };
        return !triangle_normal(corner(0), corner(1), corner(2)).isZero(0);
    });
}

Problems sheet_problems(const ColliderSettings& settings)
{
    Problems found;
    if (settings.file.empty() && !settings.mesh)
        found.push_back("file = \"\" names none; use that of the surface, such as \"bowl.obj\".");
    if (settings.scale == 0)
        found.push_back("scale = 0 leaves no surface; use more than 0.");
    if (settings.shape == ColliderShape::Heightfield && settings.spacing == 0)
        found.push_back("spacing = 0 leaves no surface; use more than 0.");
    const std::vector<Vector3d> vertices =
        settings.mesh ? placed_vertices(settings) : std::vector<Vector3d>{};
    if (found.empty() && settings.mesh && !has_area(vertices, settings.mesh->triangles))
        found.push_back("file = \"" + settings.file +
                        "\": no triangle in it has an area; give it three vertices that are apart and not in "
                        "line, or name another file.");
    const double least = thinnest * reach(vertices);
    if (settings.thickness <= least)
        found.push_back("thickness = " + number_text(settings.thickness) +
                        " is no more than what rounding may pass; use more than " + number_text(least) + ".");
    return found;
}

constexpr SolidKind of_one_scale{.problems = sheet_problems,
                                 .make = nullptr,
                                 .rotation = true,
                                 .file = true,
                                 .scale = true,
                                 .thickness = true};

} // namespace

std::unique_ptr<Sheet> make_sheet(const ColliderSettings& settings)
{
    SLOD_ASSERT(settings.mesh != nullptr);
    Mesh mesh = *settings.mesh;
    mesh.vertices = placed_vertices(settings);
    return std::make_unique<Sheet>(mesh, settings.thickness);
}

const SolidKind mesh_kind = of_one_scale, distance_grid_kind = of_one_scale;
const SolidKind heightfield_kind{.problems = sheet_problems,
                                 .make = nullptr,
                                 .rotation = true,
                                 .file = true,
                                 .scale = true,
                                 .spacing = true,
                                 .thickness = true};

} // namespace slod
