#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/clouds.hpp"
#include "support/random_regions.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"

// O'Brien, Fisher, Lin 2001, section 4.3 and figure 3: which region takes what, and how that is found.
namespace slod::test {
namespace {

// Three boxes inside each other, and two that are equal; the outermost comes first in the list.
TEST(Paper, A33_TheFirstRegionInOrderOfPrecedenceTakesAndTheBackgroundTakesTheRest)
{
    SimulationSettings settings = rigid_settings(32);
    settings.regions = {
        box_region("outer", {0, 0, 0}, {3, 3, 3}, 16), box_region("middle", {0, 0, 0}, {2, 2, 2}, 8),
        box_region("inner", {0, 0, 0}, {1, 1, 1}, 2), box_region("same", {0, 0, 0}, {2, 2, 2}, 4)};
    settings.regions[1].precedence = settings.regions[3].precedence = 1;
    settings.regions[2].precedence = 2;
    ParticleSet particles = cube(4000, 4, 1);
    particles[0].position = {1e9, 1e9, 1e9};
    particles[1].position = {-1e300, 0, 0};
    Simulation simulation(settings, particles, {});
    const Snapshot& snapshot = run(simulation, 20);
    const std::vector<RegionRow> row_by_layer{3, 2, 1, 0}; // rows in order of the list, the background's 0
    for (std::size_t i = 0; i < snapshot.clusters.size(); ++i) {
        const double out = snapshot.clusters.position[i].cwiseAbs().maxCoeff();
        const auto layer = std::size_t(std::min(std::floor(out), 3.0));
        ASSERT_EQ(snapshot.clusters.region[i], row_by_layer[layer]) << "at " << out;
    }
    EXPECT_EQ(load_of(simulation, snapshot, "same").particles, 0U);
    std::vector<std::string> order;
    for (const Simulation::Region& region : simulation.regions())
        order.push_back(region.settings.name);
    EXPECT_EQ(order, (std::vector<std::string>{"inner", "middle", "same", "outer", "background"}));
}

// Up to eight regions are asked one after the other.
TEST(Paper, A34_TheMasterNodeAsksEachSubtreeInTurnUntilOneAccepts)
{
    std::vector<RegionIndex::Entry> entries;
    for (RegionRow row = 1; row <= 8; ++row)
        entries.push_back({row, RegionTest(ball_region("one", {3.0 * row, 0, 0}, 1, 4))});
    RegionIndex index;
    index.assign(entries);
    for (RegionRow row = 1; row <= 8; ++row) {
        std::uint64_t tests = 0;
        EXPECT_EQ(index.find(Vector3d(3.0 * row, 0.5, 0), &tests), row);
        EXPECT_EQ(tests, row);
    }
    std::uint64_t tests = 0;
    EXPECT_EQ(index.find(Vector3d(0, 50, 0), &tests), background_row);
    EXPECT_EQ(tests, 8U);
}

/// A tree of one cell, deep.
RigidWorld deep_world()
{
    const RigidRules rules{
        .background = {.max_cluster_size = 1, .pool_factor = 16}, .regions = {}, .cell_side = 16};
    return {rules, cube(60'000, 7.9, 1, {8, 8, 8})};
}

// Only a cluster that has left its leaf is searched for. A leaf's faces come from the splits above it, each
// along its longest side: three of them from the last three, and each other one from a split at least as far
// again up. So half of the moves climb three levels at most, and go as many down again, whatever the depth of
// the tree: seven nodes, which is less than half of a search from the top where that is deeper than these
// thirteen.
TEST(Paper, A35_BottomUpFindsWhatTopDownFindsWithFewerNodes)
{
    RigidWorld world = deep_world();
    const Subtree& tree = world.tree().subtrees.front();
    Random random(35, 0, 0);
    std::vector<std::uint64_t> up, down;
    for (int move = 0; move < 1'000'000; ++move) {
        const Vector3d x = Vector3d(8, 8, 8) + random_point(random, 7.9);
        const PoolId start = locate(tree, x);
        const Vector3d size = tree.nodes[tree.pools[start.index].node.index].box.size();
        const Vector3d to = x + 0.1 * size.maxCoeff() * Vector3d(random_point(random, 1));
        if (holds(tree, start, to))
            continue;
        std::uint64_t bottom_up = 0, top_down = 0;
        const PoolId found = locate(tree, to, &top_down);
        ASSERT_EQ(locate_near(tree, start, to, &bottom_up), found);
        up.push_back(bottom_up);
        down.push_back(top_down);
    }
    const auto median = [](std::vector<std::uint64_t>& counts) {
        std::nth_element(counts.begin(), counts.begin() + std::ptrdiff_t(counts.size() / 2), counts.end());
        return counts[counts.size() / 2];
    };
    EXPECT_GT(up.size(), 100'000U);
    EXPECT_LE(median(up), 7U);
    EXPECT_GE(median(down), 13U);
}

// The paper searches top-down now and then, as a climb alone stays in the background. Here each leaf knows
// whether another region reaches into it, so that no frame passes.
TEST(Paper, A36_AClusterThatDriftsIntoAnOverlaidRegionIsTransferredInThatFrame)
{
    SimulationSettings settings = rigid_settings(32);
    settings.background.max_breadth = 8;
    settings.regions = {ball_region("overlay", {5, 0, 0}, 2, 2)};
    ParticleSet particles = ball(200, 1, 0, 1);
    for (Particle& particle : particles)
        particle.velocity = {4, 0.1, 0};
    Simulation simulation(settings, particles, {});
    std::uint64_t most_inside = 0;
    for (int frame = 0; frame < 160; ++frame) {
        const Snapshot& snapshot = simulation.step({.clusters = true});
        ASSERT_EQ(clusters_in_wrong_regions(simulation, snapshot), 0U) << "frame " << frame;
        most_inside = std::max(most_inside, load_of(simulation, snapshot, "overlay").particles);
    }
    EXPECT_GT(most_inside, 190U);
    EXPECT_EQ(load_of(simulation, simulation.snapshot({}), "overlay").particles, 0U);
}

// A refused region changes nothing. Regions are asked then in leaves that a face cuts, and of clusters that
// leave theirs.
TEST(Paper, A37_WhereOverlapsAreForbiddenRegionsThatOverlapAreRefused)
{
    SimulationSettings settings = rigid_settings(8);
    settings.sharing.overlap = false;
    settings.regions = {box_region("left", {-1, 0, 0}, {1, 1, 1}, 4),
                        box_region("right", {1, 0, 0}, {1, 1, 1}, 4)};
    ASSERT_EQ(problems(settings), Problems{}) << "they share a face, which belongs to one of them";
    SimulationSettings overlapping = settings;
    overlapping.regions[1].centre.x() = 0.9;
    ASSERT_EQ(problems(overlapping).size(), 1U);
    EXPECT_NE(problems(overlapping)[0].find("region.1.shape overlaps that of region \"left\""),
              std::string::npos);

    Simulation simulation(settings, ball(300, 1, 0.2, 1), {});
    run(simulation, 5);
    const std::uint64_t before = simulation.state_hash();
    EXPECT_EQ(simulation.add_region(ball_region("ball", {0, 0, 0}, 0.5, 2)).size(), 2U);
    RegionOfInterest moved = settings.regions[0];
    moved.centre.x() = 0;
    EXPECT_EQ(simulation.change_region(moved).size(), 1U);
    EXPECT_EQ(simulation.state_hash(), before);
    EXPECT_EQ(simulation.add_region(ball_region("apart", {0, 0, 3}, 0.5, 2)), Problems{});
    moved.centre.x() = -3;
    EXPECT_EQ(simulation.change_region(moved), Problems{});
}

// No cluster is faster than the fastest particle, so none moves farther in a frame than that one; a particle
// that is formed anew is moved by a rounding to float of its offset, which is no longer than the cloud.
TEST(Paper, A38_RegionsMoveResizeAndChangeWhileTheSimulationRuns)
{
    constexpr std::uint64_t count = 3000;
    const double fastest = 1.5, rounding = 2 * 8 * 0x1p-24;
    SimulationSettings settings = rigid_settings(4);
    ParticleSet particles = ball(count, 2, 0.5, 1);
    for (Particle& particle : particles)
        particle.velocity.x() += 1;
    settings.regions = {box_region("coarse", {0, 0, 0}, {1, 1, 1}, 64)};
    Simulation simulation(settings, particles, {});
    for (int frame = 0; frame < 200; ++frame) {
        RegionOfInterest coarse = settings.regions[0];
        coarse.centre.x() = 0.02 * frame;
        coarse.half_extent *= 1 + 0.5 * std::sin(0.1 * frame);
        coarse.partition.max_cluster_size = frame % 50 < 25 ? 64 : 16;
        ASSERT_EQ(simulation.change_region(coarse), Problems{});
        const ParticleSet before = simulation.particles();
        const Snapshot& snapshot = simulation.step({.clusters = true});
        ASSERT_EQ(clusters_in_wrong_regions(simulation, snapshot), 0U) << "frame " << frame;
        const ParticleSet after = simulation.particles();
        ASSERT_EQ(after.size(), count);
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_LE((after[i].position - before[i].position).norm(),
                      fastest * settings.time.step + rounding)
                << "particle " << i << " in frame " << frame;
    }
    EXPECT_EQ(simulation.problems(), Problems{});
}

} // namespace
} // namespace slod::test
