#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "support/case_rows.hpp"

namespace slod {
namespace {

class ParallelOnThreads : public testing::TestWithParam<int> {
protected:
    ThreadTeam team{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, ParallelOnThreads, testing::Values(1, 2, 3, 8));

TEST_P(ParallelOnThreads, ForEachBlockVisitsEveryIndexOnce)
{
    team.run([] {
        for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 1000U, 4096U, 10'001U}) {
            std::vector<int> visits(count, 0);
            for_each_block(count, 8, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<int>(count, 1)) << "count " << count;
        }
    });
}

TEST_P(ParallelOnThreads, ForEachBlockCutsAtMultiplesOfTheBlock)
{
    team.run([] {
        std::vector<std::pair<std::size_t, std::size_t>> blocks(block_count(1000, 64));
        for_each_block(1000, 64, [&](std::size_t first, std::size_t last) {
            blocks[first / 64] = {first, last};
        });
        ASSERT_EQ(blocks.size(), 16U);
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_EQ(blocks[i], std::pair(64 * i, std::min<std::size_t>(64 * i + 64, 1000)));
    });
}

TEST_P(ParallelOnThreads, ForEachTaskVisitsEveryIndexOnceWhenNested)
{
    team.run([] {
        std::vector<int> visits(40 * 50, 0);
        for_each_task(40, [&](std::size_t outer) {
            for_each_task(50, [&](std::size_t inner) { ++visits[50 * outer + inner]; });
        });
        EXPECT_EQ(visits, std::vector<int>(40 * 50, 1));
    });
}

TEST_P(ParallelOnThreads, RunBothRunsBoth)
{
    team.run([] {
        int first = 0, second = 0;
        run_both([&] { ++first; }, [&] { ++second; });
        EXPECT_EQ(std::pair(first, second), std::pair(1, 1));
    });
}

// All of a team's threads must be inside the body at once for any of them to leave it. A team that was
// capped at the number of cores would wait here for ever: then the test runs into its time limit.
TEST_P(ParallelOnThreads, TheTeamHasThatManyThreads)
{
    team.run([] {
        std::atomic<int> inside{0};
        for_each_task(std::size_t(GetParam()), [&](std::size_t) {
            ++inside;
            while (inside < GetParam())
                std::this_thread::yield();
        });
        EXPECT_EQ(inside, GetParam());
    });
}

// Half of the smallest normal number, computed at run time.
double half_of_the_smallest()
{
    volatile double smallest = std::numeric_limits<double>::min();
    return smallest / 2;
}

TEST(FlushDenormals, N02_FlushesWhileItLivesAndThenRestores)
{
    ASSERT_GT(half_of_the_smallest(), 0);
    {
        const FlushDenormals flush;
        EXPECT_EQ(half_of_the_smallest(), 0);
        {
            const FlushDenormals again;
            EXPECT_EQ(half_of_the_smallest(), 0);
        }
        EXPECT_EQ(half_of_the_smallest(), 0);
        test::expect_at_most("denormal results while flushing", half_of_the_smallest() > 0 ? 1 : 0, 0);
    }
    test::expect_at_least("half of the smallest number afterwards", half_of_the_smallest(),
                          std::numeric_limits<double>::denorm_min());
}

TEST(FlushDenormals, TakesDenormalsThatExistAlreadyForZero)
{
    volatile double tiny = std::numeric_limits<double>::denorm_min();
    ASSERT_GT(tiny * 0x1p60, 0);
    const FlushDenormals flush;
    EXPECT_EQ(tiny * 0x1p60, 0);
}

TEST_P(ParallelOnThreads, N02_TasksFlushDenormalsAndTheCallerGoesOnAsBefore)
{
    team.run([] {
        const unsigned before = _mm_getcsr();
        std::vector<double> halves(64, 1);
        for_each_task(halves.size(), [&](std::size_t i) { halves[i] = half_of_the_smallest(); });
        test::expect_at_most(
            "tasks that did not flush",
            double(std::count_if(halves.begin(), halves.end(), [](double half) { return half != 0; })), 0);
        double first = 1, second = 1;
        run_both([&] { first = half_of_the_smallest(); }, [&] { second = half_of_the_smallest(); });
        EXPECT_EQ(std::pair(first, second), std::pair(0.0, 0.0));
        // The sticky flags of exceptions, the lowest six bits, are no setting.
        test::expect_at_most("changed bits of the caller's control register",
                             std::popcount((before ^ _mm_getcsr()) & ~0x3fU), 0);
        EXPECT_GT(half_of_the_smallest(), 0);
    });
}

} // namespace
} // namespace slod
