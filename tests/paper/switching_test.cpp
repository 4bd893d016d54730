#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/drifting_cloud.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"
#include "tree/detail.hpp"

/// O'Brien et al. 2001, section 5.2: how clusters follow another level of detail.

namespace slod::test {
namespace {

/// What a frame costs where times are not to be trusted: each cluster one, each member formed anew a tenth.
double work_of(const Snapshot& snapshot)
{
    return double(snapshot.counts.clusters) + 0.1 * double(snapshot.counts.reformed_members);
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

TEST(Paper, A52_NoFrameOfASmoothSwitchWorksMuchMoreThanTheOthers)
{
    Simulation simulation = drifting_cloud(64);
    Detail detail{.dithered = true};
    std::vector<double> works;
    for (int frame = 0; frame < 200; ++frame) {
        detail.cluster_size = std::exp(-0.03 * std::min(frame, 40)); // to 0.3 in forty frames
        ASSERT_TRUE(simulation.set_detail(detail).empty());
        works.push_back(work_of(simulation.step({})));
    }
    std::vector<double> end(works.begin() + 100, works.end());
    EXPECT_GT(works.back(), 2 * works.front()); // it is a switch
    EXPECT_LT(*std::max_element(works.begin(), works.end()), 1.5 * median(end));
}

TEST(Paper, A54_ASmallerMaximumSizeIsReachedOverSeveralFrames)
{
    Simulation simulation = drifting_cloud(64);
    const Snapshot& start = simulation.step({});
    std::uint64_t before = start.counts.clusters;
    const std::uint64_t first = before;
    ASSERT_TRUE(simulation.set_detail({.cluster_size = 1.0 / 8}).empty());
    int rising = 0;
    for (int frame = 0; frame < 40; ++frame) {
        const Snapshot& now = simulation.step({});
        rising += now.counts.clusters > before;
        EXPECT_LE(double(now.counts.splits), 0.2 * double(before)) << frame;
        before = now.counts.clusters;
    }
    EXPECT_GE(rising, 5);
    EXPECT_GT(before, 4 * first);
    EXPECT_GE(before, 6000U / 8);
}

TEST(Paper, A57_AnotherBreadthPutsEveryClusterIntoCellsAnewOnce)
{
    Simulation simulation = drifting_cloud(64, 8);
    const std::uint64_t clusters = simulation.step({}).counts.clusters;
    EXPECT_EQ(simulation.snapshot({}).counts.reinserted, 0U);
    ASSERT_TRUE(simulation.set_detail({.breadth = 2}).empty());
    EXPECT_EQ(simulation.step({}).counts.reinserted, clusters);
    EXPECT_EQ(simulation.snapshot({}).regions.back().max_breadth, 16);
    for (int frame = 0; frame < 20; ++frame)
        EXPECT_EQ(simulation.step({}).counts.reinserted, 0U);
    EXPECT_TRUE(simulation.problems().empty());
}

TEST(Paper, A57_AnotherSizeAlonePutsNoClusterIntoCellsAnew)
{
    Simulation simulation = drifting_cloud(64);
    for (int frame = 0; frame < 20; ++frame) {
        ASSERT_TRUE(simulation.set_detail({.cluster_size = 1.0 / (1 + frame % 5)}).empty());
        EXPECT_EQ(simulation.step({}).counts.reinserted, 0U);
    }
}

double fastest(const ParticleSet& particles)
{
    double speed = 0;
    for (const Particle& particle : particles)
        speed = std::max(speed, particle.velocity.norm());
    return speed;
}

/// When clusters are formed anew every particle moves no further than by its own velocity, of before or after
/// the frame; a rigid cluster's than by that of the fastest. No tolerance is needed: rounding an offset is
/// less than the difference of the two velocities.
TEST(Paper, A52_SwitchingMovesNoParticle)
{
    for (const auto motion : {Motion::Flow, Motion::Stream, Motion::Rigid}) {
        SimulationSettings settings = windy(32);
        settings.background.max_breadth = 4;
        settings.motion.motion = motion;
        ParticleSet particles;
        add_cloud(particles, {.count = 2000}, 9);
        Simulation simulation(settings, particles, {});
        ParticleSet before = simulation.particles();
        std::uint64_t switched = 0;
        for (int frame = 0; frame < 60; ++frame) {
            const double factor = frame % 20 < 10 ? 0.125 : 4;
            ASSERT_TRUE(simulation.set_detail({.cluster_size = factor, .dithered = true}).empty());
            const FrameCounts& counts = simulation.step({}).counts;
            switched += counts.splits + counts.merges;
            const ParticleSet now = simulation.particles();
            for (std::size_t i = 0; i < now.size(); ++i) {
                // Rigid clusters move all members at their mean velocity.
                const double speed = motion == Motion::Rigid
                                         ? fastest(now)
                                         : std::max(now[i].velocity.norm(), before[i].velocity.norm());
                ASSERT_LE((now[i].position - before[i].position).norm(), speed * settings.time.step)
                    << "frame " << frame << " particle " << i;
            }
            before = now;
        }
        EXPECT_GT(switched, 100U);
    }
}

} // namespace
} // namespace slod::test
