#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cluster/motion.hpp"
#include "cluster/particles.hpp"
#include "core/settings.hpp"
#include "effects/collider_settings.hpp"
#include "effects/emitter_settings.hpp"
#include "effects/fields/list.hpp"
#include "effects/member_settings.hpp"
#include "effects/quadratic_drag.hpp"
#include "effects/settings.hpp"
#include "effects/sink_settings.hpp"
#include "effects/switches.hpp"
#include "gravity/settings.hpp"
#include "tree/region.hpp"
#include "tree/settings.hpp"

namespace slod {

/// The scene's units in SI. Everything inside the simulation is in scene units.
struct Units {
    double length_m = 1;
    double mass_kg = 1;
    double time_s = 1;

    /// Newton's constant (CODATA 2018) in these units.
    double gravitational_constant() const
    {
        return 6.67430e-11 * mass_kg * time_s * time_s / (length_m * length_m * length_m);
    }

    friend bool operator==(const Units&, const Units&) = default;
};

struct TimeSettings {
    double step = 1.0 / 60;         ///< one frame's simulated time
    std::uint32_t max_substeps = 1; ///< of a frame; 1: never more
    double substep_angle = 1;       ///< rad; no sub-step is longer than this over sqrt(|T|max)

    friend bool operator==(const TimeSettings&, const TimeSettings&) = default;
};

/// How regions of interest share space.
struct SharingSettings {
    bool overlap = true; ///< regions may overlap; else those that do are refused (O'Brien et al. 2001, 4.3)

    friend bool operator==(const SharingSettings&, const SharingSettings&) = default;
};

/// What a scene may grow to.
struct LimitSettings {
    /// Emitters pause while there are so many particles; what they would have emitted is counted and lost.
    std::uint64_t max_particles = 20'000'000;

    friend bool operator==(const LimitSettings&, const LimitSettings&) = default;
};

/// All that the simulation needs to know of a scene. What is absent (an effect, an emitter) is not
/// planned, run or allocated.
struct SimulationSettings {
    std::uint64_t seed = 1;
    Units units;
    TimeSettings time;
    std::vector<ParticleKind> kinds; ///< at least one
    MotionSettings motion;
    RegionSettings background; ///< of all that no region of interest holds
    SharingSettings sharing;
    std::vector<RegionOfInterest> regions;
    std::optional<GravitySettings> gravity;
    std::optional<UniformGravitySettings> uniform_gravity;
    std::optional<LinearDragSettings> linear_drag;
    std::optional<UniformWindSettings> uniform_wind;
    std::optional<QuadraticDragSettings> quadratic_drag;
    FieldSettings fields;
    std::optional<SpeedLimitSettings> speed_limit;
    std::optional<BrownianSettings> brownian;
    std::vector<ColliderSettings> colliders;
    std::vector<EmitterSettings> emitters;
    std::vector<SinkSettings> sinks;
    EffectSwitches effects;
    LimitSettings limits;
};

/// Calls visit(name, table) for each effect that can be switched and its table: a std::optional, or a
/// std::vector with an element for each.
template <class Settings, class Visitor>
void for_each_effect(Settings& settings, Visitor&& visit)
{
    visit("gravity", settings.gravity);
    visit("uniform_gravity", settings.uniform_gravity);
    visit("linear_drag", settings.linear_drag);
    visit("uniform_wind", settings.uniform_wind);
    visit("quadratic_drag", settings.quadratic_drag);
    for_each_field_table(settings.fields, [&]<class F>(auto& table) { visit(F::name, table); });
    visit("speed_limit", settings.speed_limit);
    visit("brownian", settings.brownian);
    visit("collider", settings.colliders);
    visit("emitter", settings.emitters);
    visit("sink", settings.sinks);
}

/// Whether the scene names an effect, by its table.
template <class Settings>
bool named(const std::optional<Settings>& table)
{
    return table.has_value();
}
template <class Settings>
bool named(const std::vector<Settings>& table)
{
    return !table.empty();
}

/// The settings without the effects that are switched off: what is simulated.
SimulationSettings called_for(SimulationSettings settings);

/// Regions of interest at one time, besides the background.
inline constexpr std::size_t max_regions = 4096;

/// What no single field's range can say is wrong with the settings together; empty when nothing is.
Problems problems(const SimulationSettings& settings);

/// What is wrong with a region beside those that are there (one of its own name does not count), where
/// regions may not overlap.
Problems problems_beside(const RegionOfInterest& region, std::span<const RegionOfInterest> others,
                         const SharingSettings& sharing);

/// Whether it is a name: 1 to 32 of a-z, 0-9, _ and -.
bool is_name(std::string_view name);

template <class Visitor>
void for_each_field(Units& units, Visitor&& visit)
{
    visit(Field{"length", "m", "Length of the scene's unit of length.", 1e-30, 1e30}, units.length_m);
    visit(Field{"mass", "kg", "Mass of the scene's unit of mass.", 1e-60, 1e60}, units.mass_kg);
    visit(Field{"time", "s", "Duration of the scene's unit of time.", 1e-30, 1e30}, units.time_s);
}

template <class Visitor>
void for_each_field(SharingSettings& sharing, Visitor&& visit)
{
    visit(Field{"overlap", "", "Regions of interest may overlap; if not, one that does is refused."},
          sharing.overlap);
}

template <class Visitor>
void for_each_field(LimitSettings& limits, Visitor&& visit)
{
    visit(Field{"max_particles", "particles", "Emitters pause while there are so many particles.", 0, 1e9},
          limits.max_particles);
}

template <class Visitor>
void for_each_field(TimeSettings& time, Visitor&& visit)
{
    visit(Field{"step", "time", "Simulated time of one frame.", 1e-12, 1e12}, time.step);
    visit(Field{"max_substeps", "",
                "Steps that a frame is cut into where forces change fast, at most. Frames that would need "
                "more are "
                "counted as under_resolved.",
                1, 1e6},
          time.max_substeps);
    visit(Field{"substep_angle", "rad",
                "How far the fastest oscillation about a particle gets in a sub-step, at most: its length "
                "times the "
                "square root of the largest tide. Leapfrog is unstable from 2 on.",
                1e-6, 2},
          time.substep_angle);
}

template <class Visitor>
void for_each_field(ParticleKind& kind, Visitor&& visit)
{
    visit(Field{"name", "", "Name of the kind: 1 to 32 of a-z, 0-9, _ and -."}, kind.name);
    visit(Field{"softening", "length",
                "Plummer softening length; a pair is softened by the mean of both squares.", 0, 1e30},
          kind.softening);
}

} // namespace slod
