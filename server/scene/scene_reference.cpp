#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/sections.hpp"
#include "scene/value_text.hpp"

namespace slod {

namespace {

/// One line: key, unit, default, choice, help.
using Row = std::array<std::string, 5>;
using Widths = std::array<std::size_t, 5>;

struct Chapter {
    std::string title;
    std::vector<Row> rows;
};

/// The chapter of one table, from the defaults of its settings.
template <class Settings>
Chapter chapter_of(const std::string& title, Settings defaults)
{
    Chapter chapter{title, {}};
    for_each_field(defaults, [&]<class T>(const Field& field, const T& value) {
        chapter.rows.push_back({std::string(field.key), std::string(field.unit), value_text(value),
                                choice_text<T>(field), std::string(field.help)});
    });
    return chapter;
}

template <class Settings>
Chapter chapter(const Section& section, const Settings& settings)
{
    const std::string heading = section.name.empty() ? "" : "[" + std::string(section.name) + "]  ";
    return chapter_of(heading + std::string(section.help), settings);
}

template <class Settings>
Chapter chapter(const Section& section, const std::optional<Settings>&)
{
    const std::string heading = "[" + std::string(section.name) + "]  " + std::string(section.help);
    return chapter_of(heading + " Active when the table is there.", Settings{});
}

template <class Settings>
Chapter chapter(const Section& section, const std::vector<Settings>&)
{
    const std::string heading = "[[" + std::string(section.name) + "]]  " + std::string(section.help);
    return chapter_of(heading + " One table each.", Settings{});
}

void widen(Widths& widths, const Row& row)
{
    for (std::size_t column = 0; column < row.size(); ++column)
        widths[column] = std::max(widths[column], row[column].size());
}

std::string line(const Row& row, const Widths& widths)
{
    std::string text = "  ";
    for (std::size_t column = 0; column < row.size(); ++column)
        text += row[column] + std::string(widths[column] - row[column].size() + 2, ' ');
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

} // namespace

std::string scene_reference()
{
    Scene scene;
    std::vector<Chapter> chapters;
    for_each_section(scene, [&](const Section& section, const auto& settings) {
        chapters.push_back(chapter(section, settings));
    });

    const Row heading{"key", "unit", "default", "values", "meaning"};
    Widths widths{};
    widen(widths, heading);
    for (const Chapter& each : chapters)
        for (const Row& row : each.rows)
            widen(widths, row);

    std::string text = line(heading, widths);
    for (const Chapter& each : chapters) {
        text += "\n" + each.title + "\n";
        for (const Row& row : each.rows)
            text += line(row, widths);
    }
    return text;
}

} // namespace slod
