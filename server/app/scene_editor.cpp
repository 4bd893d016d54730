#include "app/scene_editor.hpp"

#include <algorithm>
#include <utility>

#include "scene/nearest.hpp"
#include "scene/scene_check.hpp"
#include "scene/sections.hpp"
#include "scene/value_text.hpp"

namespace slod {

namespace {

constexpr std::string_view background_table = "background.";

bool of_background(const Assignment& assignment)
{
    return assignment.key.starts_with(background_table);
}

/// Whether scenes have a table of that name.
bool is_table(std::string_view name)
{
    bool found = false;
    Scene none;
    for_each_section(none, [&](const Section& section, const auto&) {
        found = found || (section.name == name && !name.empty());
    });
    return found;
}

/// Switches of effects that the scene does not have.
Problems idle_switches(const std::vector<Assignment>& settings, const SimulationSettings& scene)
{
    Problems found;
    for_each_effect(scene, [&](std::string_view name, const auto& table) {
        const std::string key = "effects." + std::string(name);
        for (const Assignment& assignment : settings)
            if (assignment.key == key && !named(table))
                found.push_back(key + " switches what the scene does not have; slodctl effect list prints "
                                      "what it has.");
    });
    return found;
}

} // namespace

bool are_of_background(const std::vector<Assignment>& settings)
{
    return std::all_of(settings.begin(), settings.end(), of_background);
}

Problems unchangeable(const std::vector<Assignment>& settings)
{
    // Of [server] its frame_rate alone, which its own reader says.
    std::vector<std::string> tables{"alarms", "background", "control", "effects", "meter", "server"};
    const std::string changeable = joined(tables) + ", or the table of an effect other than emitter.";
    SimulationSettings none;
    for_each_effect(none, [&](std::string_view name, const auto&) {
        if (name != "emitter")
            tables.emplace_back(name);
    });
    Problems found;
    for (const Assignment& assignment : settings) {
        const std::string_view table = std::string_view(assignment.key).substr(0, assignment.key.find('.'));
        if (std::find(tables.begin(), tables.end(), table) != tables.end())
            continue;
        if (assignment.key.find('.') == std::string::npos)
            found.push_back(
                assignment.key +
                " is of no table; write table.key, such as server.frame_rate. What can change is in " +
                changeable);
        else if (table == "region")
            found.push_back(assignment.key + " is set by the region's name: slodctl roi set NAME KEY=VALUE.");
        else if (is_table(table))
            found.push_back(assignment.key +
                            " cannot change while the scene runs; start the server with it. "
                            "What can is in " +
                            changeable);
        else if (const std::string* const meant = nearest(table, tables))
            found.push_back(assignment.key + " is of no table; did you mean " + *meant + "?");
        else
            found.push_back(assignment.key + " is of no table. What can change is in " + changeable);
    }
    return found;
}

SceneEditor::SceneEditor(Simulation& simulation) : simulation_(simulation)
{
    for (const Simulation::Region& region : simulation.regions()) {
        const RegionRecord record{.row = region.row, .settings = region.settings, .revision = ++revisions_};
        records_[region.settings.name] = record;
        tell(record);
    }
}

const RegionRecord* SceneEditor::find(std::string_view name) const
{
    const auto found = records_.find(name);
    return found != records_.end() ? &found->second : nullptr;
}

Problems SceneEditor::add(const RegionOfInterest& region, const wire::Uuid& owner, double lease_s,
                          std::uint64_t frame)
{
    if (Problems found = simulation_.add_region(region); !found.empty())
        return found;
    const std::vector<Simulation::Region> all = simulation_.regions();
    const auto added = std::find_if(all.begin(), all.end(), [&](const Simulation::Region& each) {
        return each.settings.name == region.name;
    });
    const RegionRecord record{.row = added->row,
                              .settings = region,
                              .revision = ++revisions_,
                              .owner = owner,
                              .lease_s = lease_s,
                              .frame = frame};
    records_[region.name] = record;
    tell(record);
    log_.push_back(
        {.frame = frame, .kind = InputKind::AddRegion, .region = region.name, .settings = fields_of(region)});
    return {};
}

Problems SceneEditor::change(const RegionOfInterest& region, std::uint64_t frame)
{
    RegionRecord& record = records_.at(region.name);
    if (record.settings == region)
        return {};
    if (Problems found = simulation_.change_region(region); !found.empty())
        return found;
    record.settings = region;
    record.revision = ++revisions_;
    record.frame = frame;
    tell(record);
    log_.push_back({.frame = frame,
                    .kind = InputKind::ChangeRegion,
                    .region = region.name,
                    .settings = fields_of(region)});
    return {};
}

Problems SceneEditor::remove(const std::string& name, std::uint64_t frame)
{
    if (Problems found = simulation_.remove_region(name); !found.empty())
        return found;
    RegionRecord record = std::move(records_.extract(name).mapped());
    record.revision = ++revisions_;
    record.frame = frame;
    record.removed = true;
    tell(record);
    log_.push_back({.frame = frame, .kind = InputKind::RemoveRegion, .region = name, .settings = {}});
    return {};
}

Problems SceneEditor::set(const std::vector<Assignment>& settings, std::uint64_t frame,
                          const AlarmSettings& limits)
{
    const auto others = std::find_if_not(settings.begin(), settings.end(), of_background);
    if (others == settings.end())
        return set_background(settings, frame);
    if (const auto own = std::find_if(settings.begin(), settings.end(), of_background); own != settings.end())
        return {own->key + " is set by itself; give " + others->key + " in a command of its own."};

    SimulationSettings wanted = simulation_.settings();
    Problems found = assign_fields(wanted, settings);
    if (found.empty())
        found = idle_switches(settings, wanted);
    if (found.empty())
        found = problems(limits, called_for(wanted));
    if (!found.empty())
        return found;
    const Plan before = simulation_.plan();
    if (found = simulation_.change_settings(wanted); !found.empty())
        return found;
    ++effect_changes_;
    plan_changes_ += simulation_.plan() == before ? 0 : 1;
    log_.push_back({.frame = frame, .kind = InputKind::ChangeSettings, .region = {}, .settings = settings});
    return {};
}

Problems SceneEditor::set_background(const std::vector<Assignment>& settings, std::uint64_t frame)
{
    std::vector<Assignment> own = settings;
    for (Assignment& assignment : own)
        assignment.key.erase(0, background_table.size());
    RegionOfInterest wanted = records_.find(background_name)->second.settings;
    Problems found = assign_fields(wanted, own);
    if (found.empty() && wanted.name != background_name)
        found.push_back("name cannot change.");
    if (found.empty())
        found = change(wanted, frame);
    for (std::string& problem : found)
        problem.insert(0, background_table);
    return found;
}

bool SceneEditor::set_detail(const Detail& detail, std::uint64_t frame)
{
    if (detail == simulation_.detail() || !simulation_.set_detail(detail).empty())
        return false;
    log_.push_back(
        {.frame = frame, .kind = InputKind::SetDetail, .region = {}, .settings = fields_of(detail)});
    return true;
}

Problems SceneEditor::repeat(const LoggedCommand& command)
{
    const RegionRecord* const present = find(command.region);
    switch (command.kind) {
    case InputKind::AddRegion: {
        RegionOfInterest region;
        Problems found = assign_fields(region, command.settings);
        return found.empty() ? add(region, {}, 0, command.frame) : found;
    }
    case InputKind::ChangeRegion: {
        if (!present)
            break;
        RegionOfInterest region = present->settings;
        Problems found = assign_fields(region, command.settings);
        return found.empty() ? change(region, command.frame) : found;
    }
    case InputKind::RemoveRegion:
        if (!present)
            break;
        return remove(command.region, command.frame);
    case InputKind::ChangeSettings:
        return set(command.settings, command.frame);
    case InputKind::SetDetail: {
        Detail detail;
        Problems found = assign_fields(detail, command.settings);
        return found.empty() ? simulation_.set_detail(detail) : found;
    }
    }
    return {"region = \"" + command.region + "\" is not there."};
}

std::vector<RegionRecord> SceneEditor::take_news()
{
    std::vector<RegionRecord> news;
    for (auto& [name, record] : news_)
        news.push_back(std::move(record));
    news_.clear();
    return news;
}

} // namespace slod
