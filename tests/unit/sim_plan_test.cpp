#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/default_fields.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// What a scene comes down to: nothing runs and nothing is kept that the scene does not call for.
namespace slod::test {
namespace {

using Names = std::vector<std::string>;

const Names regrouped{"commands", "propagate", "update", "snapshot"};
const Names with_births_or_deaths{"commands", "propagate", "emit", "update", "snapshot"};
const Names attracted{"commands", "open_kick", "propagate",  "update",
                      "moments",  "forces",    "close_kick", "snapshot"};
const Names all_phases{"commands", "open_kick", "propagate",  "emit",    "update",
                       "moments",  "forces",    "close_kick", "snapshot"};
Names every_effect()
{
    Names names{"gravity", "uniform_gravity", "linear_drag", "uniform_wind", "quadratic_drag"};
    for_each_field_table(FieldSettings{},
                         [&]<class F>(const typename F::Table&) { names.emplace_back(F::name); });
    for (const char* name : {"speed_limit", "brownian", "collider", "emitter", "lifetime", "sink"})
        names.emplace_back(name);
    return names;
}

const Names all_effects = every_effect();

/// A scene by what it has besides four particles of one kind and mass in clusters of flow motion, and what
/// its plan has to be. Columns are those besides the ones that every scene has.
struct PlannedScene {
    const char* name;
    std::function<void(SmallScene&)> choose;
    Names phases = regrouped;
    Names effects = {};
    MapKind map = MapKind::Scalar;
    bool exact = true, clocked = false, merging = false;
    Names member_columns = {}, cluster_columns = {};

    friend std::ostream& operator<<(std::ostream& out, const PlannedScene& scene)
    {
        return out << scene.name;
    }
};

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
         .phases = with_births_or_deaths,
         .effects = {"emitter", "lifetime"},
         .member_columns = {"expiry frame"},
         .cluster_columns = {"next expiry"}},
        {.name = "emitter_of_immortals",
         .choose = emit_immortals,
         .phases = with_births_or_deaths,
         .effects = {"emitter"}},
        {.name = "mortals_at_the_start",
         .choose = [](SmallScene& scene) { scene.initial.front().expiry_frame = 3; },
         .phases = with_births_or_deaths,
         .effects = {"lifetime"},
         .member_columns = {"expiry frame"},
         .cluster_columns = {"next expiry"}},
        {.name = "sink", .choose = sink, .phases = with_births_or_deaths, .effects = {"sink"}},
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
         .effects = all_effects,
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
         .phases = {"commands", "propagate", "update", "moments", "snapshot"},
         .effects = {"linear_drag", "turbulence"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "variance", "winds", "strain"}},
        {.name = "quadratic_drag",
         .choose = resist,
         .phases = {"commands", "propagate", "update", "moments", "snapshot"},
         .effects = {"quadratic_drag"},
         .map = MapKind::Full,
         .exact = false,
         .clocked = true,
         .cluster_columns = {"flow map and closure", "variance", "winds", "strain"}},
        {.name = "kicks", .choose = shake, .effects = {"speed_limit", "brownian"}, .merging = true},
        {.name = "unclustered_spring",
         .choose = all<add_field<Spring>, uncluster>,
         .phases = {"commands", "open_kick", "propagate", "update", "forces", "close_kick", "snapshot"},
         .effects = {"spring"},
         .map = MapKind::Identity,
         .cluster_columns = {"acceleration and variance", "fields"}},
    };
}

class PlanOf : public testing::TestWithParam<PlannedScene> {
protected:
    PlanOf()
    {
        for (std::uint64_t id = 0; id < 4; ++id)
            scene_.initial.push_back({{double(id), 0, 0}, {0, 0, 0}, id, 1});
        GetParam().choose(scene_);
    }

    Plan plan() const { return compile_plan(scene_.settings, scene_.initial); }

    SmallScene scene_{GetParam().name, quiet_settings(), {}};
};

Names names_of(const std::vector<PlannedColumn>& columns, std::size_t first)
{
    Names names;
    for (std::size_t i = first; i < columns.size(); ++i)
        names.emplace_back(columns[i].name);
    return names;
}

/// Names in the section of a text that begins with a line `title`, whose entry is `entry`.
Names listed(const std::string& text, const std::string& title, const std::string& entry)
{
    std::istringstream lines(text.substr(text.find("\n" + title + "\n") + title.size() + 2));
    Names names;
    for (std::string line; std::getline(lines, line) && !line.empty();)
        if (line.ends_with(' ' + entry))
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
    return names;
}

TEST_P(PlanOf, HasThePhasesTheSceneCallsFor)
{
    Names phases;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (plan().runs[phase])
            phases.emplace_back(names(Phase{})[phase]);
    EXPECT_EQ(phases, GetParam().phases);
}

// A clock that advances by a millisecond at each look shows which phases are entered.
TEST_P(PlanOf, IsWhatRuns)
{
    std::int64_t now = 0;
    Simulation simulation(scene_.settings, scene_.initial,
                          {.isa = {}, .tick = [&] { return now += 1'000'000; }});
    const StepProfile profile = simulation.step({}).profile;
    Names entered;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (profile.milliseconds[phase] > 0)
            entered.emplace_back(names(Phase{})[phase]);
    EXPECT_EQ(entered, GetParam().phases);
}

TEST_P(PlanOf, KnowsAllEffectsAndReportsTheAbsentOnes)
{
    Names known, active;
    for (const PlannedEffect& effect : plan().effects) {
        known.emplace_back(effect.name);
        if (effect.active)
            active.emplace_back(effect.name);
    }
    EXPECT_EQ(known, all_effects);
    EXPECT_EQ(active, GetParam().effects);
}

TEST_P(PlanOf, HasTheMapAndTheUpdateOfItsMotion)
{
    EXPECT_EQ(plan().map, GetParam().map);
    EXPECT_EQ(plan().map_is_exact, GetParam().exact);
    EXPECT_EQ(plan().clocked, GetParam().clocked);
    EXPECT_EQ(plan().merging, GetParam().merging);
}

TEST_P(PlanOf, HasTheColumnsTheSceneCallsFor)
{
    constexpr std::size_t always_of_members = 2, always_of_clusters = 5;
    EXPECT_EQ(names_of(plan().member_columns, always_of_members), GetParam().member_columns);
    EXPECT_EQ(names_of(plan().cluster_columns, always_of_clusters), GetParam().cluster_columns);
}

TEST_P(PlanOf, IsExplainedInWords)
{
    const std::string text = explain(plan(), scene_.settings);
    EXPECT_EQ(listed(text, "phases", "runs"), GetParam().phases) << text;
    Names absent;
    for (const std::string& effect : all_effects)
        if (std::find(GetParam().effects.begin(), GetParam().effects.end(), effect) ==
            GetParam().effects.end())
            absent.push_back(effect);
    EXPECT_EQ(listed(text, "effects", "absent"), absent) << text;
    for (const std::string& column : GetParam().cluster_columns)
        EXPECT_NE(text.find("  " + column + " "), std::string::npos) << column << " in\n" << text;
    const std::string map = "flow map " + std::string(names(MapKind{})[std::size_t(GetParam().map)]);
    EXPECT_NE(text.find(map + (GetParam().exact ? ", exact" : "\n")), std::string::npos) << map << " in\n"
                                                                                         << text;
}

std::string name_of(const testing::TestParamInfo<PlannedScene>& info)
{
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Motion, PlanOf, testing::ValuesIn(scenes_of_motion()), name_of);
INSTANTIATE_TEST_SUITE_P(Fields, PlanOf, testing::ValuesIn(scenes_of_fields()), name_of);
INSTANTIATE_TEST_SUITE_P(Particles, PlanOf, testing::ValuesIn(scenes_of_particles()), name_of);

// 24 bytes of offsets and 8 of id are all that a particle of the plainest scene takes.
TEST(PlainestPlan, KeepsThirtyTwoBytesPerParticle)
{
    std::size_t bytes = 0;
    for (const PlannedColumn& column : compile_plan(quiet_settings(), {}).member_columns)
        bytes += column.bytes;
    EXPECT_EQ(bytes, 32U);
}

TEST(Plan, ExplainsWhatWasChosenForAnAccuracy)
{
    SmallScene scene = small_scene("flow");
    ASSERT_TRUE(scene.settings.gravity.has_value());
    scene.settings.gravity = GravitySettings{.accuracy = 7.3e-4}; // of the calibration at 1e-3
    const std::string text = explain(compile_plan(scene.settings, scene.initial), scene.settings);
    EXPECT_NE(text.find("gravity  relative opening, quadrupole, force_tolerance 0.00"), std::string::npos)
        << text;
    EXPECT_NE(text.find(", for accuracy 0.00073\n"), std::string::npos) << text;
    scene.settings.gravity.reset();
    EXPECT_EQ(explain(compile_plan(scene.settings, scene.initial), scene.settings).find("gravity  relative"),
              std::string::npos);
}

} // namespace
} // namespace slod::test
