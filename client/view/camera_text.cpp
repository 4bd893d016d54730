#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "view/camera.hpp"

namespace slod::view {

namespace {

/// Numbers parted by commas; none where one cannot be read or is not finite.
std::vector<double> numbers_of(std::string_view text)
{
    std::vector<double> numbers;
    const char* place = text.data();
    const char* const end = place + text.size();
    while (true) {
        double number = 0;
        const auto [next, error] = std::from_chars(place, end, number);
        if (error != std::errc() || !std::isfinite(number))
            return {};
        numbers.push_back(number);
        if (next == end)
            return numbers;
        if (*next != ',')
            return {};
        place = next + 1;
    }
}

/// What keeps one assignment from being made; nothing when it was made.
std::optional<std::string> assign(Camera& camera, std::string_view key, std::string_view text)
{
    const std::string subject = std::string(key);
    const std::vector<double> numbers = numbers_of(text);
    if (key == "look_at") {
        if (numbers.size() != 3)
            return subject + " needs three numbers, as in look_at=0,0,0";
        camera.look_at = {numbers[0], numbers[1], numbers[2]};
        return {};
    }
    struct Key {
        std::string_view name;
        double Camera::*field;
        double least, most;
    };
    for (const Key& known :
         {Key{"distance", &Camera::distance, 1e-300, 1e300}, Key{"azimuth", &Camera::azimuth_deg, -360, 360},
          Key{"elevation", &Camera::elevation_deg, -90, 90},
          Key{"field_of_view", &Camera::field_of_view_deg, 1, 150}}) {
        if (known.name != key)
            continue;
        if (numbers.size() != 1 || numbers[0] < known.least || numbers[0] > known.most) {
            std::array<char, 96> range;
            std::snprintf(range.data(), range.size(), " needs a number from %g to %g", known.least,
                          known.most);
            return subject + range.data();
        }
        camera.*known.field = numbers[0];
        return {};
    }
    return subject + " is none of its keys: look_at, distance, azimuth, elevation, field_of_view";
}

} // namespace

std::string to_text(const Camera& camera)
{
    std::array<char, 512> text;
    std::snprintf(
        text.data(), text.size(),
        "look_at=%.17g,%.17g,%.17g distance=%.17g azimuth=%.17g elevation=%.17g field_of_view=%.17g",
        camera.look_at.x(), camera.look_at.y(), camera.look_at.z(), camera.distance, camera.azimuth_deg,
        camera.elevation_deg, camera.field_of_view_deg);
    return text.data();
}

std::variant<Camera, std::string> camera_of(std::string_view text)
{
    constexpr std::string_view blank = " \t\r\n";
    Camera camera;
    std::size_t start = text.find_first_not_of(blank);
    if (start == std::string_view::npos)
        return "no camera is described; write for example \"" + to_text(Camera{}) + '"';
    while (start != std::string_view::npos) {
        const std::string_view word = text.substr(start, text.find_first_of(blank, start) - start);
        const std::size_t equals = word.find('=');
        if (equals == std::string_view::npos)
            return "\"" + std::string(word) + "\" is no key=value";
        if (auto wrong = assign(camera, word.substr(0, equals), word.substr(equals + 1)))
            return *wrong;
        start = text.find_first_not_of(blank, start + word.size());
    }
    return camera;
}

} // namespace slod::view
