#include "scene/surfaces.hpp"

#include <string>
#include <utility>
#include <variant>

#include "scene/surface_file.hpp"
#include "scene/value_text.hpp"

namespace slod {
namespace {

using Read = std::variant<Mesh, Problems> (*)(const std::filesystem::path& file);

/// Null where the shape has no file.
Read reader_of(ColliderShape shape)
{
    switch (shape) {
    case ColliderShape::Mesh:
        return read_obj;
    case ColliderShape::Heightfield:
        return read_heights;
    case ColliderShape::DistanceGrid:
        return read_distance_grid;
    default:
        return nullptr;
    }
}

} // namespace

Problems load_surfaces(std::vector<ColliderSettings>& colliders, const std::filesystem::path& folder)
{
    Problems found;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        ColliderSettings& collider = colliders[i];
        const Read read_surface = reader_of(collider.shape);
        if (read_surface == nullptr || collider.file.empty())
            continue;
        auto read = read_surface(folder / collider.file);
        if (auto* const surface = std::get_if<Mesh>(&read))
            collider.mesh = std::make_shared<const Mesh>(std::move(*surface));
        else
            for (const std::string& problem : std::get<Problems>(read))
                found.push_back("collider." + std::to_string(i) + ".file = " + string_text(collider.file) +
                                ": " + problem);
    }
    return found;
}

} // namespace slod
