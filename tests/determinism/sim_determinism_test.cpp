#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "simd/kernels.hpp"
#include "support/case_rows.hpp"
#include "support/full_team.hpp"
#include "support/small_scenes.hpp"

// The state has the same bits whatever runs it: any number of threads, any instruction set, any run. Hashes
// of the state are compared after every frame, and the first frame that differs is named.
namespace slod::test {

namespace {

constexpr int frame_count = 48; ///< three of the longest lives

/// How a scene is run.
struct Conditions {
    int threads = 1;
    std::string_view isa = "baseline";
};

/// Steps on; halfway every scene that has clusters changes its level of detail.
const Snapshot& step(Simulation& simulation, int frame)
{
    const Detail other{.cluster_size = 0.7, .breadth = 1.5, .opening = 1.5, .life = 0.5, .dithered = true};
    if (frame == frame_count / 2 && !simulation.plan().unclustered) {
        EXPECT_EQ(simulation.set_detail(other), Problems{});
    }
    return simulation.step({.error_pairs = 4000});
}

/// The state's hash at the start and after each frame.
std::vector<std::uint64_t> hashes(const SmallScene& scene, const Conditions& conditions)
{
    std::vector<std::uint64_t> result;
    ThreadTeam(conditions.threads).run([&] {
        Simulation simulation(scene.settings, scene.initial, {.isa = conditions.isa, .tick = {}});
        EXPECT_EQ(simulation.isa(), conditions.isa);
        result.push_back(simulation.state_hash());
        for (int frame = 0; frame < frame_count; ++frame) {
            step(simulation, frame);
            result.push_back(simulation.state_hash());
        }
    });
    return result;
}

/// Names the first frame that differs, and reports how many do.
testing::AssertionResult same(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b)
{
    std::size_t differing = 0, first = 0;
    for (std::size_t frame = a.size(); frame-- > 0;)
        if (a[frame] != b[frame]) {
            ++differing;
            first = frame;
        }
    expect_at_most("frames with other bits", double(differing), 0);
    if (differing > 0)
        return testing::AssertionFailure() << "frame " << first << " is the first to differ";
    return testing::AssertionSuccess();
}

std::string name_of(const testing::TestParamInfo<SmallScene>& info)
{
    return info.param.name;
}

class SameBits : public testing::TestWithParam<SmallScene> {};

TEST_P(SameBits, N09_WithAnyNumberOfThreads)
{
    const std::vector<std::uint64_t> alone = hashes(GetParam(), {.threads = 1});
    for (const int threads : {2, 3, 7, 15, 32})
        EXPECT_TRUE(same(alone, hashes(GetParam(), {.threads = threads}))) << threads << " threads";
}

TEST_P(SameBits, N09_InThreeRuns)
{
    const Conditions conditions{.threads = 4};
    const std::vector<std::uint64_t> first = hashes(GetParam(), conditions);
    for (int again = 0; again < 2; ++again)
        EXPECT_TRUE(same(first, hashes(GetParam(), conditions)));
}

TEST_P(SameBits, N14_OnEveryInstructionSet)
{
    const auto runnable = simd::runnable_kernels();
    const std::vector<std::uint64_t> slowest =
        hashes(GetParam(), {.threads = 2, .isa = runnable.front()->name});
    for (const simd::KernelTable* kernels : runnable.subspan(1))
        EXPECT_TRUE(same(slowest, hashes(GetParam(), {.threads = 2, .isa = kernels->name}))) << kernels->name;
}

/// The state's hash at the end of each scene's run. One changes whenever the simulation computes anything
/// else than before, by as much as a bit: the commit that changes one says what, and why that is right.
const std::map<std::string, std::uint64_t> pinned{
    {"flow", 0x92b53db2016ca534},
    {"flow_in_double", 0xa37ae34b8bf4cd2b},
    {"stream", 0xbd2b589be931d727},
    {"rigid", 0x1f6712e53b3e9ca9},
    {"unclustered", 0x80583bfd6c4ed5cb},
    {"walk", 0xd8d68681f7492a4b},
    {"fountain", 0x33a7000abdb1ecbd},
    {"rigid_fountain", 0x3986c80a346e67e7},
    {"mixture", 0x8b7817d53d8617f1},
    {"regions", 0x79ccff1a6663d650},
    {"full_fountain", 0xb559e79cc1a15229},
    {"walk_with_quadrupoles", 0xb9fa79a030a1e765},
    {"obstacles", 0x23d67ea0ced08a87},
    {"rigid_obstacles", 0xabbe5b50d2adaa32},
    {"attracted_obstacles", 0xd0d4353dc83e7491},
    {"meshes", 0xf05bc6db18021e15},
    {"distance_grids", 0x7bf98fd61c4e23c2},
    {"fields", 0x7a865500d457a337},
    {"attracted_fields", 0xcd3839256e091ccb},
    {"winds", 0xf76d0b9ebb542542},
    {"winds_among_obstacles", 0xdfaea2ded3877d39},
    {"gusts", 0x52f4c1adc1266d19},
    {"kicked", 0x2946e901e45cf02c},
    {"sinks", 0xb42a1833ee07fa64},
    {"attracted_sink", 0x664c3a264ab57507},
    {"encounters", 0xb07f1f5274182845},
};

// The same in every preset: not optimised, optimised and with sanitizers.
TEST_P(SameBits, N14_AsWhenTheyWerePinned)
{
    const std::uint64_t now = hashes(GetParam(), {.threads = 2}).back();
    expect_at_most("scenes with another hash", pinned.at(GetParam().name) == now ? 0 : 1, 0);
    EXPECT_EQ(pinned.at(GetParam().name), now) << GetParam().name << ", 0x" << std::hex << now;
}

TEST_P(SameBits, OfASoundState)
{
    Simulation simulation(GetParam().settings, GetParam().initial, {});
    for (int frame = 0; frame < frame_count; ++frame)
        step(simulation, frame);
    EXPECT_EQ(simulation.problems(), Problems{});
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::ValuesIn(small_scenes()), name_of);

// What no scene does, no scene shows to be the same.
TEST(DeterminismScenes, MakeEverythingHappen)
{
    FrameCounts all;
    for (const SmallScene& scene : small_scenes()) {
        Simulation simulation(scene.settings, scene.initial, {});
        for (int frame = 0; frame < frame_count; ++frame)
            add_events(all, step(simulation, frame).counts);
    }
    for_each_event(all, [](std::string_view name, std::uint64_t count) { EXPECT_GT(count, 0U) << name; });
}

// On a machine of few cores the other tests would say little if the team were quietly cut down to them.
TEST(ThreadTeamOfThirtyTwo, N09_WorksWithMoreThreadsThanThreeOrFour)
{
    std::size_t seen = 0;
    ThreadTeam(32).run([&] { seen = gather_team(16); });
    expect_at_least("threads that took part", double(seen), 16);
}

} // namespace
} // namespace slod::test
