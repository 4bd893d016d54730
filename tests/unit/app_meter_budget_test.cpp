#include <algorithm>

#include <gtest/gtest.h>

#include "app/meter_budget.hpp"

namespace slod {
namespace {

/// Frames and a meter in place of a server: blocks of work that are begun while any pairs are allowed.
struct MeteredFrames {
    double frame_ms = 10;
    double pairs_per_ms = 1e6;
    double begin_ms = 0;          ///< of the pass that every eighth frame with any pairs begins
    std::uint64_t block = 20'000; ///< pairs
    double work_ms = 0, meter_ms = 0;
    std::uint64_t passes = 0;

    void run(MeterBudget& budget, const MeterSettings& settings, int frames)
    {
        for (int frame = 0; frame < frames; ++frame) {
            const std::uint64_t allowed = budget.pairs(settings);
            const std::uint64_t pairs = (allowed + block - 1) / block * block;
            const double took =
                double(pairs) / pairs_per_ms + (allowed > 0 && passes++ % 8 == 0 ? begin_ms : 0);
            budget.add(settings, frame_ms + took, took, pairs);
            work_ms += frame_ms + took;
            meter_ms += took;
        }
    }
};

TEST(MeterBudget, GivesTheMeterItsShareWhateverItsPassesCost)
{
    for (const double begin_ms : {0.0, 0.5, 5.0, 40.0})
        for (const double pairs_per_ms : {1e5, 1e6, 4e6})
            for (const double share : {0.005, 0.02, 0.2}) {
                SCOPED_TRACE(testing::Message() << begin_ms << " ms, " << pairs_per_ms << " a ms, " << share);
                MeterBudget budget;
                MeteredFrames frames{.pairs_per_ms = pairs_per_ms, .begin_ms = begin_ms};
                frames.run(budget, {.share = share}, 20'000);
                EXPECT_NEAR(frames.meter_ms / frames.work_ms, share, 0.02 * share + 1e-5 * begin_ms);
            }
}

TEST(MeterBudget, IsNothingWhereTheMeterIsSwitchedOff)
{
    MeterBudget budget;
    MeteredFrames frames;
    frames.run(budget, {.enabled = false}, 100);
    EXPECT_EQ(frames.meter_ms, 0);
}

// A server that was suspended, or whose clock jumped, must not make up for it at once.
TEST(MeterBudget, DoesNotSaveUpForLaterFrames)
{
    MeterBudget budget;
    MeteredFrames frames;
    frames.run(budget, {}, 100);
    budget.add({}, 1e6, 0, 0);
    budget.add({}, frames.frame_ms, 0, 0);
    EXPECT_LE(double(budget.pairs({})), 8 * 0.02 * frames.frame_ms * frames.pairs_per_ms * 1.01);
}

} // namespace
} // namespace slod
