#include "cost/scene_choice.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <variant>

#include "cost/answer.hpp"

namespace slod::cost {
namespace {

constexpr double highest_frame_rate_hz = 10'000; ///< of ServerSettings

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Follows the lines of a scene's text, and says where each is.
class Lines {
public:
    struct Place {
        std::string table; ///< "[motion]", "[[region]] 1" counted from 0, empty before the first
        std::string key;   ///< empty in a line without one

        friend auto operator<=>(const Place&, const Place&) = default;
    };

    Place place_of(const std::string& line)
    {
        const std::string text = trimmed(line);
        if (text.starts_with("[")) {
            table_ = trimmed(text.substr(0, text.find('#')));
            if (table_.starts_with("[["))
                table_ += " " + std::to_string(counts_[table_]++);
            return {table_, ""};
        }
        const auto equals = text.find('=');
        if (text.starts_with("#") || equals == std::string::npos)
            return {table_, ""};
        return {table_, trimmed(text.substr(0, equals))};
    }

private:
    std::string table_;
    std::map<std::string, int> counts_; ///< of [[tables]] by name
};

/// Calls visit(line, place) for all lines.
template <class Visitor>
void for_each_line(const std::string& text, const Visitor& visit)
{
    std::istringstream stream(text);
    Lines lines;
    for (std::string line; std::getline(stream, line);)
        visit(line, lines.place_of(line));
}

using Values = std::map<Lines::Place, std::string>;

Values values_of(const Scene& scene)
{
    Values values;
    for_each_line(to_toml(scene), [&](const std::string& line, const Lines::Place& place) {
        if (!place.key.empty())
            values[place] = trimmed(line.substr(line.find('=') + 1));
    });
    return values;
}

/// Those of `wanted` that `present` has not, or has otherwise.
Values changes(const Values& present, const Values& wanted)
{
    Values changed;
    for (const auto& [place, value] : wanted)
        if (const auto known = present.find(place); known == present.end() || known->second != value)
            changed[place] = value;
    return changed;
}

/// The line with another value, and the comment where it was unless the value is longer.
std::string with_value(const std::string& line, const std::string& value)
{
    const auto begin = line.find('=') + 1;
    const auto hash = line.find('#', begin);
    std::string changed = line.substr(0, begin) + " " + value;
    if (hash == std::string::npos)
        return changed;
    changed.resize(std::max(changed.size() + 1, hash), ' ');
    return changed + line.substr(hash);
}

std::string assignment(const Values::value_type& change)
{
    return change.first.key + " = " + change.second + "\n";
}

/// The text with these values. A key that is not there follows its table's head, and a table the end.
std::string with_values(const std::string& text, Values changed)
{
    Values absent = changed;
    for_each_line(text, [&](const std::string&, const Lines::Place& place) { absent.erase(place); });
    std::string edited;
    for_each_line(text, [&](const std::string& line, const Lines::Place& place) {
        const auto change = changed.find(place);
        edited += (change == changed.end() ? line : with_value(line, change->second)) + "\n";
        if (!trimmed(line).starts_with("["))
            return;
        std::erase_if(absent, [&](const auto& addition) {
            const bool here = addition.first.table == place.table;
            edited += here ? assignment(addition) : "";
            return here;
        });
    });
    std::string table;
    for (const auto& addition : absent) {
        if (addition.first.table != table)
            edited += "\n" + addition.first.table + "\n";
        table = addition.first.table;
        edited += assignment(addition);
    }
    return edited;
}

} // namespace

std::optional<Row> choose(const std::vector<Row>& rows, const Wish& wish)
{
    return wish.frame_rate_hz ? best_within(rows, 1000 / *wish.frame_rate_hz)
                              : fastest_within(rows, *wish.error);
}

Scene with_choice(const Scene& scene, const Setting& setting, const Wish& wish)
{
    Scene chosen = scene;
    chosen.simulation = with_setting(scene.simulation, setting);
    double& rate = chosen.loop.server.frame_rate;
    rate = std::min(wish.frame_rate_hz.value_or(rate) * setting.steps, highest_frame_rate_hz);
    chosen.loop.control.mode = ControlMode::Off;
    return chosen;
}

std::string edited(const SceneText& text, const Scene& wanted)
{
    const std::string anew = to_toml(wanted);
    const auto present = load_scene(text, {});
    if (!std::holds_alternative<Scene>(present))
        return anew;
    SceneText changed = text;
    changed.text = with_values(text.text, changes(values_of(std::get<Scene>(present)), values_of(wanted)));
    const auto read = load_scene(changed, {});
    const bool same = std::holds_alternative<Scene>(read) && to_toml(std::get<Scene>(read)) == anew;
    return same ? changed.text : anew;
}

} // namespace slod::cost
