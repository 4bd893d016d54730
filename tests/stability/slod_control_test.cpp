#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "control/controller.hpp"
#include "core/random.hpp"
#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/drifting_cloud.hpp"

// A controller and the tree together: the work of a frame is the number of its clusters, in place of a time.
namespace slod::test {
namespace {

/// What a controlled run was like after it had time to settle.
struct Settled {
    double rms;    ///< of the relative error of the measured work, from frame 250 on
    double events; ///< splits and merges per cluster and frame, from frame 60 on
    double moves;  ///< changes of the maximum size per frame, from frame 250 on
};

constexpr double noise_rms = 0.05;

Settled settle(ControlMode mode, double target, double noise)
{
    Simulation simulation = drifting_cloud(64);
    const auto controller = make_controller({.mode = mode}, {}, {});
    constexpr int frames = 400, calm = 60, settling = 250;
    Settled settled{};
    for (int frame = 0; frame < frames; ++frame) {
        const FrameCounts counts = simulation.step({}).counts;
        // Uniform within sqrt(3) of it: that root mean square.
        const double error = noise * std::sqrt(3.0) * (2 * Random(3, 1, std::uint64_t(frame)).uniform() - 1);
        const double work = (1 + error) * double(counts.clusters);
        const Detail next = controller->next({work, target, counts.particles, counts.clusters});
        if (frame >= calm)
            settled.events +=
                double(counts.splits + counts.merges) / double(counts.clusters) / (frames - calm);
        if (frame >= settling) {
            settled.rms += std::pow(work / target - 1, 2) / (frames - settling);
            settled.moves += (next == simulation.detail() ? 0.0 : 1.0) / (frames - settling);
        }
        EXPECT_TRUE(simulation.set_detail(next).empty());
    }
    EXPECT_EQ(simulation.problems(), Problems{});
    settled.rms = std::sqrt(settled.rms);
    return settled;
}

TEST(SlodStability, S06_ClustersComeToRestUnderTheSmoothController)
{
    for (const double target : {80.0, 200.0, 300.0, 1000.0}) {
        for (const double noise : {0.0, noise_rms}) {
            SCOPED_TRACE("target " + std::to_string(target) + " noise " + std::to_string(noise));
            const Settled settled = settle(ControlMode::Smooth, target, noise);
            expect_at_most("splits and merges per cluster and frame", settled.events, 0.01);
            // What has come to rest moves only above an error of 0.04.
            expect_at_most("rms of the work's error above the noise", settled.rms - noise, 0.04);
            if (noise == 0)
                expect_at_most("changes of the size per frame without noise", settled.moves, 0);
        }
    }
}

TEST(SlodStability, S06_UnderThePapersRuleTheySplitAndMergeForEver)
{
    const Settled settled = settle(ControlMode::Paper, 300, 0);
    expect_at_least("changes of the size per frame by the paper's rule", settled.moves, 0.5);
    // One in each frame.
    expect_at_least("splits and merges per cluster and frame by the paper's rule", settled.events, 0.003);
}

TEST(SlodStability, S13_ASizeThatIsToggledEveryFrameChangesFewClusters)
{
    Simulation simulation = drifting_cloud(16);
    const ConservedQuantities start = simulation.snapshot({.conserved = true}).conserved;
    for (int frame = 0; frame < 200; ++frame) {
        const double size = frame % 2 == 0 ? 1 : 256;
        ASSERT_TRUE(simulation.set_detail({.cluster_size = size / 16, .dithered = true}).empty());
        const Snapshot& now = simulation.step({.conserved = true});
        // A sweep of eight frames, every other of which asks for it; merges look at a sixteenth of the pools.
        expect_at_most("splits and merges of 6000 particles in a frame",
                       double(now.counts.splits + now.counts.merges), 0.2 * 6000);
        expect_at_most("change of the mass", std::abs(now.conserved.mass - start.mass), 1e-12);
        expect_at_most("change of the momentum", (now.conserved.momentum - start.momentum).norm(), 1e-12);
    }
    EXPECT_EQ(simulation.problems(), Problems{});
}

TEST(SlodStability, S13_ABreadthThatIsToggledEveryFrameLosesNothing)
{
    Simulation simulation = drifting_cloud(16, 8);
    const ConservedQuantities start = simulation.snapshot({.conserved = true}).conserved;
    for (int frame = 0; frame < 100; ++frame) {
        ASSERT_TRUE(simulation.set_detail({.breadth = frame % 2 == 0 ? 4.0 : 1.0, .dithered = true}).empty());
        const Snapshot& now = simulation.step({.conserved = true});
        expect_at_most("change of the mass", std::abs(now.conserved.mass - start.mass), 1e-12);
        expect_at_most("change of the momentum", (now.conserved.momentum - start.momentum).norm(), 1e-12);
    }
    EXPECT_EQ(simulation.particles().size(), 6000U);
    EXPECT_EQ(simulation.problems(), Problems{});
}

} // namespace
} // namespace slod::test
