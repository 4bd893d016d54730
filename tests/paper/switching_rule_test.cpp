#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "control/controller.hpp"
#include "control/paper_controller.hpp"
#include "tree/detail.hpp"

/// O'Brien et al. 2001, sections 5.2 and 6.1: the rule by which the maximum cluster size follows the frame
/// rate, on sequences of work that were written down.

namespace slod {
namespace {

std::unique_ptr<Controller> paper(const ControlScope& scope = {}, const Detail& detail = {},
                                  const ControlSettings& bounds = {})
{
    ControlSettings settings = bounds;
    settings.mode = ControlMode::Paper;
    return make_controller(settings, scope, detail);
}

/// Maximum sizes of a region of 64 after each of the frames.
std::vector<double> sizes(Controller& controller, const std::vector<double>& works, double target_ms)
{
    std::vector<double> all;
    for (const double work : works)
        all.push_back(at_detail({}, controller.next({work, target_ms, 6000, 100})).max_cluster_size);
    return all;
}

TEST(Paper, A52_TheRuleActsOnlyWhereTheRateDeviates)
{
    const auto controller = paper();
    for (const double size : sizes(*controller, std::vector<double>(20, 10.0), 10))
        EXPECT_EQ(size, 64);
    EXPECT_EQ(controller->state(), ControlState::Holding);
}

TEST(Paper, A53_SizesFallWhereTheRateIsAboveTheTargetAndRiseWhereItIsBelow)
{
    for (const double work : {5.0, 20.0}) {
        const ControlScope several{.least_size = 4, .most_size = 100, .regions = 3};
        const auto controller = paper(several);
        Detail detail;
        for (int frame = 0; frame < 6; ++frame)
            detail = controller->next({work, 10, 6000, 100});
        for (const double size : {4.0, 20.0, 100.0}) {
            const double now = at_detail({.max_cluster_size = size}, detail).max_cluster_size;
            EXPECT_TRUE(work > 10 ? now > size : now < size) << size << " became " << now;
        }
    }
}

/// Sliding means of three: 10 10 10 | 11 | 12 | 11 | 10 | 9 | 8 ... against a target of 10.
TEST(Paper, A55_TheSizeGoesByOneOnTheMeanOfThreeFrames)
{
    const auto controller = paper();
    const std::vector<double> works{10, 10, 10, 13, 13, 7, 10, 10, 4, 10, 16, 10, 1};
    const std::vector<double> golden{64, 64, 64, 65, 66, 67, 67, 66, 65, 64, 64, 65, 64};
    EXPECT_EQ(sizes(*controller, works, 10), golden);
}

TEST(Paper, A55_AFrameWithoutATimeIsLeftOutOfTheMean)
{
    const auto controller = paper();
    const double none = std::nan("");
    EXPECT_EQ(sizes(*controller, {13, 13, none, -1, 0, 13, 13}, 10),
              (std::vector<double>{64, 64, 64, 64, 64, 65, 66}));
}

TEST(Paper, A56_TheSizesOfSeveralRegionsGoByTheSamePercent)
{
    const std::array<double, 3> sizes{4, 20, 100};
    const ControlScope several{.least_size = 4, .most_size = 100, .regions = 3};
    const auto controller = paper(several, {}, {.largest_cluster_size = 1e6});
    Detail detail;
    for (int frame = 0; frame < 12; ++frame) // ten of them with a mean
        detail = controller->next({20, 10, 6000, 100});
    std::array<double, 3> now{};
    for (std::size_t i = 0; i < 3; ++i)
        now[i] = at_detail({.max_cluster_size = sizes[i]}, detail).max_cluster_size;
    EXPECT_NEAR(now[0], 4 * std::pow(1 + PaperController::percent / 100, 10), 1e-9);
    EXPECT_NEAR(now[1] / now[0], 5, 0.02 * 5);
    EXPECT_NEAR(now[2] / now[1], 5, 0.02 * 5);
}

TEST(Paper, A56_ARegionWithItsOwnControlShareFollowsToThatExtent)
{
    const Detail detail{.cluster_size = 4};
    EXPECT_EQ(at_detail({.max_cluster_size = 8, .control_share = 0}, detail).max_cluster_size, 8);
    EXPECT_NEAR(at_detail({.max_cluster_size = 8, .control_share = 0.5}, detail).max_cluster_size, 16, 1e-9);
    EXPECT_EQ(at_detail({.max_cluster_size = 8}, detail).max_cluster_size, 32);
}

TEST(Paper, A57_TheBreadthDoublesAfterFiveStepsInVainAtTheLargestSize)
{
    const auto controller = paper({.breadth = true}, {}, {.largest_cluster_size = 66});
    std::vector<double> breadths;
    for (int frame = 0; frame < 20; ++frame)
        breadths.push_back(controller->next({20, 10, 6000, 100}).breadth);
    // Two frames without a mean, two to the largest size, five in vain.
    for (int frame = 0; frame < 8; ++frame)
        EXPECT_EQ(breadths[std::size_t(frame)], 1) << frame;
    EXPECT_EQ(breadths[8], 2);
    EXPECT_EQ(breadths[12], 2);
    EXPECT_EQ(breadths[13], 4);
    EXPECT_EQ(breadths[19], 4); // its bound
    EXPECT_EQ(controller->state(), ControlState::Unreachable);
}

TEST(Paper, A63_TheSizeStaysWithinItsBounds)
{
    const auto coarse = paper({}, {}, {.smallest_cluster_size = 4, .largest_cluster_size = 70});
    EXPECT_EQ(sizes(*coarse, std::vector<double>(100, 20.0), 10).back(), 70);
    const auto fine = paper({}, {}, {.smallest_cluster_size = 4, .largest_cluster_size = 70});
    EXPECT_EQ(sizes(*fine, std::vector<double>(100, 5.0), 10).back(), 4);
    EXPECT_EQ(fine->state(), ControlState::Finest);
}

/// The paper's rule on a plant of 6,000 particles whose work is its clusters, and which follows at once.
TEST(Paper, A55_TheRuleNeverComesToRest)
{
    const auto controller = paper();
    Detail detail;
    int moves = 0;
    double before = 64;
    for (int frame = 0; frame < 600; ++frame) {
        const double size = at_detail({}, detail).max_cluster_size;
        detail = controller->next({6000 / std::floor(size), 130, 6000, 100});
        moves += frame >= 300 && size != before;
        before = size;
    }
    EXPECT_GT(moves, 150);
}

} // namespace
} // namespace slod
