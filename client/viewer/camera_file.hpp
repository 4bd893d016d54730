#pragma once

#include <filesystem>
#include <optional>

#include "view/camera.hpp"

namespace slod::viewer {

/// The camera saved in a file; nothing when there is no such file. Throws std::runtime_error with file and
/// reason when there is no camera in it.
std::optional<view::Camera> load_camera(const std::filesystem::path& path);

/// Throws std::runtime_error with file and reason when it cannot be written.
void save_camera(const view::Camera& camera, const std::filesystem::path& path);

} // namespace slod::viewer
