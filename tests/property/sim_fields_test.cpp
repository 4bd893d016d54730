#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/default_fields.hpp"
#include "support/pair_error.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// What holds for every effect of place in a simulation: an effect that is added to the list is tested by
// this.
namespace slod::test {
namespace {

constexpr double float_rounding = 0x1p-24;

/// A cloud about the origin, where default settings act, and a fountain in it.
SmallScene scene_in_fields()
{
    SmallScene scene{"fields", quiet_settings(), {}};
    scene.settings.motion.longest_life = 16;
    scene.settings.background.max_cluster_size = 16;
    scene.settings.background.pool_factor = 2;
    scene.settings.background.max_breadth = 1;
    scene.settings.linear_drag = LinearDragSettings{0.3};
    scene.settings.emitters = {jet("jet")};
    add_cloud(scene.initial, {.count = 600}, 1);
    return scene;
}

template <class F>
constexpr std::size_t row_of()
{
    std::size_t row = 0, found = 0;
    for_each_field_table(FieldSettings{}, [&]<class E>(const typename E::Table&) {
        if (std::is_same_v<E, F>)
            found = row;
        ++row;
    });
    return found;
}

template <class F>
class EffectInAScene : public testing::Test {};

TYPED_TEST_SUITE(EffectInAScene, TestTypes<AllFields>::Types, FieldName);

TYPED_TEST(EffectInAScene, E10_OfNoStrengthIsAsIfAbsentToTheBit)
{
    SmallScene scene = scene_in_fields();
    const std::uint64_t without = hash_of(scene);
    SmallScene powerless_scene = scene;
    for_each_field_table(powerless_scene.settings.fields, [&]<class F>(typename F::Table& table) {
        if constexpr (std::is_same_v<F, TypeParam>)
            add_element(table, powerless<F>());
    });
    EXPECT_EQ(hash_of(powerless_scene), without);
    const Plan plan = compile_plan(powerless_scene.settings, scene.initial);
    EXPECT_NE(explain(plan, powerless_scene.settings).find("strength 0 left out: 1 of them, absent"),
              std::string::npos);
    add_default<TypeParam>(scene.settings.fields);
    EXPECT_NE(hash_of(scene), without) << "or else it would be lost on everybody";
}

TYPED_TEST(EffectInAScene, HasTheSameBitsAtAnyNumberOfThreads)
{
    SmallScene scene = scene_in_fields();
    add_default<TypeParam>(scene.settings.fields);
    const std::uint64_t alone = hash_of(scene, 1);
    EXPECT_EQ(hash_of(scene, 3), alone);
    EXPECT_EQ(hash_of(scene, 8), alone);
}

// The kernel of what is absent is never called.
TYPED_TEST(EffectInAScene, IsTheOnlyOneAsked)
{
    SmallScene scene = scene_in_fields();
    add_default<TypeParam>(scene.settings.fields);
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 100; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        for (std::size_t row = 0; row < counts.fields.size(); ++row) {
            if (row == row_of<TypeParam>()) {
                EXPECT_GT(counts.fields[row].calls, 0U);
                EXPECT_GT(counts.fields[row].clusters, 0U);
            } else {
                ASSERT_EQ(counts.fields[row], FieldCount{}) << row;
            }
        }
    }
}

/// What two winds alike did in the first frame of a cloud.
FieldCount first_count(const WindSettings& wind)
{
    SmallScene scene = scene_in_fields();
    scene.settings.emitters.clear();
    scene.settings.fields.of<Wind>() = {wind, wind};
    Simulation simulation(scene.settings, scene.initial, {});
    const std::uint64_t clusters = simulation.snapshot({}).counts.clusters;
    EXPECT_GT(clusters, 0U);
    const FieldCount count = simulation.step({}).counts.fields[row_of<Wind>()];
    EXPECT_EQ(count.clusters, 2 * clusters);
    return count;
}

// The cloud ends at 5 scale lengths. Winds in boxes are asked for each cluster, and for the clocks before the
// first frame, which does not count; winds that are everywhere alike are asked once.
TEST(WindsInAScene, AreCountedForEachClusterFromTheFirstFrameOn)
{
    EXPECT_GE(first_count({.half_extent = Vector3d::Constant(100)}).calls, 2U);
    EXPECT_EQ(first_count({.half_extent = Vector3d::Constant(INFINITY), .gust_amplitude = 1}).calls, 2U);
}

TYPED_TEST(EffectInAScene, KeepsTheStateSound)
{
    SmallScene scene = scene_in_fields();
    add_default<TypeParam>(scene.settings.fields);
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 100; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.problems(), Problems{});
    for (const Particle& particle : simulation.particles())
        ASSERT_TRUE(particle.position.allFinite() && particle.velocity.allFinite());
}

/// Under which a pair lives longer than it is watched.
SimulationSettings settings_of_pairs()
{
    SimulationSettings settings = quiet_settings();
    settings.motion.shortest_life = settings.motion.longest_life = 64;
    settings.background.max_breadth = 64;
    settings.linear_drag = LinearDragSettings{0.7};
    return settings;
}

/// A pair at +-delta about a place, in one cluster or each member alone, after 24 frames.
PairError pair_error(SimulationSettings settings, double delta)
{
    const Vector3d centre(0.6, 0.5, 0.1), velocity(0.2, -0.1, 0.15);
    const Vector3d offset(0.6, -0.64, 0.48), relative_velocity(-0.48, 0.6, 0.64); // of length 1
    ParticleSet initial;
    for (const double side : {delta, -delta})
        initial.push_back({centre + side * offset, velocity + side * relative_velocity, initial.size(), 1});
    const auto run = [&](double max_cluster_size) {
        settings.background.max_cluster_size = max_cluster_size;
        Simulation simulation(settings, initial, {});
        for (int frame = 0; frame < 24; ++frame)
            simulation.step({});
        EXPECT_EQ(simulation.snapshot({}).counts.clusters, max_cluster_size > 1 ? 1U : 2U);
        return simulation.particles();
    };
    return compare_pairs(run(4), run(1));
}

// The map is the tangent of the whole step: a term missing from it leaves an odd error of first order in
// delta. Halving delta divides an error of third order by 8 and one of second order by 4, but for a share of
// the terms beyond that is below a quarter at these delta; below the rounding of the map, once per frame,
// nothing is asked.
void expect_tangent(const SimulationSettings& settings)
{
    const double delta = 0x1p-5;
    const PairError coarse = pair_error(settings, delta), fine = pair_error(settings, delta / 2);
    const double rounding = 24 * float_rounding * fine.spread;
    EXPECT_LE(fine.odd, 1.25 * coarse.odd / 8 + rounding);
    EXPECT_LE(fine.even, 1.25 * coarse.even / 4 + rounding);
    EXPECT_LE(coarse.odd, 0.01 * coarse.spread);
}

TYPED_TEST(EffectInAScene, IsInTheTangentOfTheStep)
{
    SimulationSettings settings = settings_of_pairs();
    add_default<TypeParam>(settings.fields);
    expect_tangent(settings);
}

TEST(QuadraticDragInAScene, IsInTheTangentOfTheStep)
{
    SimulationSettings settings = settings_of_pairs();
    settings.quadratic_drag = QuadraticDragSettings{2};
    expect_tangent(settings); // slowing down
    settings.uniform_gravity = UniformGravitySettings{{-1, 2, -3}};
    expect_tangent(settings); // falling
    add_default<Turbulence>(settings.fields);
    expect_tangent(settings); // falling in eddies
}

TEST(QuadraticDragInAScene, E10_OfNoStrengthIsAsIfAbsentToTheBit)
{
    SmallScene scene = scene_in_fields();
    const std::uint64_t without = hash_of(scene);
    scene.settings.quadratic_drag = QuadraticDragSettings{0};
    EXPECT_EQ(hash_of(scene), without);
    scene.settings.quadratic_drag = QuadraticDragSettings{1e-3};
    EXPECT_NE(hash_of(scene), without);
}

// Of a cluster of 64 as of one particle, in linear and quadratic drag.
TEST(QuadraticDragInAScene, F03_BringsAClusterOf64ToTheTerminalVelocity)
{
    SmallScene scene{"falling", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = 96;
    scene.settings.background.max_breadth = 4096;
    scene.settings.uniform_gravity = UniformGravitySettings{{0, 0, -10}};
    scene.settings.linear_drag = LinearDragSettings{0.6};
    scene.settings.quadratic_drag = QuadraticDragSettings{0.2};
    add_cloud(scene.initial, {.count = 64, .centre = {100, 100, 1000}}, 2);
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 1000; ++frame)
        simulation.step({});
    EXPECT_EQ(simulation.snapshot({}).counts.clusters, 1U);
    // 0.6 w + 0.2 w^2 = 10; transients are e^(-2.9 * 15) of the start's.
    const Vector3d terminal(0, 0, 1.5 - std::sqrt(1.5 * 1.5 + 50));
    for (const Particle& particle : simulation.particles())
        expect_at_most("distance from the terminal velocity", (particle.velocity - terminal).norm(), 1e-9);
}

// Lives are powers of two from 2 to 16 frames. At k = 0.3 and gradients of some 3 amplitudes, eddies of 0.01
// deform at 0.1, which asks for 128 frames, and eddies of 30 at 5, for 2 or 4.
TEST(Eddies, RenewMapsTheMoreOftenTheStrongerTheyAre)
{
    const auto reformed = [](double amplitude) {
        SmallScene scene = scene_in_fields();
        scene.settings.emitters.clear();
        scene.settings.fields.of<Turbulence>() = TurbulenceSettings{.amplitude = amplitude};
        Simulation simulation(scene.settings, scene.initial, {});
        std::uint64_t members = 0;
        for (int frame = 0; frame < 64; ++frame)
            members += simulation.step({}).counts.reformed_members;
        return double(members);
    };
    const double weak = reformed(0.01);
    EXPECT_NEAR(weak / (600.0 * 64 / 16), 1, 0.3) << "every particle once in the longest life";
    EXPECT_GT(reformed(30), 3 * weak);
}

/// A cloud and a jet that fall onto a floor in wind and drag. The wind is in a box, far away on all sides, or
/// uniform.
ParticleSet fallen(bool in_box, double max_cluster_size)
{
    SmallScene scene{"floor", quiet_settings(), {}};
    scene.settings.background.max_cluster_size = max_cluster_size;
    scene.settings.background.max_breadth = 1;
    scene.settings.uniform_gravity.emplace();
    scene.settings.linear_drag = LinearDragSettings{0.8};
    const Vector3d velocity(2, -1, 3);
    if (in_box)
        scene.settings.fields.of<Wind>() = {
            {.velocity = velocity, .half_extent = Vector3d::Constant(1000), .edge = 1}};
    else
        scene.settings.uniform_wind = UniformWindSettings{velocity};
    scene.settings.colliders = {with(plane({0, 0, -1}, {0.1, 0, 1}), 0.6, 0.3)};
    scene.settings.emitters = {jet("jet")};
    scene.settings.emitters.front().direction = {0, 0, -1};
    scene.settings.emitters.front().lifetime = INFINITY;
    add_cloud(scene.initial, {.count = 100, .mass = 1e-2, .scale = 0.1, .velocity = {0, 0, -2}}, 6);
    Simulation simulation(scene.settings, scene.initial, {});
    std::uint64_t impacts = 0;
    for (int frame = 0; frame < 40; ++frame)
        impacts += simulation.step({}).counts.impacts;
    EXPECT_GT(impacts, 100U);
    return simulation.particles();
}

// Wind that differs from cluster to cluster takes the general road: maps, newborns and members that bounce
// ask for it one by one. Where it happens to be the same everywhere all must be as on the road for uniform
// wind.
TEST(WindInAVastBox, BlowsAsUniformWindDoes)
{
    for (const double size : {1.0, 16.0}) {
        const ParticleSet uniform = fallen(false, size), in_box = fallen(true, size);
        ASSERT_EQ(uniform.size(), in_box.size());
        // Single particles differ by their formulae's roundings, times what bounces magnify: by 10 at most.
        // Members of clusters are rounded to float when formed and mapped, and which share one differs.
        const double tolerance = size > 1 ? 40 * 8 * 10 * float_rounding : 40 * 32 * 10 * 0x1p-52;
        for (std::size_t i = 0; i < uniform.size(); ++i) {
            ASSERT_EQ(uniform[i].id, in_box[i].id);
            EXPECT_LE((uniform[i].position - in_box[i].position).norm(), tolerance) << size << ", " << i;
            EXPECT_LE((uniform[i].velocity - in_box[i].velocity).norm(), 4 * tolerance) << size << ", " << i;
        }
    }
}

} // namespace
} // namespace slod::test
