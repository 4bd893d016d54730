#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/error_plant.hpp"

// How what holds an error looks for the size where it grows steeply, jumps, changes or is little known.
namespace slod::test {
namespace {

constexpr std::uint64_t seeds = 4; ///< of errors drawn, where chance decides

// As between single particles and pairs in a galaxy: a turn by the whole excess would go to and fro for ever.
TEST(ErrorControl, FindsTheSizeWhereErrorsGrowSteeply)
{
    for (const double power : {2.5, 4.0, 6.0}) {
        SCOPED_TRACE(power);
        double holding_share = 0;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            ErrorPlant plant{.power = power, .drawn = seed << 32};
            const Outcome outcome = run(
                plant, holding(0.012, ControlPriority::Error), target_ms, 3000, [](int) {}, 2000);
            EXPECT_GE(outcome.held, 0.95);
            holding_share += outcome.holding / double(seeds);
        }
        EXPECT_GE(holding_share, 0.95);
    }
}

/// The error is little below its target under the jump, or far.
TEST(ErrorControl, KeepsTheErrorBelowATargetThatItJumpsOver)
{
    constexpr double jump_at = 30;
    const std::vector<double> distances{0.1, 0.15, 0.2, 0.45}; // logarithms
    double below = 0, holding_share = 0;
    for (const double distance : distances)
        for (std::uint64_t seed = 0; seed < 2; ++seed) {
            ErrorPlant plant{.drawn = seed << 32, .jump_at = jump_at, .jump = 3};
            const double target = 0.02 * std::pow(jump_at / 64, plant.power) * std::exp(distance);
            double least = 1e30, most = 0;
            const Outcome outcome = run(
                plant, holding(target, ControlPriority::Error), target_ms, 6000,
                [&](int frame) {
                    least = frame > 1000 ? std::min(least, plant.size()) : least;
                    most = frame > 1000 ? std::max(most, plant.size()) : most;
                },
                5000);
            EXPECT_GT(least, 27) << distance;
            EXPECT_LT(most, 33) << distance;
            below += outcome.below / (2 * double(distances.size()));
            holding_share += outcome.holding / (2 * double(distances.size()));
        }
    EXPECT_GT(below, 0.95);
    EXPECT_GT(holding_share, 0.9);
}

TEST(ErrorControl, LooksAnewWhereWhatItJumpedOverIsGone)
{
    ErrorPlant plant{.jump_at = 30, .jump = 3};
    const Outcome outcome =
        run(plant, holding(0.02, ControlPriority::Error), target_ms, 8000, [&](int frame) {
            if (frame == 4000)
                plant.jump = 1; // the error of the size that it has stays as it is
        });
    EXPECT_NEAR(plant.median() / 0.02, 1, 0.2);
    EXPECT_EQ(outcome.state, ControlState::Holding);
}

// As while a galaxy settles: sizes that were judged too large at first are small enough by then.
TEST(ErrorControl, ForgetsWhatWasFoundBeforeErrorsFell)
{
    for (const int at : {100, 200, 300, 400, 500}) {
        SCOPED_TRACE(at);
        ErrorPlant plant{.error_at_64 = 0.08, .power = 0.3};
        const Outcome outcome = run(plant, holding(0.02, ControlPriority::Error), target_ms, 3000,
                                    [&](int frame) { plant.error_at_64 = frame < at ? 0.08 : 0.03; });
        EXPECT_GE(outcome.held, 0.95);
        EXPECT_EQ(outcome.state, ControlState::Holding);
    }
}

// Errors of other regions, and at another opening, say nothing of those there are now.
TEST(ErrorControl, ForgetsWhatWasFoundWithOtherRegions)
{
    ErrorPlant plant{.jump_at = 30, .jump = 3};
    const auto controller = make_controller(holding(0.02, ControlPriority::Error), {}, {});
    Detail detail;
    const auto run_frames = [&](int frames) {
        for (int frame = 0; frame < frames; ++frame)
            detail = run_frame(plant, *controller, detail);
    };
    run_frames(2000);
    EXPECT_EQ(controller->state(), ControlState::Holding);
    EXPECT_LT(plant.size(), 30);
    plant.jump = 1;
    controller->set_scope({.regions = 2});
    EXPECT_EQ(controller->state(), ControlState::Adjusting);
    run_frames(400); // less than it takes until the jump is tried again
    EXPECT_NEAR(plant.median() / 0.02, 1, 0.2);
}

TEST(ErrorControl, YieldsNothingToTheRateBeforeOtherRegionsAreJudged)
{
    ErrorPlant plant;
    const auto controller = make_controller(holding(0.003), {}, {});
    Detail detail;
    double work_ms = 0;
    for (int frame = 0; frame < 1500; ++frame)
        detail = run_frame(plant, *controller, detail, target_ms, work_ms);
    ASSERT_EQ(controller->state(), ControlState::Yielding);
    controller->set_scope({.regions = 2});
    run_frame(plant, *controller, detail, target_ms, work_ms);
    EXPECT_NE(controller->state(), ControlState::Yielding);
}

/// Frames until the size first moves.
int first_move(ErrorPlant plant, double target, int frames)
{
    const auto controller = make_controller(holding(target, ControlPriority::Error), {}, {});
    for (int frame = 0; frame < frames; ++frame)
        if (std::abs(run_frame(plant, *controller).cluster_size - 1) > 1e-3)
            return frame;
    return frames;
}

// 64 samples are enough where the error is far off, 256 where it is not.
TEST(ErrorControl, TurnsUponAsManySamplesAsItTakes)
{
    const int far = first_move({.samples = 2}, 0.005, 400), near = first_move({.samples = 2}, 0.015, 400);
    EXPECT_GE(far, 32);
    EXPECT_EQ(near - far, (256 - 64) / 2);
}

// As by a few samples of a burst.
TEST(ErrorControl, LeavesASizeThatIsHeldUponAWholeWindowAlone)
{
    ErrorPlant plant{.samples = 2};
    const auto controller = make_controller(holding(0.02, ControlPriority::Error), {}, {});
    int held_at = 0, moved_at = 0;
    for (int frame = 1; frame <= 800 && moved_at == 0; ++frame) {
        plant.error_at_64 = held_at == 0 ? 0.02 : 0.2;
        moved_at = std::abs(run_frame(plant, *controller).cluster_size - 1) > 1e-3 ? frame : 0;
        held_at = held_at == 0 && controller->state() == ControlState::Holding ? frame : held_at;
    }
    EXPECT_GT(held_at, 128);
    EXPECT_GT(moved_at, 512);
}

} // namespace
} // namespace slod::test
