#include "sim/settings.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <string_view>

#include "core/number_text.hpp"
#include "effects/solid.hpp"

namespace slod {

namespace {

/// A kind's row is kept in one byte.
constexpr std::size_t max_kinds = std::size_t{std::numeric_limits<std::uint8_t>::max()} + 1;

std::string in_quotes(const std::string& text)
{
    return '"' + text + '"';
}

void check_units(const Units& units, Problems& found)
{
    constexpr double largest = 1e30; // as of all that a scene may set
    const double constant = units.gravitational_constant();
    if (!(constant > 0 && constant <= largest))
        found.push_back("units.length = " + number_text(units.length_m) + ", units.mass = " +
                        number_text(units.mass_kg) + " and units.time = " + number_text(units.time_s) +
                        " make Newton's constant " + number_text(constant) +
                        "; use units in which it is more than 0 and at most " + number_text(largest) + ".");
}

/// Names are valid, and each is the first of its sort.
template <class Named>
void check_names(const std::string& table, const std::vector<Named>& all, Problems& found)
{
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string key = table + "." + std::to_string(i) + ".name";
        const std::string& name = all[i].name;
        if (!is_name(name)) {
            found.push_back(key + " = " + in_quotes(name) + " is no name; use 1 to 32 of a-z, 0-9, _ and -.");
            continue;
        }
        const auto same = std::find_if(all.begin(), all.begin() + std::ptrdiff_t(i),
                                       [&](const Named& earlier) { return earlier.name == name; });
        const auto first = same - all.begin();
        if (first < std::ptrdiff_t(i))
            found.push_back(key + " = " + in_quotes(name) + " is the name of " + table + "." +
                            std::to_string(first) + " too; give each its own.");
    }
}

void check_kinds(const std::vector<ParticleKind>& kinds, Problems& found)
{
    if (kinds.empty())
        found.push_back("kind is missing: add a [[kind]] with a name.");
    if (kinds.size() > max_kinds)
        found.push_back("kind appears " + std::to_string(kinds.size()) + " times; use at most " +
                        std::to_string(max_kinds) + ".");
    check_names("kind", kinds, found);
}

void check_emitter(const std::string& key, const EmitterSettings& emitter,
                   const std::vector<ParticleKind>& kinds, Problems& found)
{
    std::string known;
    bool kind_exists = false;
    for (const ParticleKind& kind : kinds) {
        kind_exists = kind_exists || kind.name == emitter.kind;
        known += (known.empty() ? "" : ", ") + kind.name;
    }
    if (!kind_exists)
        found.push_back(key + ".kind = " + in_quotes(emitter.kind) + " is no kind of the scene; " +
                        (known.empty() ? "add a [[kind]] of that name." : "its kinds are " + known + "."));
    if (emitter.direction.isZero(0))
        found.push_back(key +
                        ".direction = [0, 0, 0] is none; give the axis of the cone, such as [0, 0, 1].");
    if (emitter.stop <= emitter.start)
        found.push_back(key + ".stop = " + number_text(emitter.stop) + " is not after " + key + ".start = " +
                        number_text(emitter.start) + "; use more than that, or leave the emitter out.");
    for (const std::string& problem : problems(emitter))
        found.push_back(key + "." + problem);
}

void check_sinks(const std::vector<SinkSettings>& sinks, Problems& found)
{
    check_names("sink", sinks, found);
    if (sinks.size() > max_sinks)
        found.push_back("sink appears " + std::to_string(sinks.size()) + " times; use at most " +
                        std::to_string(max_sinks) + ".");
    for (std::size_t i = 0; i < sinks.size(); ++i)
        for (const std::string& problem : problems(sinks[i]))
            found.push_back("sink." + std::to_string(i) + "." + problem);
}

void check_colliders(const std::vector<ColliderSettings>& colliders, Problems& found)
{
    check_names("collider", colliders, found);
    if (colliders.size() > max_colliders)
        found.push_back("collider appears " + std::to_string(colliders.size()) + " times; use at most " +
                        std::to_string(max_colliders) + ".");
    for (std::size_t i = 0; i < colliders.size(); ++i)
        for (const std::string& problem : problems(colliders[i]))
            found.push_back("collider." + std::to_string(i) + "." + problem);
}

void check_fields(const FieldSettings& fields, double step, Problems& found)
{
    for_each_field_table(fields, [&]<class F>(const typename F::Table& table) {
        const auto all = elements(table);
        if (all.size() > max_fields)
            found.push_back(std::string(F::name) + " appears " + std::to_string(all.size()) +
                            " times; use at most " + std::to_string(max_fields) + ".");
        for (std::size_t i = 0; i < all.size(); ++i)
            for (const std::string& problem : F::problems(all[i], step))
                found.push_back(key_of<F>(i) + "." + problem);
        if constexpr (requires { F::problems_together(table, step); })
            for (const std::string& problem : F::problems_together(table, step))
                found.push_back(problem);
    });
}

void check_winds(const SimulationSettings& settings, Problems& found)
{
    const auto& linear = settings.linear_drag;
    const auto& quadratic = settings.quadratic_drag;
    const auto& runs = settings.effects;
    if ((linear && linear->rate > 0 && runs.runs("linear_drag")) ||
        (quadratic && quadratic->coefficient > 0 && runs.runs("quadratic_drag")))
        return;
    std::string reason = " and the scene has none; add [linear_drag] or [quadratic_drag]";
    if (linear && quadratic)
        reason = ", but linear_drag.rate = 0 and quadratic_drag.coefficient = 0; use more than 0 for one";
    else if (linear)
        reason = ", but linear_drag.rate = 0; use more than 0";
    else if (quadratic)
        reason = ", but quadratic_drag.coefficient = 0; use more than 0";
    if ((linear && !runs.runs("linear_drag")) || (quadratic && !runs.runs("quadratic_drag")))
        reason = ", which is switched off; set effects." + std::string(linear ? "linear" : "quadratic") +
                 "_drag = true, or switch the wind off too";
    const auto check = [&](std::string_view name, bool blows) {
        if (blows && runs.runs(name))
            found.push_back(std::string(name) + " acts through the air's drag alone" + reason +
                            ", or leave it out.");
    };
    check("uniform_wind", settings.uniform_wind.has_value());
    AirFields::for_each([&]<class F> { check(F::name, !elements(settings.fields.of<F>()).empty()); });
}

/// Sub-steps are those of kicks; flights to a collider, into a sink and through air that differs are of a
/// whole frame.
void check_substeps(const SimulationSettings& settings, Problems& found)
{
    if (settings.time.max_substeps == 1)
        return;
    const auto check = [&](std::string_view name, bool there) {
        if (there && settings.effects.runs(name))
            found.push_back(
                "time.max_substeps = " + std::to_string(settings.time.max_substeps) + " does not go with " +
                std::string(name) +
                ", which acts over whole frames; use 1 and a smaller time.step, or leave that out.");
    };
    check("collider", !settings.colliders.empty());
    check("sink", !settings.sinks.empty());
    check("quadratic_drag", settings.quadratic_drag.has_value());
    AirFields::for_each([&]<class F> { check(F::name, !elements(settings.fields.of<F>()).empty()); });
}

void check_lives(const MotionSettings& motion, Problems& found)
{
    const auto check = [&](const std::string& key, std::uint32_t frames) {
        if (!std::has_single_bit(frames))
            found.push_back("motion." + key + " = " + std::to_string(frames) + " is no power of two; use " +
                            std::to_string(std::bit_floor(std::max(frames, 1u))) + ".");
    };
    check("shortest_life", motion.shortest_life);
    check("longest_life", motion.longest_life);
    if (motion.shortest_life > motion.longest_life)
        found.push_back("motion.shortest_life = " + std::to_string(motion.shortest_life) +
                        " is longer than motion.longest_life = " + std::to_string(motion.longest_life) +
                        "; use at most that.");
}

void check_rigid_rules(const MotionSettings& motion, Problems& found)
{
    if (motion.motion == Motion::Rigid)
        return;
    const std::string remedy = " applies to rigid motion alone; set motion.kind = \"rigid\" or leave it out.";
    if (motion.merged_velocities != MergedVelocities::Keep)
        found.push_back("motion.merged_velocities = \"collapse\"" + remedy);
    if (motion.build_respects_limits)
        found.push_back("motion.build_respects_limits = true" + remedy);
}

void check_regions(const std::vector<RegionOfInterest>& regions, const SharingSettings& sharing,
                   Problems& found)
{
    check_names("region", regions, found);
    if (regions.size() > max_regions)
        found.push_back("region appears " + std::to_string(regions.size()) + " times; use at most " +
                        std::to_string(max_regions) + ".");
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const std::string key = "region." + std::to_string(i) + ".";
        if (regions[i].name == background_name)
            found.push_back(key + "name = " + in_quotes(regions[i].name) +
                            " is the region of all that no other one holds, [background]; choose another.");
        for (const std::string& problem : problems(regions[i]))
            found.push_back(key + problem);
        const auto earlier = std::span(regions).first(i);
        for (const std::string& problem : problems_beside(regions[i], earlier, sharing))
            found.push_back(key + problem);
    }
}

/// What is switched off is there.
void check_switches(const SimulationSettings& settings, Problems& found)
{
    for_each_effect(settings, [&](std::string_view name, const auto& table) {
        if (!settings.effects.runs(name) && !named(table))
            found.push_back("effects." + std::string(name) +
                            " = false switches off what the scene does not "
                            "have; remove it, or give the scene the effect.");
    });
}

} // namespace

SimulationSettings called_for(SimulationSettings settings)
{
    for_each_effect(settings, [&](std::string_view name, auto& table) {
        if (!settings.effects.runs(name))
            table = {};
    });
    return settings;
}

Problems problems_beside(const RegionOfInterest& region, std::span<const RegionOfInterest> others,
                         const SharingSettings& sharing)
{
    Problems found;
    for (const RegionOfInterest& other : others)
        if (!sharing.overlap && other.name != region.name && may_overlap(region, other))
            found.push_back("shape overlaps that of region " + in_quotes(other.name) +
                            ", which sharing.overlap = false forbids; move one of them, or allow it.");
    return found;
}

bool is_name(std::string_view name)
{
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyz0123456789_-";
    return !name.empty() && name.size() <= 32 && name.find_first_not_of(allowed) == std::string_view::npos;
}

Problems problems(const SimulationSettings& settings)
{
    Problems found;
    check_units(settings.units, found);
    check_kinds(settings.kinds, found);
    check_colliders(settings.colliders, found);
    check_fields(settings.fields, settings.time.step / settings.time.max_substeps, found);
    check_names("emitter", settings.emitters, found);
    for (std::size_t i = 0; i < settings.emitters.size(); ++i)
        check_emitter("emitter." + std::to_string(i), settings.emitters[i], settings.kinds, found);
    check_sinks(settings.sinks, found);
    if (settings.gravity)
        for (const std::string& problem : problems(*settings.gravity))
            found.push_back("gravity." + problem);
    check_regions(settings.regions, settings.sharing, found);
    check_lives(settings.motion, found);
    check_rigid_rules(settings.motion, found);
    check_winds(settings, found);
    check_substeps(settings, found);
    check_switches(settings, found);
    return found;
}

} // namespace slod
