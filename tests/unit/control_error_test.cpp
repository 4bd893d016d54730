#include <cmath>

#include <gtest/gtest.h>

#include "support/error_plant.hpp"

// What holds an error, on a plant whose clusters give errors that go with a power of their size.
namespace slod::test {
namespace {

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
