#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/field_tables.hpp"
#include "support/one_cluster.hpp"
#include "support/small_scenes.hpp"

// Clusters that the boundary of an effect of place cuts are counted.
namespace slod::test {
namespace {

constexpr int crowd_count = 8;
constexpr double crowd_radius = 0.2;

/// Eight crowds of 64 at rest at x = -3.5 to 3.5, each within 0.2 of there and, in its cell, one cluster.
SmallScene row_of_crowds(Motion motion, double max_cluster_size = 96)
{
    SmallScene scene{"row", settings_for({"row", 64, motion}), {}};
    scene.settings.background.max_cluster_size = max_cluster_size;
    scene.settings.background.max_breadth = 1;
    scene.settings.linear_drag = LinearDragSettings{0.1};
    for (int crowd = 0; crowd < crowd_count; ++crowd)
        for (Particle particle : about(64, {crowd - 3.5, 0.5, 0.5}, {0, 0, 0}, crowd_radius)) {
            particle.velocity = {0, 0, 0};
            particle.id = scene.initial.size();
            scene.initial.push_back(particle);
        }
    return scene;
}

EffectWork first_work(const SmallScene& scene, std::string_view effect)
{
    Simulation simulation(scene.settings, scene.initial, {});
    const bool unclustered = scene.settings.background.max_cluster_size < 2;
    EXPECT_EQ(simulation.snapshot({}).counts.clusters, unclustered ? scene.initial.size() : crowd_count);
    const Snapshot& first = simulation.step({});
    const std::size_t row = effect_row(effect);
    EXPECT_EQ(first.effects[row].straddling, first.counts.fields[row - first_field_effect].straddling);
    for (std::size_t other = 0; other < effect_count; ++other)
        if (other != row) {
            EXPECT_EQ(first.effects[other].straddling, 0U) << effect_names[other];
        }
    return first.effects[row];
}

/// From x = -2.4 to 2.6, and along y and z without end.
WindSettings wind_in_a_slab()
{
    return {.velocity = {1e-3, 0, 0},
            .centre = {0.1, 0, 0},
            .half_extent = {2.5, INFINITY, INFINITY},
            .edge = 0.05};
}

class Straddling : public testing::TestWithParam<Motion> {};

// The crowds at -2.5, whose middle is outside, and at 2.5, whose middle is inside, reach across a face. The
// four between them are inside, those at -3.5 and 3.5 outside.
TEST_P(Straddling, ClustersAtAFaceOfAWindAreCountedAndNoOthers)
{
    SmallScene scene = row_of_crowds(GetParam());
    scene.settings.fields.of<Wind>() = {wind_in_a_slab()};
    const EffectWork work = first_work(scene, "wind");
    EXPECT_EQ(work.straddling, 2U);
    EXPECT_EQ(work.clusters, 5U);
    scene.settings.fields.of<Wind>().push_back(wind_in_a_slab());
    EXPECT_EQ(first_work(scene, "wind").straddling, 4U) << "once for each element";
}

TEST_P(Straddling, ClustersAtTheEndOfAnAttractorAreCountedAndNoOthers)
{
    SmallScene scene = row_of_crowds(GetParam());
    AttractorSettings attractor{.position = {0.1, 0.5, 0.5}, .strength = 1e-3, .radius = 2.5};
    scene.settings.fields.of<Attractor>() = {attractor};
    EXPECT_EQ(first_work(scene, "attractor").straddling, 2U);
    attractor.radius = INFINITY;
    scene.settings.fields.of<Attractor>() = {attractor};
    EXPECT_EQ(first_work(scene, "attractor").straddling, 0U);
}

// It sets in between x = 2.55 and 1.45: one crowd reaches across each end.
TEST_P(Straddling, ClustersAtAnEndOfTheWatersSurfaceAreCountedAndNoOthers)
{
    SmallScene scene = row_of_crowds(GetParam());
    scene.settings.fields.of<Buoyancy>() = {{.level = 2, .up = {1, 0, 0}, .lift = 1e-3, .transition = 1.1}};
    EXPECT_EQ(first_work(scene, "buoyancy").straddling, 2U);
}

std::string name_of_motion(const testing::TestParamInfo<Motion>& info)
{
    return std::string(names(Motion{})[std::size_t(info.param)]);
}

INSTANTIATE_TEST_SUITE_P(Motions, Straddling, testing::Values(Motion::Flow, Motion::Stream, Motion::Rigid),
                         name_of_motion);

TEST(Straddling, FramesThatAreCutIntoStepsCountAClusterOnce)
{
    SmallScene scene = row_of_crowds(Motion::Flow);
    scene.settings.time.max_substeps = 8;
    scene.settings.time.substep_angle = 1e-6;
    scene.settings.fields.of<Attractor>() = {{.position = {0.1, 0.5, 0.5}, .strength = 1e-3, .radius = 2.5}};
    Simulation simulation(scene.settings, scene.initial, {});
    for (int frame = 0; frame < 2; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        EXPECT_EQ(counts.substeps, 8U);
        EXPECT_EQ(counts.fields[effect_row("attractor") - first_field_effect].straddling, 2U);
    }
}

TEST(Straddling, NoParticleByItselfIsCounted)
{
    SmallScene scene = row_of_crowds(Motion::Flow, 1);
    scene.settings.fields.of<Wind>() = {wind_in_a_slab()};
    scene.settings.fields.of<Attractor>() = {{.position = {0.1, 0.5, 0.5}, .strength = 1e-3, .radius = 2.5}};
    EXPECT_EQ(first_work(scene, "wind").straddling, 0U);
}

// A pair at one place, 0.25 before the wind, whose members fly apart along the face's normal at 1: 16 frames
// of 1/64 later they are there, but for what the drag of 1e-3 leaves.
TEST(Straddling, AClusterIsCountedFromWhenItHasSpreadToTheBoundary)
{
    SmallScene scene{"pair", quiet_settings(), {}};
    scene.settings.motion.shortest_life = scene.settings.motion.longest_life = 64;
    scene.settings.background.max_breadth = 64;
    scene.settings.background.max_cluster_size = 4;
    scene.settings.linear_drag = LinearDragSettings{1e-3};
    scene.settings.fields.of<Wind>() = {wind_in_a_slab()};
    for (const double side : {1.0, -1.0})
        scene.initial.push_back({{2.85, 0, 0}, {side, 0, 0}, scene.initial.size(), 1});
    Simulation simulation(scene.settings, scene.initial, {});
    std::vector<std::uint64_t> straddling;
    for (int frame = 0; frame < 24; ++frame) {
        const Snapshot& now = simulation.step({});
        ASSERT_EQ(now.counts.clusters, 1U);
        straddling.push_back(now.effects[effect_row("wind")].straddling);
    }
    std::vector<std::uint64_t> expected(24, 0);
    std::fill(expected.begin() + 17, expected.end(), 1); // as it was when the frame began
    EXPECT_EQ(straddling, expected);
}

// Two out from a crowd's middle and across a boundary at 1.6. Of 64 masses alike none is farther out than 8
// times their root mean square distance, 0.3 with it; a light one is farther than 8 times 0.15.
TEST(Straddling, AClusterIsCountedForOneMemberFarOutWhateverItsMass)
{
    for (const float mass : {1.0F, 1e-6F}) {
        SmallScene scene = row_of_crowds(Motion::Flow);
        scene.settings.background.max_breadth = 4096;
        scene.initial.resize(64);
        scene.initial[0].mass = mass;
        scene.initial[0].position = {-5.5, 0.5, 0.5};
        scene.settings.fields.of<Attractor>() = {
            {.position = {-3.5, 0.5, 0.5}, .strength = 1e-3, .radius = 1.6}};
        Simulation simulation(scene.settings, scene.initial, {});
        const Snapshot& first = simulation.step({});
        ASSERT_EQ(first.counts.clusters, 1U);
        EXPECT_EQ(first.effects[effect_row("attractor")].straddling, 1U) << mass;
    }
}

TEST(Straddling, IsTheSameAtAnyNumberOfThreads)
{
    for (const char* name : {"fields", "attracted_fields", "winds", "winds_among_obstacles"}) {
        const SmallScene scene = small_scene(name);
        const auto counts = [&](int threads) {
            std::vector<FieldCounts> all;
            ThreadTeam(threads).run([&] {
                Simulation simulation(scene.settings, scene.initial, {});
                for (int frame = 0; frame < 40; ++frame)
                    all.push_back(simulation.step({}).counts.fields);
            });
            return all;
        };
        const std::vector<FieldCounts> alone = counts(1);
        std::uint64_t straddling = 0;
        for (const FieldCounts& frame : alone)
            for (const FieldCount& effect : frame)
                straddling += effect.straddling;
        EXPECT_GT(straddling, 0U) << name;
        EXPECT_EQ(counts(3), alone) << name;
        EXPECT_EQ(counts(8), alone) << name;
    }
}

} // namespace
} // namespace slod::test
