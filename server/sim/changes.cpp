#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sim/state.hpp"

namespace slod {
namespace {

std::string quoted(std::string_view name)
{
    return '"' + std::string(name) + '"';
}

/// What the plan has no columns for, as the scene did not call for it at the start.
void check_plan(const Plan& plan, const RegionSettings& partition, Problems& found)
{
    if (plan.unclustered && partition.max_cluster_size >= 2)
        found.push_back("max_cluster_size is above 1 in a scene that was planned without clusters; set it to "
                        "1, or start the scene with background.max_cluster_size above 1.");
    if (!plan.withholding && partition.cluster_velocity == ClusterVelocity::First)
        found.push_back(
            "cluster_velocity = \"first\" needs a scene that has a region with it from the start; "
            "add one to the scene file.");
}

/// Whether two scenes differ in nothing but values that a running plan has room for.
bool same_plan(const SimulationSettings& a, const SimulationSettings& b)
{
    return a.gravity.has_value() == b.gravity.has_value() &&
           a.uniform_gravity.has_value() == b.uniform_gravity.has_value() &&
           a.uniform_wind.has_value() == b.uniform_wind.has_value() && a.linear_drag == b.linear_drag &&
           a.quadratic_drag == b.quadratic_drag && a.speed_limit == b.speed_limit &&
           a.brownian == b.brownian && a.colliders == b.colliders && a.sinks == b.sinks &&
           a.emitters.size() == b.emitters.size() &&
           (a.fields == b.fields || compile_plan(a, {}) == compile_plan(b, {}));
}

/// Whether one of the colliders has this one's surface, which has been read from its file.
bool has_surface_of(const std::vector<ColliderSettings>& colliders, const ColliderSettings& other)
{
    return std::any_of(colliders.begin(), colliders.end(), [&](const ColliderSettings& each) {
        return each.file == other.file && each.mesh == other.mesh && each.shape == other.shape;
    });
}

} // namespace

std::optional<RegionRow> Simulation::State::find_region(std::string_view name) const
{
    const auto found = std::find_if(tree.regions.begin(), tree.regions.end(), [&](const auto& region) {
        return region.open && region.settings.name == name;
    });
    if (found == tree.regions.end())
        return {};
    return RegionRow(found - tree.regions.begin());
}

/// Regions that do not come or go have been compared already.
void Simulation::State::check_sharing(const RegionOfInterest& region, Problems& found) const
{
    if (settings.sharing.overlap || region.name == background_name)
        return;
    std::vector<RegionOfInterest> others;
    for (std::size_t row = background_row + 1; row < tree.regions.size(); ++row)
        if (tree.regions[row].open)
            others.push_back(tree.regions[row].settings);
    const Problems beside = problems_beside(region, others, settings.sharing);
    found.insert(found.end(), beside.begin(), beside.end());
}

std::vector<Simulation::Region> Simulation::regions() const
{
    const SlodTree& tree = state_->tree;
    std::vector<Region> all;
    for (std::size_t row = 0; row < tree.regions.size(); ++row)
        if (tree.regions[row].open)
            all.push_back({RegionRow(row), tree.regions[row].settings});
    const auto order = [&](const Region& a, const Region& b) {
        const bool a_last = a.row == background_row, b_last = b.row == background_row;
        if (a_last || b_last)
            return !a_last && b_last;
        if (a.settings.precedence != b.settings.precedence)
            return a.settings.precedence > b.settings.precedence;
        return tree.regions[a.row].number < tree.regions[b.row].number;
    };
    std::sort(all.begin(), all.end(), order);
    return all;
}

Problems Simulation::add_region(const RegionOfInterest& region)
{
    State& s = *state_;
    Problems found = slod::problems(region);
    if (!is_name(region.name))
        found.push_back("name = " + quoted(region.name) + " is no name; use 1 to 32 of a-z, 0-9, _ and -.");
    else if (s.find_region(region.name))
        found.push_back("name = " + quoted(region.name) +
                        " is taken; choose another, or change that region.");
    if (std::size_t(std::count_if(s.tree.regions.begin(), s.tree.regions.end(),
                                  [](const auto& each) { return each.open; })) > max_regions)
        found.push_back("name = " + quoted(region.name) + " would be one region more than " +
                        std::to_string(max_regions) + "; remove another first.");
    check_plan(s.plan, region.partition, found);
    s.check_sharing(region, found);
    if (!found.empty())
        return found;
    open_region(s.tree, region);
    s.plan.runs[std::size_t(Phase::Update)] = true;
    return {};
}

Problems Simulation::change_region(const RegionOfInterest& region)
{
    State& s = *state_;
    const auto row = s.find_region(region.name);
    if (!row)
        return {"name = " + quoted(region.name) + " is no region; list them to see their names."};
    Problems found = slod::problems(region);
    if (*row == background_row && region.shape != Shape::Everywhere)
        found.push_back("shape cannot change: the background is everywhere; add a region instead.");
    check_plan(s.plan, region.partition, found);
    s.check_sharing(region, found);
    if (!found.empty())
        return found;
    const bool same_sources = s.tree.subtrees[*row].settings.attracts == region.partition.attracts;
    s.forces_stale = s.forces_stale || (s.settings.gravity && !same_sources);
    slod::change_region(s.tree, *row, region, s.store.clusters);
    return {};
}

Problems Simulation::remove_region(std::string_view name)
{
    const auto row = state_->find_region(name);
    if (!row)
        return {"name = " + quoted(name) + " is no region; list them to see their names."};
    if (*row == background_row)
        return {"name = " + quoted(name) + " cannot go: it holds whatever no other region does."};
    close_region(state_->tree, *row);
    return {};
}

Problems Simulation::change_settings(const SimulationSettings& wanted)
{
    const SimulationSettings& present = state_->asked;
    Problems found = slod::problems(wanted);
    const auto fixed = [&](std::string_view key, bool same) {
        if (!same)
            found.push_back(std::string(key) +
                            " cannot change while the scene runs; start the server with it.");
    };
    fixed("seed", wanted.seed == present.seed);
    fixed("units", wanted.units == present.units);
    fixed("time", wanted.time == present.time);
    fixed("kind", wanted.kinds == present.kinds);
    fixed("motion", wanted.motion == present.motion);
    fixed("emitter", wanted.emitters == present.emitters);
    fixed("limits", wanted.limits == present.limits);
    fixed("background", wanted.background == present.background);
    fixed("sharing", wanted.sharing == present.sharing);
    fixed("region", wanted.regions == present.regions);
    for (std::size_t i = 0; i < wanted.colliders.size(); ++i) {
        const ColliderSettings& one = wanted.colliders[i];
        const bool of_file = !one.file.empty() || one.mesh;
        fixed("collider." + std::to_string(i) + (one.file.empty() ? ".shape" : ".file"),
              !of_file || has_surface_of(present.colliders, one));
    }
    if (!found.empty())
        return found;
    if (same_plan(called_for(wanted), state_->settings))
        state_->take(wanted);
    else
        state_ = state_->with(wanted, particles());
    return {};
}

/// Under the same plan.
void Simulation::State::take(const SimulationSettings& wanted)
{
    asked = wanted;
    const SimulationSettings before = std::exchange(settings, called_for(wanted));
    describe_effects(plan, wanted);
    forces_stale = forces_stale || settings.gravity != before.gravity || settings.fields != before.fields;
    if (before.gravity)
        scale_pulls(before.gravity->strength > 0 ? settings.gravity->strength / before.gravity->strength : 0);
    set_fields();
    if (settings.fields != before.fields)
        place_fields();
    set_detail();
    meter.forget();
}

void Simulation::State::place_fields()
{
    const FieldSource source = field_source();
    if (field_forces)
        field_forces.emplace(settings.fields, source, settings.gravity.has_value(), tick);
    if (air)
        air.emplace(fields, settings.quadratic_drag, settings.fields, source, settings.time.step, tick);
}

Problems Simulation::set_detail(const Detail& detail)
{
    State& s = *state_;
    if (s.plan.unclustered)
        return {"cluster_size cannot change: the scene was planned without clusters; start it with "
                "background.max_cluster_size above 1."};
    slod::set_detail(s.tree, detail, s.store.clusters);
    s.set_detail();
    return {};
}

/// What gravity and the clocks take of the tree's detail.
void Simulation::State::set_detail()
{
    range = scene_range(settings);
    reforming.set_clock(settings.motion.clock * tree.detail.life);
    if (!settings.gravity)
        return;
    gravity = with_accuracy(*settings.gravity);
    gravity.force_tolerance *= tree.detail.opening;
    gravity.opening_angle = std::min(gravity.opening_angle * std::sqrt(tree.detail.opening), widest_opening);
}

/// Keeps the last pulls, which errors are compared with, in line with the strength of gravity; 0: not known.
void Simulation::State::scale_pulls(double factor)
{
    for (auto& pull : store.clusters.pull)
        pull *= factor;
}

void Simulation::State::set_fields()
{
    gravitational_constant =
        settings.units.gravitational_constant() * (settings.gravity ? settings.gravity->strength : 1.0);
    fields = UniformFields(settings.uniform_gravity, settings.linear_drag, settings.uniform_wind);
    if (air)
        air->set_uniform(fields);
    propagator = fields.over(settings.time.step);
    emission.set_fields(fields);
    if (collisions)
        collisions->set_fields(fields);
}

} // namespace slod
