#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/random_regions.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"

// Regions of interest that move, meet, come and go, or ask for what makes no sense.
namespace slod::test {
namespace {

// Membership is exact in every frame, so that nothing keeps a cluster from changing its cell as often as it
// crosses a face; what that must not do is to form anything anew. A transfer alone relinks a list.
TEST(SlodStability, S05_JitterOverAFaceOfACellFormsNothingAnew)
{
    for (const double amplitude : {1e-3, 1e-16}) {
        test::World world({MapKind::Identity, 0, 1}, {}, {.max_cluster_size = 16}, 1);
        const ClusterSlot slot = world.add(ball(10, 0.2, 0, 1, {1, 0.5, 0.5}));
        world.tree.merging = true;
        Regrouping regrouping({}, world.context(0));
        UpdateCounts counts;
        for (std::uint64_t frame = 1; frame <= 10'000; ++frame) {
            world.store.clusters.position[slot.index].x() = 1 + (frame % 2 == 0 ? amplitude : -amplitude);
            regrouping.update(world.tree, frame, counts);
        }
        expect_at_most("members formed anew by jitter over a face of a cell", double(counts.reformed_members),
                       0);
        EXPECT_LE(world.region().pool_count(), 2U);
        for (std::uint64_t frame = 10'001; frame <= 10'008; ++frame)
            regrouping.update(world.tree, frame, counts);
        EXPECT_EQ(world.region().pool_count(), 1U) << "the cell that was left is gone";
        EXPECT_EQ(members(world.store, 10'000).size(), 10U);
        EXPECT_EQ(problems(world.tree, world.store.clusters), Problems{});
    }
}

// Cells are marked as soon as they are there: one far region is asked about at the first sight of a new cell
// alone, and of none that has been laid anew.
TEST(SlodStability, S12_CellsThatAreLaidAnewAskNoMoreRegionsThanTheOldOnes)
{
    SimulationSettings settings = rigid_settings(16);
    settings.background.max_breadth = 2;
    settings.regions = {box_region("far", {50, 0, 0}, {1, 1, 1}, 4)};
    Simulation simulation(settings, cube(1600, 1, 1), {});
    run(simulation, 20);
    ASSERT_EQ(simulation.step({}).counts.boundary_tests, 0U) << "all rest in their cells";
    RegionOfInterest background = simulation.regions().back().settings;
    background.partition.max_breadth = 1.5;
    ASSERT_EQ(simulation.change_region(background), Problems{});
    run(simulation, 1);
    expect_at_most("regions asked about in cells laid anew",
                   double(simulation.step({}).counts.boundary_tests), 0);
}

/// A hundred clumps of 16 about the face x = 0, within 1e-3 of it.
ParticleSet clumps_on_a_face()
{
    ParticleSet particles;
    for (int y = 0; y < 10; ++y)
        for (int z = 0; z < 10; ++z) {
            const ParticleSet clump = ball(16, 1e-3, 0, std::uint64_t(10 * y + z), Vector3d(0, y, z));
            for (Particle particle : clump) {
                particle.id = particles.size() + 1;
                particles.push_back(particle);
            }
        }
    return particles;
}

// The face jitters by more than the clumps are wide, so that all of them are handed over in each frame. Every
// cluster looks for a partner once in sixteen frames, two make one, and only what was merged is split again:
// that is at most a sixteenth.
TEST(SlodStability, S05_JitterOverAFaceOfARegionSplitsAndMergesAtMostEveryTenthFrame)
{
    SimulationSettings settings = rigid_settings(16);
    settings.regions = {box_region("fine", {-20, 5, 5}, {20, 20, 20}, 4)};
    Simulation simulation(settings, clumps_on_a_face(), {});
    run(simulation, 200);
    constexpr int frames = 2000;
    std::uint64_t churn = 0, clusters = 0, crossings = 0;
    for (int frame = 0; frame < frames; ++frame) {
        RegionOfInterest fine = settings.regions[0];
        fine.centre.x() += frame % 2 == 0 ? 2e-3 : -2e-3;
        ASSERT_EQ(simulation.change_region(fine), Problems{});
        const FrameCounts counts = simulation.step({}).counts;
        churn += counts.splits + counts.merges;
        clusters += counts.clusters;
        crossings += counts.crossings;
        ASSERT_EQ(counts.particles, 1600U);
    }
    EXPECT_GE(crossings, clusters / 10 * 9) << "all but what is split are handed over";
    expect_at_most("splits and merges per cluster and frame at a face of a region",
                   double(churn) / double(clusters), 0.1);
    EXPECT_EQ(simulation.problems(), Problems{});
}

/// Particles of two sets, in the order of their ids, that are not in the same place to the bit.
double elsewhere(const ParticleSet& found, const ParticleSet& expected)
{
    double different = std::abs(double(found.size()) - double(expected.size()));
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
        different += found[i].position == expected[i].position ? 0 : 1;
    return different;
}

TEST(SlodStability, S09_ARegionOfNoSizeIsEmptyAndOneThatMakesNoSenseIsRefused)
{
    const SimulationSettings settings = rigid_settings(16);
    const ParticleSet particles = ball(1000, 1, 0.5, 1);
    Simulation untouched(settings, particles, {}), simulation(settings, particles, {});
    run(untouched, 20);
    ASSERT_EQ(simulation.add_region(ball_region("point", {0, 0, 0}, 0, 1)), Problems{});
    ASSERT_EQ(simulation.add_region(box_region("line", {0, 0, 0}, {1, 0, 1}, 1)), Problems{});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    int refused = 0;
    for (const RegionOfInterest& senseless :
         {ball_region("negative", {0, 0, 0}, -1, 1), box_region("inside-out", {0, 0, 0}, {1, -1, 1}, 1),
          ball_region("nowhere", {nan, 0, 0}, 1, 1), ball_region("no-radius", {0, 0, 0}, nan, 1),
          ball_region("no-size", {0, 0, 0}, 1, nan)})
        refused += simulation.add_region(senseless) == Problems{} ? 0 : 1;
    expect_within("senseless regions of 5 that are refused", refused, 5, 5);
    const Snapshot& snapshot = run(simulation, 20);
    expect_at_most("particles in regions of no size",
                   double(load_of(simulation, snapshot, "point").particles +
                          load_of(simulation, snapshot, "line").particles),
                   0);
    EXPECT_EQ(snapshot.regions.size(), 3U);
    expect_at_most("particles of 1000 elsewhere than without them",
                   elsewhere(simulation.particles(), untouched.particles()), 0);
}

TEST(SlodStability, S10_ARegionOutsideOfEverythingCostsNothingAndOneOverEverythingIsABackground)
{
    const ParticleSet particles = ball(2000, 2, 1, 1);
    SimulationSettings settings = rigid_settings(8);
    Simulation plain(settings, particles, {});
    settings.regions = {ball_region("elsewhere", {1e6, 0, 0}, 10, 2)};
    Simulation beside(settings, particles, {});
    settings.background.max_cluster_size = 64;
    settings.regions = {world_region("over-all", 8)};
    Simulation under(settings, particles, {});
    for (int frame = 0; frame < 40; ++frame) {
        plain.step({});
        const FrameCounts counts = beside.step({}).counts;
        expect_at_most("questions of a far region less clusters that leave their leaf",
                       double(counts.boundary_tests) - double(counts.crossings), 0);
        under.step({});
    }
    expect_at_most("particles of 2000 elsewhere than without a far region",
                   elsewhere(beside.particles(), plain.particles()), 0);
    expect_at_most("particles of 2000 elsewhere than in a background of the same size",
                   elsewhere(under.particles(), plain.particles()), 0);
    EXPECT_EQ(under.snapshot({}).counts.clusters, plain.snapshot({}).counts.clusters);
}

TEST(SlodStability, S10_AVastRegionOfTinyCellsHasOnlyTheCellsThatHoldSomething)
{
    RigidRules rules{.background = {.max_breadth = 1}, .regions = {}};
    rules.regions = {box_region("vast", {0, 0, 0}, {1e12, 1e12, 1e12}, 8)};
    rules.regions[0].partition.max_breadth = 1e-3;
    RigidWorld world(rules, ball(500, 100, 10, 1));
    world.advance(50);
    EXPECT_EQ(world.problems(), Problems{});
    // Beside those in use only those left in the eight frames since the last revision, each particle one.
    expect_at_most("cells of a vast region", double(world.tree().subtrees[1].cells.size()), 500 * 9);
}

TEST(SlodStability, S11_RegionsThatMoveThroughEachOtherHoldJustWhatPrecedenceGivesThem)
{
    SimulationSettings settings = rigid_settings(16);
    settings.regions = {ball_region("left", {-2, 0, 0}, 1, 4), ball_region("right", {2, 0, 0}, 1, 2)};
    settings.regions[1].precedence = 1;
    Simulation simulation(settings, ball(300, 3, 0.01, 1), {});
    std::size_t wrong = 0;
    for (int frame = 0; frame < 10'000; ++frame) {
        for (RegionOfInterest region : settings.regions) {
            region.centre.x() *= std::cos(0.013 * frame);
            ASSERT_EQ(simulation.change_region(region), Problems{});
        }
        const Snapshot& snapshot = simulation.step({.clusters = true});
        wrong += clusters_in_wrong_regions(simulation, snapshot);
        ASSERT_EQ(snapshot.counts.particles, 300U);
    }
    expect_at_most("clusters in the wrong region, of all frames", double(wrong), 0);
    EXPECT_EQ(simulation.problems(), Problems{});
}

/// No particle moves farther in a frame than the fastest, and a rounding to float of an offset in the cloud.
void expect_no_jumps(const ParticleSet& before, const ParticleSet& after, double farthest)
{
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
        expect_at_most("farthest move in a frame", (after[i].position - before[i].position).norm(),
                       farthest + 2 * 8 * 0x1p-24);
}

// What outgrew a smaller maximum is split in a sweep of eight frames, so that no frame bears it all.
TEST(SlodStability, S12_ARegionThatBreathesOrJumpsMovesNothingAndSpreadsItsWork)
{
    constexpr std::uint64_t count = 2000;
    SimulationSettings settings = rigid_settings(32);
    settings.regions = {ball_region("pulse", {0, 0, 0}, 1, 2)};
    Simulation simulation(settings, ball(count, 2, 0.5, 1), {});
    Random random(12, 0, 0);
    for (int frame = 0; frame < 600; ++frame) {
        RegionOfInterest pulse = settings.regions[0];
        pulse.radius = 2 * std::abs(std::sin(0.2 * frame));
        if (frame >= 300)
            pulse.centre = random_point(random, 2);
        ASSERT_EQ(simulation.change_region(pulse), Problems{});
        const ParticleSet before = simulation.particles();
        const FrameCounts counts = simulation.step({}).counts;
        ASSERT_NO_FATAL_FAILURE(expect_no_jumps(before, simulation.particles(), 0.5 * settings.time.step))
            << "frame " << frame;
        expect_at_most("members formed anew in a frame, of 2000", double(counts.reformed_members), count / 4);
    }
    EXPECT_EQ(simulation.problems(), Problems{});
}

TEST(SlodStability, S13_ParametersThatChangeEveryFrameDoNoHarm)
{
    constexpr std::uint64_t count = 2000;
    SimulationSettings settings = rigid_settings(256);
    settings.background.max_breadth = 2;
    Simulation simulation(settings, ball(count, 2, 1, 1), {});
    const auto momentum = [&] { return simulation.snapshot({.conserved = true}).conserved.momentum; };
    const Vector3d before = momentum();
    for (int frame = 0; frame < 300; ++frame) {
        RegionOfInterest background = simulation.regions().back().settings;
        background.partition.max_cluster_size = frame % 2 == 0 ? 1 : 256;
        background.partition.max_breadth = frame % 3 == 0 ? 0.5 : 2;
        ASSERT_EQ(simulation.change_region(background), Problems{});
        expect_at_most("members formed anew in a frame, of 2000",
                       double(simulation.step({}).counts.reformed_members), count);
        ASSERT_EQ(simulation.problems(), Problems{}) << "frame " << frame;
    }
    expect_at_most("change of the momentum per particle", (momentum() - before).norm() / count, 1e-12);
    EXPECT_EQ(simulation.particles().size(), count);
}

/// Boundary tests per cluster and frame where `count` regions of radius 1, one to a volume of 216, or of 0.1
/// to 10, one to as many times more as their radii's mean cube of 72, are strewn.
double tests_per_cluster(std::uint64_t count, bool of_all_sizes)
{
    Random random(14, 0, 0);
    const double extent = 3 * std::cbrt(double(count) * (of_all_sizes ? 72 : 1));
    SimulationSettings settings = rigid_settings(4);
    settings.background.max_breadth = of_all_sizes ? 8 : 2;
    for (std::uint64_t i = 0; i < count; ++i) {
        const double radius = of_all_sizes ? std::pow(10.0, 2 * (double(i) + 0.5) / double(count) - 1) : 1;
        settings.regions.push_back(
            ball_region("region-" + std::to_string(i), random_point(random, extent), radius, 2));
    }
    Simulation simulation(settings, ball(4000, extent, 1, 1), {});
    std::uint64_t tests = 0, clusters = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const FrameCounts counts = simulation.step({}).counts;
        tests += counts.boundary_tests;
        clusters += counts.clusters;
    }
    return double(tests) / double(clusters);
}

TEST(SlodStability, S14_AThousandRegionsCostNoMoreThanTwiceWhatTenDo)
{
    const double few = tests_per_cluster(10, false), many = tests_per_cluster(1000, false);
    EXPECT_GT(few, 0);
    expect_at_most("questions per cluster among 1000 regions over those among 10", many / few, 2);
}

// Where sizes differ by a factor of 100 ten regions are too few to compare with.
TEST(SlodStability, S14_AThousandRegionsOfAllSizesCostNoMoreThanTwiceWhatAThousandOfOneSizeDo)
{
    const double alike = tests_per_cluster(1000, false), of_all_sizes = tests_per_cluster(1000, true);
    expect_at_most("questions per cluster among 1000 of all sizes over those of one size",
                   of_all_sizes / alike, 2);
    report_value("questions per cluster among 1000 of one size", alike);
}

TEST(SlodStability, S15_OfEqualRegionsTheEarlierOneTakesAll)
{
    SimulationSettings settings = rigid_settings(16);
    settings.regions = {ball_region("first", {0, 0, 0}, 1, 4), ball_region("second", {0, 0, 0}, 1, 4)};
    Simulation simulation(settings, ball(1000, 1, 0.01, 1), {});
    const auto held_by = [&](const char* name) {
        return load_of(simulation, run(simulation, 4), name).particles;
    };
    EXPECT_EQ(simulation.regions().front().settings.name, "first");
    expect_at_least("particles of 1000 in the earlier region", double(held_by("first")), 901);
    expect_at_most("particles of 1000 in the later region", double(held_by("second")), 0);
    ASSERT_EQ(simulation.remove_region("first"), Problems{});
    expect_at_least("particles in the later region without the earlier one", double(held_by("second")), 901);
    ASSERT_EQ(simulation.add_region(settings.regions[0]), Problems{});
    EXPECT_EQ(held_by("first"), 0U) << "the later one";
}

TEST(SlodStability, S16_WhatADeletedRegionHeldIsAdoptedAtOnce)
{
    constexpr std::uint64_t count = 100'000;
    SimulationSettings settings = rigid_settings(64);
    settings.regions = {ball_region("crowded", {0, 0, 0}, 4, 8)};
    Simulation simulation(settings, ball(count, 4, 0, 1), {});
    EXPECT_EQ(load_of(simulation, simulation.step({}), "crowded").particles, count);
    ASSERT_EQ(simulation.remove_region("crowded"), Problems{});
    const Snapshot& snapshot = simulation.step({});
    ASSERT_EQ(snapshot.regions.size(), 1U);
    expect_within("particles adopted in the next frame", double(snapshot.regions[0].particles), count, count);
    // Its clusters of 8 flood leaves of at most 1.4 * 4 * 64 members, which are divided at once: each looks
    // at no more than the others of its leaf, in the three turns until they are merged to 64, fewer each
    // time.
    std::uint64_t pair_tests = snapshot.counts.pair_tests;
    for (int frame = 0; frame < 48; ++frame)
        pair_tests += simulation.step({}).counts.pair_tests;
    expect_at_most("pairs looked at in the next 48 frames", double(pair_tests), count / 8 * 45 * 2);
    EXPECT_GT(pair_tests, 0U);
    EXPECT_EQ(simulation.problems(), Problems{});
}

// In exact flow without regions clusters change pools in turns; those of a region that closes do not wait.
TEST(SlodStability, S16_ItIsSoWhereClustersChangePoolsInTurnsToo)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 64;
    Simulation simulation(settings, ball(5000, 4, 1, 1), {});
    run(simulation, 40);
    ASSERT_EQ(simulation.add_region(ball_region("crowded", {0, 0, 0}, 2, 8)), Problems{});
    run(simulation, 40);
    ASSERT_GT(load_of(simulation, simulation.snapshot({}), "crowded").particles, 100U);
    ASSERT_EQ(simulation.remove_region("crowded"), Problems{});
    std::size_t left = 0;
    for (const std::uint16_t region : simulation.step({.clusters = true}).clusters.region)
        left += region == background_row ? 0 : 1;
    expect_at_most("clusters left in the next frame where pools are changed in turns", double(left), 0);
}

} // namespace
} // namespace slod::test
