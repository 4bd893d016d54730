#include "unit/sim_plan_scenes.hpp"

#include <cmath>

#include "support/default_fields.hpp"
#include "support/solids.hpp"

namespace slod::test {
namespace {

const Names with_births{"commands", "propagate", "emit", "update", "snapshot"};
const Names with_deaths{"commands", "propagate", "expire", "update", "snapshot"};
const Names with_both{"commands", "propagate", "expire", "emit", "update", "snapshot"};
const Names attracted{"commands", "open_kick",  "propagate", "update", "moments",
                      "forces",   "close_kick", "snapshot",  "meter"};
const Names all_phases{"commands", "open_kick", "propagate",  "expire",   "emit", "update",
                       "moments",  "forces",    "close_kick", "snapshot", "meter"};

void attract(SmallScene& scene)
{
    scene.settings.gravity.emplace();
}

void blow(SmallScene& scene)
{
    scene.settings.uniform_gravity.emplace();
    scene.settings.linear_drag.emplace();
    scene.settings.uniform_wind.emplace();
}

void emit(SmallScene& scene)
{
    scene.settings.emitters = {jet("jet")};
}

void emit_immortals(SmallScene& scene)
{
    emit(scene);
    scene.settings.emitters.front().lifetime = INFINITY;
}

void add_all_fields(SmallScene& scene)
{
    for_each_field_table(FieldSettings{},
                         [&]<class F>(const typename F::Table&) { add_default<F>(scene.settings.fields); });
}

template <class F>
void add_field(SmallScene& scene)
{
    add_default<F>(scene.settings.fields);
}

void resist(SmallScene& scene)
{
    scene.settings.quadratic_drag.emplace();
}

void shake(SmallScene& scene)
{
    scene.settings.brownian.emplace();
    scene.settings.speed_limit.emplace();
}

void gust(SmallScene& scene)
{
    scene.settings.linear_drag.emplace();
    scene.settings.fields.of<Wind>() = {{.half_extent = Vector3d::Constant(INFINITY), .gust_amplitude = 1}};
}

void swirl(SmallScene& scene)
{
    scene.settings.linear_drag.emplace();
    add_default<Turbulence>(scene.settings.fields);
}

void obstruct(SmallScene& scene)
{
    scene.settings.colliders = {plane({0, 0, -1}, {0, 0, 1})};
}

void sink(SmallScene& scene)
{
    scene.settings.sinks = {{.name = "floor"}};
}

void add_kind(SmallScene& scene)
{
    scene.settings.kinds.push_back({"dust", 0.1});
}

void take_masses(SmallScene& scene)
{
    for (Particle& particle : scene.initial)
        particle.mass = 0;
}

template <Motion motion>
void move(SmallScene& scene)
{
    scene.settings.motion.motion = motion;
}

void uncluster(SmallScene& scene)
{
    scene.settings.background.max_cluster_size = 1.9;
}

template <auto... choices>
void all(SmallScene& scene)
{
    (choices(scene), ...);
}

const Names forces_of_bodies{"acceleration and variance"};

/// By how particles and clusters move.

} // namespace

Names every_effect()
{
    Names names{"gravity", "uniform_gravity", "linear_drag", "uniform_wind", "quadratic_drag"};
    for_each_field_table(FieldSettings{},
                         [&]<class F>(const typename F::Table&) { names.emplace_back(F::name); });
    for (const char* name : {"speed_limit", "brownian", "collider", "emitter", "lifetime", "sink"})
        names.emplace_back(name);
    return names;
}

std::vector<PlannedScene> scenes_of_motion()
{
    return {
        {.name = "free_flight", .choose = all<>},
        {.name = "rigid_flight",
         .choose = move<Motion::Rigid>,
         .map = MapKind::Identity,
         .exact = false,
         .merging = true},
        {.name = "wind", .choose = blow, .effects = {"uniform_gravity", "linear_drag", "uniform_wind"}},
        {.name = "colliders", .choose = obstruct, .effects = {"collider"}, .merging = true},
        {.name = "self_gravity",
         .choose = attract,
         .phases = attracted,
         .effects = {"gravity"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "acceleration and variance", "tidal tensor"}},
        {.name = "stream_in_self_gravity",
         .choose = all<attract, move<Motion::Stream>>,
         .phases = attracted,
         .effects = {"gravity"},
         .exact = false,
         .clocked = true,
         .cluster_columns = {"acceleration and variance", "tidal tensor"}},
        {.name = "rigid_in_self_gravity",
         .choose = all<attract, move<Motion::Rigid>>,
         .phases = attracted,
         .effects = {"gravity"},
         .map = MapKind::Identity,
         .exact = false,
         .merging = true,
         .cluster_columns = forces_of_bodies},
        {.name = "unclustered",
         .choose = uncluster,
         .phases = {"commands", "propagate", "snapshot"},
         .map = MapKind::Identity},
        {.name = "unclustered_in_self_gravity",
         .choose = all<attract, uncluster>,
         .phases = attracted,
         .effects = {"gravity"},
         .map = MapKind::Identity,
         .cluster_columns = forces_of_bodies},
    };
}

/// By what particles there are.
std::vector<PlannedScene> scenes_of_particles()
{
    return {
        {.name = "emitter",
         .choose = emit,
         .phases = with_both,
         .effects = {"emitter", "lifetime"},
         .member_columns = {"expiry frame"},
         .cluster_columns = {"next expiry"}},
        {.name = "emitter_of_immortals",
         .choose = emit_immortals,
         .phases = with_births,
         .effects = {"emitter"}},
        {.name = "mortals_at_the_start",
         .choose = [](SmallScene& scene) { scene.initial.front().expiry_frame = 3; },
         .phases = with_deaths,
         .effects = {"lifetime"},
         .member_columns = {"expiry frame"},
         .cluster_columns = {"next expiry"}},
        {.name = "sink", .choose = sink, .phases = with_deaths, .effects = {"sink"}},
        {.name = "several_kinds", .choose = add_kind, .member_columns = {"kind"}},
        {.name = "several_masses",
         .choose = [](SmallScene& scene) { scene.initial.front().mass = 2; },
         .member_columns = {"mass"},
         .cluster_columns = {"moments by number"}},
        {.name = "massless", .choose = take_masses, .cluster_columns = {"moments by number"}},
        {.name = "everything",
         .choose =
             all<attract, blow, resist, add_all_fields, shake, obstruct, emit, sink, add_kind, take_masses>,
         .phases = all_phases,
         .effects = every_effect(),
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .merging = true,
         .member_columns = {"mass", "kind", "expiry frame"},
         .cluster_columns = {"flow map and closure", "moments by number", "next expiry",
                             "acceleration and variance", "tidal tensor", "curl of the acceleration",
                             "fields", "winds", "strain"}},
    };
}

/// By effects that depend on the place.
std::vector<PlannedScene> scenes_of_fields()
{
    return {
        {.name = "attractor",
         .choose = add_field<Attractor>,
         .phases = attracted,
         .effects = {"attractor"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "acceleration and variance", "tidal tensor", "fields"}},
        {.name = "vortex",
         .choose = add_field<Vortex>,
         .phases = attracted,
         .effects = {"vortex"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "acceleration and variance", "tidal tensor",
                             "curl of the acceleration", "fields"}},
        {.name = "gusts", .choose = gust, .effects = {"linear_drag", "wind"}},
        {.name = "turbulence",
         .choose = swirl,
         .phases = {"commands", "propagate", "update", "moments", "snapshot", "meter"},
         .effects = {"linear_drag", "turbulence"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "variance", "winds", "strain"}},
        {.name = "quadratic_drag",
         .choose = resist,
         .phases = {"commands", "propagate", "update", "moments", "snapshot", "meter"},
         .effects = {"quadratic_drag"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "variance", "winds", "strain"}},
        {.name = "kicks", .choose = shake, .effects = {"speed_limit", "brownian"}, .merging = true},
        {.name = "unclustered_spring",
         .choose = all<add_field<Spring>, uncluster>,
         .phases = {"commands", "open_kick", "propagate", "update", "forces", "close_kick", "snapshot",
                    "meter"},
         .effects = {"spring"},
         .map = MapKind::Identity,
         .cluster_columns = {"acceleration and variance", "fields"}},
    };
}

} // namespace slod::test
