#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/default_fields.hpp"
#include "support/pair_error.hpp"
#include "support/small_scenes.hpp"

// What holds for every effect of place in a simulation: an effect that is added to the list is tested by this.
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

/// The state's hash after some lives of clusters.
std::uint64_t hash_of(const SmallScene& scene, int threads = 2)
{
    std::uint64_t hash = 0;
    ThreadTeam(threads).run([&] {
        Simulation simulation(scene.settings, scene.initial, {});
        for (int frame = 0; frame < 40; ++frame)
            simulation.step({});
        hash = simulation.state_hash();
    });
    return hash;
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

TYPED_TEST_SUITE(EffectInAScene, TestTypes<ForceFields>::Types, FieldName);

// E-10
TYPED_TEST(EffectInAScene, OfNoStrengthIsAsIfAbsentToTheBit)
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

// E-1 and E-2: the kernel of what is absent is never called.
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

/// A pair at +-delta about a place, in one cluster or each member alone, after 24 frames.
PairError pair_error(const FieldSettings& fields, double delta)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.shortest_life = settings.motion.longest_life = 64;
    settings.background.max_breadth = 64;
    settings.linear_drag = LinearDragSettings{0.7};
    settings.fields = fields;
    const Vector3d centre(0.6, 0.5, 0.1), velocity(0.2, -0.1, 0.15);
    const Vector3d offset(0.6, -0.64, 0.48), relative_velocity(-0.48, 0.6, 0.64); // of length 1
    ParticleSet initial;
    for (const double side : {delta, -delta})
        initial.push_back(
            {centre + side * offset, velocity + side * relative_velocity, initial.size(), 1});
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
TYPED_TEST(EffectInAScene, IsInTheTangentOfTheStep)
{
    FieldSettings fields;
    add_default<TypeParam>(fields);
    const double delta = 0x1p-5;
    const PairError coarse = pair_error(fields, delta), fine = pair_error(fields, delta / 2);
    const double rounding = 24 * float_rounding * fine.spread;
    EXPECT_LE(fine.odd, 1.25 * coarse.odd / 8 + rounding);
    EXPECT_LE(fine.even, 1.25 * coarse.even / 4 + rounding);
    EXPECT_LE(coarse.odd, 0.01 * coarse.spread);
}

} // namespace
} // namespace slod::test
