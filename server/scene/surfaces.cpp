#include "scene/surfaces.hpp"

#include <string>
#include <utility>
#include <variant>

#include "scene/surface_file.hpp"
#include "scene/value_text.hpp"

namespace slod {

Problems load_surfaces(std::vector<ColliderSettings>& colliders, const std::filesystem::path& folder)
{
    Problems found;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        ColliderSettings& collider = colliders[i];
        const bool mesh = collider.shape == ColliderShape::Mesh;
        if ((!mesh && collider.shape != ColliderShape::Heightfield) || collider.file.empty())
            continue;
        const std::filesystem::path file = folder / collider.file;
        auto read = mesh ? read_obj(file) : read_heights(file);
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
