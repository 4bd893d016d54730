#pragma once

#include <filesystem>
#include <vector>

#include "core/settings.hpp"
#include "effects/collider_settings.hpp"

namespace slod {

/// Reads the files of colliders that are sheets, whose names start from `folder` unless they are absolute.
/// What is wrong comes with the key, "collider.0.file", in front.
Problems load_surfaces(std::vector<ColliderSettings>& colliders, const std::filesystem::path& folder);

} // namespace slod
