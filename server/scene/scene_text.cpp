#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/sections.hpp"
#include "scene/value_text.hpp"

namespace slod {

namespace {

template <class Settings>
void append_fields(std::string& text, Settings& settings)
{
    for_each_field(settings, [&](const Field& field, const auto& value) {
        text += std::string(field.key) + " = " + value_text(value) + "\n";
    });
}

template <class Settings>
void append_section(std::string& text, const Section& section, Settings& settings)
{
    if (!section.name.empty())
        text += "\n[" + std::string(section.name) + "]\n";
    append_fields(text, settings);
}

template <class Settings>
void append_section(std::string& text, const Section& section, std::optional<Settings>& settings)
{
    if (settings)
        append_section(text, section, *settings);
}

template <class Settings>
void append_section(std::string& text, const Section& section, std::vector<Settings>& settings)
{
    for (Settings& element : settings) {
        text += "\n[[" + std::string(section.name) + "]]\n";
        append_fields(text, element);
    }
}

} // namespace

std::string to_toml(const Scene& scene)
{
    Scene copy = scene; // for_each_field takes what it may change
    std::string text;
    for_each_section(
        copy, [&](const Section& section, auto& settings) { append_section(text, section, settings); });
    return text;
}

} // namespace slod
