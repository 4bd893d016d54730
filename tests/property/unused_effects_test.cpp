#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.hpp"
#include "sim/simulation.hpp"
#include "support/allocation_counter.hpp"
#include "support/default_fields.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// An effect that a scene does not call for costs nothing: the proofs E01 to E11. E05, which counts
// instructions, is tests/e2e/instructions.sh; E07, that times add up, is what bench-effects reports. Of E09
// there is nothing to fuse: every scene runs the same kernels, and what is combined is the air, whose parts
// are compared with each other here.
namespace slod::test {
namespace {

class UnusedEffects : public testing::TestWithParam<SmallScene> {};

std::string name_of(const testing::TestParamInfo<SmallScene>& info)
{
    return info.param.name;
}

/// The effect with a strength that throws particles out of the world wherever it acts.
template <class F>
typename F::Settings poisonous()
{
    typename F::Settings poison;
    for_each_field(poison, [&]<class T>(const Field& field, T& value) {
        const bool strong = field.key == "strength" || field.key == "amplitude" || field.key == "lift";
        if constexpr (std::is_same_v<T, double>)
            value = strong ? 1e20 : field.key == "stiffness" ? 1e4 : value;
        else if constexpr (std::is_same_v<T, Vector3d>)
            value = field.key == "velocity"      ? Vector3d(1e20, 1e20, 1e20)
                    : field.key == "half_extent" ? Vector3d::Constant(INFINITY)
                                                 : value;
    });
    return poison;
}

/// Gives the scene each effect it has not, poisonous and switched off. Springs are as stiff together as they
/// may be. Returns how many there are now that nothing may look at.
std::size_t add_poison(SimulationSettings& settings, std::size_t of_each = 1)
{
    std::size_t count = 0;
    const auto add = [&]<class Table>(std::string_view name, Table& table, const auto& poison) {
        if (named(table))
            return;
        for (std::size_t i = 0; i < of_each; ++i)
            add_element(table, poison);
        settings.effects.on[effect_row(name)] = false;
        count += of_each;
    };
    add("gravity", settings.gravity, GravitySettings{.strength = 1e20});
    add("uniform_gravity", settings.uniform_gravity, UniformGravitySettings{{1e20, 1e20, 1e20}});
    add("linear_drag", settings.linear_drag, LinearDragSettings{1e20});
    add("uniform_wind", settings.uniform_wind, UniformWindSettings{{1e20, 1e20, 1e20}});
    add("quadratic_drag", settings.quadratic_drag, QuadraticDragSettings{1e20});
    for_each_field_table(settings.fields, [&]<class F>(typename F::Table& table) {
        typename F::Settings poison = poisonous<F>();
        if constexpr (std::is_same_v<F, Spring>)
            poison.stiffness /= double(of_each);
        add(F::name, table, poison);
    });
    add("speed_limit", settings.speed_limit, SpeedLimitSettings{1e-20});
    add("brownian", settings.brownian, BrownianSettings{1e20});
    add("collider", settings.colliders, with(sphere({0, 0, 0}, 1e10), 1, 1));
    add("sink", settings.sinks, SinkSettings{.shape = SinkShape::Sphere, .radius = 1e10});
    for (std::size_t i = 0; i < settings.colliders.size(); ++i)
        settings.colliders[i].name = "collider" + std::to_string(i);
    for (std::size_t i = 0; i < settings.sinks.size(); ++i)
        settings.sinks[i].name = "sink" + std::to_string(i);
    return count;
}

TEST_P(UnusedEffects, E01_CountNothingInAThousandFrames)
{
    SmallScene scene = GetParam();
    add_poison(scene.settings);
    Simulation simulation(scene.settings, scene.initial, {});
    const Plan& plan = simulation.plan();
    for (int frame = 0; frame < 1000; ++frame) {
        const Snapshot& now = simulation.step({});
        for (std::size_t row = 0; row < effect_count; ++row)
            if (!plan.effects[row].active) {
                ASSERT_EQ(
                    now.effects[row].clusters + now.effects[row].particles + now.effects[row].straddling, 0U)
                    << effect_names[row];
            }
        for (std::size_t row = 0; row < now.counts.fields.size(); ++row)
            if (!plan.effects[first_field_effect + row].active) {
                ASSERT_EQ(now.counts.fields[row], FieldCount{}) << effect_names[first_field_effect + row];
            }
    }
}

// Whatever called a kernel of these, or added its result, would throw the particles out of the world.
TEST_P(UnusedEffects, E02_AreNeverCalledOrElseTheyPoisonTheScene)
{
    SmallScene scene = GetParam();
    EXPECT_GT(add_poison(scene.settings), 0U);
    ASSERT_EQ(problems(scene.settings), Problems{});
    EXPECT_EQ(hash_of(scene), hash_of(GetParam()));
}

/// Whether the same particles are within so far of each other, in units of 1 and of how far out they are.
bool alike(const ParticleSet& a, const ParticleSet& b, double far)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Particle& one, const Particle& other) {
                          return one.id == other.id &&
                                 (one.position - other.position).norm() <= far * (1 + one.position.norm()) &&
                                 (one.velocity - other.velocity).norm() <= far * (1 + one.velocity.norm());
                      });
}

// Or else the test above would prove nothing: each alone, switched on, spoils a cloud that falls through air.
TEST(PoisonousEffects, E02_SpoilTheSceneWhereTheyAreSwitchedOn)
{
    SmallScene scene{"cloud", quiet_settings(), {}};
    scene.settings.linear_drag = LinearDragSettings{0.3};
    add_cloud(scene.initial, {.count = 100, .mass = 1e-6}, 1);
    const auto particles = [](const SmallScene& of) {
        Simulation simulation(of.settings, of.initial, {});
        run(simulation, 3);
        return simulation.particles();
    };
    const ParticleSet clean = particles(scene);
    add_poison(scene.settings);
    EXPECT_TRUE(alike(particles(scene), clean, 0));
    for (std::size_t row = 0; row < effect_count; ++row) {
        if (scene.settings.effects.on[row])
            continue; // the drag that the scene has, emitters and their lifetime
        SmallScene poisoned = scene;
        poisoned.settings.effects.on[row] = true;
        EXPECT_FALSE(alike(particles(poisoned), clean, 1e-3)) << effect_names[row];
    }
}

TEST_P(UnusedEffects, E03_LeaveTheSameBitsWhetherThereAreTwoOrSixty)
{
    SmallScene two = GetParam(), sixty = GetParam();
    add_poison(two.settings);
    EXPECT_GE(add_poison(sixty.settings, 16), 60U);
    ASSERT_EQ(problems(sixty.settings), Problems{});
    EXPECT_EQ(hash_of(sixty), hash_of(two));
}

// To change the plan is to form the clusters anew from their members, which rounds places; nothing else is
// left of what came and went.
TEST_P(UnusedEffects, E03_ThatComeAndGoLeaveNothingBehind)
{
    SmallScene scene = GetParam();
    AllFields::for_each([&]<class F> {
        if (!named(scene.settings.fields.of<F>())) {
            add_default<F>(scene.settings.fields);
            scene.settings.effects.on[effect_row(F::name)] = false;
        }
    });
    Simulation simulation(scene.settings, scene.initial, {});
    run(simulation, 10);
    const Plan plan = simulation.plan();
    const ParticleSet before = simulation.particles();
    int changes = 0;
    AllFields::for_each([&]<class F> {
        if (simulation.plan().effects[effect_row(F::name)].active)
            return;
        for (const bool on : {true, false}) {
            SimulationSettings wanted = simulation.settings();
            wanted.effects.on[effect_row(F::name)] = on;
            const Problems found = simulation.change_settings(wanted);
            if (!found.empty()) {
                EXPECT_NE(found.front().find("drag"), std::string::npos) << found.front();
                return; // winds have nothing to act through here
            }
            EXPECT_EQ(simulation.plan().effects[effect_row(F::name)].active, on) << F::name;
            ++changes;
        }
    });
    EXPECT_GE(changes, GetParam().name.find("fields") == std::string::npos ? 4 : 0);
    EXPECT_TRUE(simulation.plan() == plan);
    EXPECT_TRUE(alike(before, simulation.particles(), 1e-5));
}

// The member pool's rows come in chunks; what else a simulation holds depends on the particles too, but not
// on the columns.
TEST_P(UnusedEffects, E04_TakeNoByteOfAParticle)
{
    SmallScene poisoned = GetParam();
    add_poison(poisoned.settings);
    const Plan plan = compile_plan(GetParam().settings, GetParam().initial),
               same = compile_plan(poisoned.settings, poisoned.initial);
    std::size_t declared = 0;
    for (const PlannedColumn& column : plan.member_columns)
        declared += column.bytes;
    const auto columns = [](const std::vector<PlannedColumn>& list) {
        std::vector<std::pair<std::string_view, std::size_t>> names;
        for (const PlannedColumn& column : list)
            names.emplace_back(column.name, column.bytes);
        return names;
    };
    EXPECT_EQ(columns(same.member_columns), columns(plan.member_columns));
    EXPECT_EQ(columns(same.cluster_columns), columns(plan.cluster_columns));
    const std::uint64_t before = bytes_held();
    MemberPool pool({.mass = plan.several_masses, .kind = plan.several_kinds, .expiry = plan.finite_lives});
    const std::uint64_t empty = bytes_held() - before;
    pool.reserve(MemberPool::chunk_rows, 0);
    const std::uint64_t chunk = bytes_held() - before - empty;
    EXPECT_EQ(chunk / MemberPool::chunk_rows, declared);
}

/// A cloud that flies on, with no effect at all.
SmallScene plain_cloud(double max_cluster_size)
{
    SmallScene scene{"plain", quiet_settings(), {}};
    add_cloud(scene.initial, {.count = 600}, 1);
    scene.settings.background.max_cluster_size = max_cluster_size;
    return scene;
}

bool has_tides(const Plan& plan)
{
    return std::any_of(plan.cluster_columns.begin(), plan.cluster_columns.end(),
                       [](const PlannedColumn& column) { return column.name.starts_with("tidal"); });
}

TEST(UnusedStructures, E06_AreNeverBuilt)
{
    std::int64_t now = 0;
    for (const double max_cluster_size : {1.0, 16.0}) {
        const SmallScene scene = plain_cloud(max_cluster_size);
        Simulation simulation(scene.settings, scene.initial,
                              {.isa = {}, .tick = [&] { return now += 1'000'000; }});
        for (int frame = 0; frame < 100; ++frame) {
            const Snapshot& done = simulation.step({});
            const FrameCounts& counts = done.counts;
            EXPECT_EQ(counts.walks + counts.nodes_tested + counts.far_nodes + counts.interactions, 0U);
            EXPECT_EQ(counts.born + counts.kicked + counts.struck + counts.error_pairs, 0U);
            EXPECT_EQ(done.profile[Phase::Forces], 0);
        }
        EXPECT_FALSE(has_tides(simulation.plan()));
    }
    const SmallScene attracted = small_scene("flow");
    EXPECT_TRUE(has_tides(compile_plan(attracted.settings, attracted.initial)));
}

// A box that holds a hundredth of what there is, at places that are asked for nowhere else.
TEST(BoundedEffects, E08_AreEvaluatedForWhatTheirBoundsTouch)
{
    SmallScene scene{"lattice", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = 1;
    scene.settings.linear_drag = LinearDragSettings{0.1};
    for (std::uint64_t i = 0; i < 32'768; ++i)
        scene.initial.push_back({{double(i % 32), double(i / 32 % 32), double(i / 1024)}, {0, 0, 0}, i, 1});
    WindSettings box;
    box.centre = {3, 3, 3};
    box.half_extent = Vector3d::Constant(3.5); // 7^3 of 32^3 places
    scene.settings.fields.of<Wind>() = {box};
    Simulation simulation(scene.settings, scene.initial, {});
    const FrameCounts& counts = simulation.step({}).counts;
    FieldCount wind;
    std::size_t row = 0;
    AllFields::for_each([&]<class F> {
        if constexpr (std::is_same_v<F, Wind>)
            wind = counts.fields[row];
        ++row;
    });
    EXPECT_GE(wind.clusters, 343U);
    EXPECT_LE(double(wind.clusters), 0.03 * double(counts.clusters));
}

// Uniform wind goes into the propagator; the same as a box about everything is evaluated for each cluster,
// and goes into one of its own by the same formula: velocities that are held in double agree to a few
// roundings.
TEST(CombinedAir, E09_IsTheSameAsItsParts)
{
    const auto particles = [](bool combined) {
        SmallScene scene = plain_cloud(1);
        scene.settings.linear_drag = LinearDragSettings{0.7};
        if (combined)
            scene.settings.uniform_wind = UniformWindSettings{{1, 2, 3}};
        else
            scene.settings.fields.of<Wind>() = {
                {.velocity = {1, 2, 3}, .half_extent = Vector3d::Constant(1e9)}};
        Simulation simulation(scene.settings, scene.initial, {});
        run(simulation, 1);
        return simulation.particles();
    };
    const ParticleSet combined = particles(true), each = particles(false);
    ASSERT_EQ(combined.size(), each.size());
    double farthest = 0;
    for (std::size_t i = 0; i < each.size(); ++i)
        farthest = std::max(farthest, (combined[i].velocity - each[i].velocity).cwiseAbs().maxCoeff());
    EXPECT_LE(farthest, 4 * 0x1p-52); // of speeds up to 3 in the wind's direction
}

/// Drags, winds and attractors that commute. Of three terms the order of a sum can be told by its rounding.
std::string scene_text(bool backwards)
{
    const auto attractor = [](const std::string& x, const std::string& strength) {
        return "[[attractor]]\nposition = [" + x + ", 1, 0.5]\nstrength = " + strength + "\n";
    };
    std::vector<std::string> tables{"[[kind]]\nname = \"star\"\n",
                                    "[background]\nmax_breadth = 1.0\n",
                                    "[gravity]\nstrength = 0.1\n",
                                    "[linear_drag]\nrate = 0.3\n",
                                    "[uniform_wind]\nvelocity = [0.1, 0.2, 0]\n",
                                    "[uniform_gravity]\nacceleration = [0, 0, -1]\n",
                                    attractor("1", "0.3"),
                                    attractor("-1", "0.7"),
                                    attractor("0", "1.1"),
                                    "[turbulence]\n",
                                    "[speed_limit]\nspeed = 5\n"};
    if (backwards)
        std::reverse(tables.begin(), tables.end());
    std::string text;
    for (const std::string& table : tables)
        text += table + "\n";
    return text;
}

TEST(EffectsOfAScene, E11_GiveTheSameBitsInAnyOrder)
{
    const auto hash = [](bool backwards) {
        const auto loaded = load_scene({.name = "order.toml", .text = scene_text(backwards)}, {});
        if (const auto* problems = std::get_if<Problems>(&loaded)) {
            ADD_FAILURE() << problems->front();
            return std::uint64_t{0};
        }
        SmallScene scene{"order", std::get<Scene>(loaded).simulation, {}};
        add_cloud(scene.initial, {.count = 600}, 1);
        return hash_of(scene);
    };
    EXPECT_EQ(hash(true), hash(false));
}

INSTANTIATE_TEST_SUITE_P(Scenes, UnusedEffects, testing::ValuesIn(small_scenes()), name_of);

} // namespace
} // namespace slod::test
