#include "scene/assignments.hpp"

#include <charconv>
#include <optional>
#include <string_view>

#include "scene/field_reader.hpp"
#include "scene/scene_document.hpp"
#include "scene/sections.hpp"

namespace slod {

namespace {

/// Nobody reads on after so many, and whoever sends nonsense shall not make the list long.
constexpr std::size_t most_problems = 8;

/// Assigns one after the other to a copy; `assign_one` adds what is wrong to the problems.
template <class Settings, class AssignOne>
Problems assign_all(Settings& settings, std::span<const Assignment> assignments, const AssignOne& assign_one)
{
    Settings changed = settings;
    Problems found;
    for (const Assignment& assignment : assignments) {
        assign_one(changed, assignment, found);
        if (found.size() >= most_problems)
            break;
    }
    if (found.empty())
        settings = changed;
    return found;
}

/// A value that was read, or what is wrong with it, to follow the key.
template <class Target>
Complaint take(Target& target, const Field& field, const Assignment& assignment)
{
    try {
        const toml::table parsed = parse_assignment(std::string(field.key), assignment.value, {});
        const toml::node& node = *parsed.get(field.key);
        const Complaint complaint = assign(target, field, node);
        return complaint.empty() ? complaint : "= " + node_text(node) + " " + complaint;
    } catch (const toml::parse_error& failure) {
        return "is not TOML: " + std::string(failure.description()) + ".";
    }
}

/// Assigns to the field named `key`, which is all or the end of the assignment's.
template <class Settings>
void assign_field(Settings& settings, std::string_view key, const Assignment& assignment, Problems& found)
{
    std::vector<std::string> keys;
    std::optional<Complaint> complaint;
    for_each_field(settings, [&](const Field& field, auto& target) {
        keys.emplace_back(field.key);
        if (field.key == key)
            complaint = take(target, field, assignment);
    });
    if (!complaint)
        complaint = "is no key here; " + suggestion(key, keys);
    if (!complaint->empty())
        found.push_back(assignment.key + " " + *complaint);
}

/// Assigns to a table that may have the field.
struct AssignInTable {
    std::string_view key;
    const Assignment& assignment;
    Problems& found;

    template <class Settings>
    void operator()(Settings& table) const
    {
        assign_field(table, key, assignment, found);
    }

    template <class Settings>
    void operator()(std::optional<Settings>& table) const
    {
        if (!table)
            table.emplace();
        assign_field(*table, key, assignment, found);
    }

    /// The key begins with the table's number, from 0; one behind the last is a new one.
    template <class Settings>
    void operator()(std::vector<Settings>& tables) const
    {
        std::size_t number = 0;
        const char* const end = key.data() + key.size();
        const auto [rest, error] = std::from_chars(key.data(), end, number);
        const std::string table(assignment.key, 0, assignment.key.size() - key.size() - 1);
        if (error != std::errc{} || rest == end || *rest != '.') {
            const std::string last =
                error == std::errc{} ? "KEY" : std::string(key.substr(key.rfind('.') + 1));
            found.push_back(assignment.key + ": [[" + table + "]] is an array of tables; write " + table +
                            ".0." + last + " for the first.");
        } else if (number > tables.size()) {
            found.push_back(assignment.key + ": the scene has " + std::to_string(tables.size()) + " of [[" +
                            table + "]], counted from 0; number " + std::to_string(tables.size()) +
                            " adds one.");
        } else {
            if (number == tables.size())
                tables.emplace_back();
            assign_field(tables[number], std::string_view(rest + 1, end), assignment, found);
        }
    }
};

/// Assigns to one of the tables, by "table.key".
template <class Settings>
void assign_in_tables(Settings& settings, const Assignment& assignment, Problems& found)
{
    const std::size_t dot = assignment.key.find('.');
    if (dot == std::string::npos) {
        found.push_back(assignment.key + " is no setting of a table; write table.key.");
        return;
    }
    const std::string_view table = std::string_view(assignment.key).substr(0, dot);
    const std::string_view key = std::string_view(assignment.key).substr(dot + 1);
    std::vector<std::string> tables;
    bool known = false;
    for_each_section(settings, [&](const Section& section, auto& content) {
        tables.emplace_back(section.name);
        if (section.name != table)
            return;
        known = true;
        AssignInTable{key, assignment, found}(content);
    });
    if (!known)
        found.push_back(assignment.key + " is in no table of the simulation; " + suggestion(table, tables));
}

template <class Settings>
Problems assign_all_in_tables(Settings& settings, std::span<const Assignment> assignments)
{
    return assign_all(settings, assignments, assign_in_tables<Settings>);
}

template <class Settings>
Problems assign_all_fields(Settings& settings, std::span<const Assignment> assignments)
{
    return assign_all(settings, assignments,
                      [](Settings& changed, const Assignment& assignment, Problems& found) {
                          assign_field(changed, assignment.key, assignment, found);
                      });
}

template <class Settings>
std::vector<Assignment> all_fields(Settings settings) // for_each_field takes what it may change
{
    std::vector<Assignment> fields;
    for_each_field(settings, [&](const Field& field, const auto& value) {
        fields.push_back({std::string(field.key), value_text(value)});
    });
    return fields;
}

} // namespace

Problems assign_fields(RegionOfInterest& region, std::span<const Assignment> assignments)
{
    return assign_all_fields(region, assignments);
}

Problems assign_fields(SimulationSettings& settings, std::span<const Assignment> assignments)
{
    return assign_all_in_tables(settings, assignments);
}

Problems assign_fields(LoopSettings& settings, std::span<const Assignment> assignments)
{
    return assign_all_in_tables(settings, assignments);
}

Problems assign_fields(Detail& detail, std::span<const Assignment> assignments)
{
    return assign_all_fields(detail, assignments);
}

std::vector<Assignment> fields_of(const RegionOfInterest& region)
{
    return all_fields(region);
}

std::vector<Assignment> fields_of(const Detail& detail)
{
    return all_fields(detail);
}

} // namespace slod
