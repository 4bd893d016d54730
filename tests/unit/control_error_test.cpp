#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "control/controller.hpp"
#include "support/plant.hpp"

// What holds an error, on a plant whose clusters give errors that go with a power of their size.
namespace slod::test {
namespace {

constexpr double target_ms = 26;
constexpr std::uint64_t seeds = 4; ///< of errors drawn, where chance decides

struct ErrorPlant {
    Plant plant{.cost_ms = 0.005};
    double error_at_64 = 0.02; ///< median
    double power = 0.6;        ///< of the size, in the error
    double spread = 1;         ///< of the logarithm of the errors
    int samples = 12;          ///< a frame
    int late = 5;              ///< frames until they are known
    std::uint64_t drawn = 0;

    double size() const { return plant.particles / plant.clusters; }
    double jump_at = 1e30; ///< size from which on errors are
    double jump = 1;       ///< so many times larger

    double median() const
    {
        return error_at_64 * std::pow(size() / 64, power) * (size() < jump_at ? 1 : jump);
    }

    std::vector<ErrorSample> draw()
    {
        std::vector<ErrorSample> errors;
        for (int i = 0; i < samples && plant.frames > std::uint64_t(late); ++i) {
            Random random(11, 3, drawn++);
            const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
            const double normal = radius * std::cos(2 * std::numbers::pi * random.uniform());
            errors.push_back({plant.frames - std::uint64_t(late), median() * std::exp(spread * normal)});
        }
        return errors;
    }
};

struct Outcome {
    double work_ms = 0; ///< of the last frame
    double held = 0;    ///< share of the last frames in which the median was within a fifth of the target
    double below = 0;   ///< share of them in which it was below
    double holding = 0; ///< share of them in which the controller said so
    int moves = 0;      ///< of the size in them
    ControlState state = ControlState::Off;
};

Outcome run(
    ErrorPlant& plant, const ControlSettings& settings, double frame_ms, int frames = 1500,
    const std::function<void(int)>& disturb = [](int) {}, int last = 300)
{
    const auto controller = make_controller(settings, {}, {});
    Detail detail;
    Outcome outcome;
    for (int frame = 0; frame < frames; ++frame) {
        disturb(frame);
        outcome.work_ms = plant.plant.run(detail);
        FrameWork told = plant.plant.told(outcome.work_ms, frame_ms);
        const std::vector<ErrorSample> errors = plant.draw();
        told.frame = plant.plant.frames;
        told.errors = errors;
        const Detail next = controller->next(told);
        const bool moved = !(std::exchange(detail, next) == next);
        outcome.state = controller->state();
        if (frame < frames - last)
            continue;
        outcome.moves += moved ? 1 : 0;
        outcome.held += std::abs(plant.median() / settings.target_error - 1) < 0.2 ? 1.0 / last : 0;
        outcome.below += plant.median() < settings.target_error ? 1.0 / last : 0;
        outcome.holding += outcome.state == ControlState::Holding ? 1.0 / last : 0;
    }
    return outcome;
}

ControlSettings holding(double error, ControlPriority priority = ControlPriority::FrameRate)
{
    return {.mode = ControlMode::Error, .target_error = error, .priority = priority};
}

TEST(ErrorControl, BringsTheMedianWithinAFifthOfTheTarget)
{
    for (const double power : {0.3, 0.6, 1.2})
        for (const double spread : {0.3, 1.0})
            for (const double target : {0.008, 0.02, 0.03}) {
                SCOPED_TRACE(testing::Message()
                             << "power " << power << " spread " << spread << " target " << target);
                ErrorPlant plant{.power = power, .spread = spread};
                const Outcome outcome = run(plant, holding(target, ControlPriority::Error), target_ms);
                EXPECT_GE(outcome.held, 0.95);
                EXPECT_GE(outcome.holding, 0.5);
            }
}

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

TEST(ErrorControl, KeepsTheErrorBelowATargetThatItJumpsOver)
{
    double below = 0, holding_share = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        ErrorPlant plant{.drawn = seed << 32, .jump_at = 30, .jump = 3}; // from 0.0127 to 0.038
        double least = 1e30, most = 0;
        const Outcome outcome = run(
            plant, holding(0.02, ControlPriority::Error), target_ms, 6000,
            [&](int frame) {
                least = frame > 1000 ? std::min(least, plant.size()) : least;
                most = frame > 1000 ? std::max(most, plant.size()) : most;
            },
            5000);
        EXPECT_GT(least, 28);
        EXPECT_LT(most, 32);
        below += outcome.below / double(seeds);
        holding_share += outcome.holding / double(seeds);
    }
    EXPECT_GT(below, 0.95);
    EXPECT_GT(holding_share, 0.93);
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
        for (int frame = 0; frame < frames; ++frame) {
            FrameWork told = plant.plant.told(plant.plant.run(detail), target_ms);
            const std::vector<ErrorSample> errors = plant.draw();
            told.frame = plant.plant.frames;
            told.errors = errors;
            detail = controller->next(told);
        }
    };
    run_frames(2000);
    EXPECT_EQ(controller->state(), ControlState::Holding);
    EXPECT_LT(plant.size(), 30);
    plant.jump = 1;
    controller->set_scope({.regions = 2});
    run_frames(400); // less than it takes until the jump is tried again
    EXPECT_NEAR(plant.median() / 0.02, 1, 0.2);
}

TEST(ErrorControl, RestsOnceItIsThere)
{
    ErrorPlant plant;
    EXPECT_EQ(run(plant, holding(0.01, ControlPriority::Error), target_ms, 3000).moves, 0);
}

TEST(ErrorControl, MakesNothingFinerThanTheErrorAsks)
{
    ErrorPlant plant; // for which the frame rate alone would have clusters of 13
    const Outcome outcome = run(plant, holding(0.015), target_ms);
    EXPECT_NEAR(plant.median() / 0.015, 1, 0.2);
    EXPECT_LT(outcome.work_ms, 0.6 * target_ms);
    EXPECT_EQ(outcome.state, ControlState::Holding);
}

TEST(ErrorControl, GivesUpTheTargetThatDoesNotGoFirst)
{
    ErrorPlant yielding;
    const Outcome rate_first = run(yielding, holding(0.003), target_ms);
    EXPECT_NEAR(rate_first.work_ms / target_ms, 1, 0.05);
    EXPECT_GT(yielding.median(), 1.5 * 0.003);
    EXPECT_EQ(rate_first.state, ControlState::Yielding);

    ErrorPlant insisting;
    const Outcome error_first = run(insisting, holding(0.003, ControlPriority::Error), target_ms);
    EXPECT_NEAR(insisting.median() / 0.003, 1, 0.2);
    EXPECT_GT(error_first.work_ms, 1.5 * target_ms);
    EXPECT_EQ(error_first.state, ControlState::Holding);
}

TEST(ErrorControl, LetsClustersGrowWhereThereIsNoErrorAtAll)
{
    ErrorPlant plant{.error_at_64 = 0};
    const Outcome outcome = run(plant, holding(0.01, ControlPriority::Error), target_ms);
    EXPECT_EQ(outcome.state, ControlState::Holding);
    EXPECT_NEAR(plant.size(), ControlSettings{}.largest_cluster_size, 0.01 * plant.size());
}

TEST(ErrorControl, SaysWhenTheFinestIsNotAccurateEnough)
{
    ErrorPlant plant{.power = 0.3};
    const Outcome outcome = run(plant, holding(1e-4, ControlPriority::Error), target_ms, 3000);
    EXPECT_NEAR(plant.size(), 1, 0.01);
    EXPECT_EQ(outcome.state, ControlState::Unreachable);
}

// As another controller may have left them: what they make of error would be made good by smaller clusters.
TEST(ErrorControl, TurnsFurtherLeversBackWhereTheErrorGoesFirst)
{
    const Detail left{.cluster_size = 4, .breadth = 4, .opening = 4, .life = 2};
    const ControlScope all{.opening = true, .life = true, .breadth = true};
    const auto controller = make_controller(holding(0.02, ControlPriority::Error), all, left);
    ErrorPlant plant;
    Detail detail = left;
    for (int frame = 0; frame < 600; ++frame)
        detail = controller->next(plant.plant.told(plant.plant.run(detail), target_ms));
    EXPECT_EQ(detail.opening, 1);
    EXPECT_EQ(detail.life, 1);
    EXPECT_EQ(detail.breadth, 1);
}

// As where particles come in bursts: clusters come and go by themselves, and none of their turns ends.
TEST(ErrorControl, HoldsItThoughTheNumberOfClustersIsNeverStill)
{
    ErrorPlant plant;
    const Outcome outcome =
        run(plant, holding(0.015, ControlPriority::Error), target_ms, 4000,
            [&](int frame) { plant.plant.particles *= frame % 20 < 10 ? 1.04 : 1 / 1.04; });
    EXPECT_NEAR(plant.median() / 0.015, 1, 0.25);
    EXPECT_EQ(outcome.state, ControlState::Holding);
}

TEST(ErrorControl, WithoutSamplesKeepsTheSize)
{
    ErrorPlant plant{.samples = 0};
    run(plant, holding(1e-4, ControlPriority::Error), target_ms);
    EXPECT_NEAR(plant.size(), 64, 1);
}

} // namespace
} // namespace slod::test
