#include "viewer/camera_file.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace slod::viewer {

std::optional<view::Camera> load_camera(const std::filesystem::path& path)
{
    if (!std::filesystem::exists(path))
        return {};
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot read " + path.string() +
                                 "; name a file that you may read with --camera-file");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const auto read = view::camera_of(text);
    if (const auto* wrong = std::get_if<std::string>(&read))
        throw std::runtime_error(path.string() + ": " + *wrong);
    return std::get<view::Camera>(read);
}

void save_camera(const view::Camera& camera, const std::filesystem::path& path)
{
    std::ofstream file(path);
    file << view::to_text(camera) << '\n';
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + path.string() +
                                 "; name a file that you may write to with --camera-file");
}

} // namespace slod::viewer
