#include <new>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/allocation_counter.hpp"
#include "support/full_team.hpp"
#include "support/small_scenes.hpp"

// Memory is taken in the commands and emit phases, which provide it for the others, and once a scene has
// become steady not even there.
namespace slod::test {

namespace {

constexpr std::size_t thread_count = 4;
constexpr int warm_up_frames = 200; ///< twelve of the longest lives; the fountains are full after 40
constexpr int steady_frames = 400;

class AllocationFree : public testing::TestWithParam<SmallScene> {};

std::string name_of(const testing::TestParamInfo<SmallScene>& info)
{
    return info.param.name;
}

/// Options under which a frame's profile has allocations in place of milliseconds.
Simulation::Options counting_allocations()
{
    return {.isa = {}, .tick = [] { return std::int64_t(allocations()) * 1'000'000; }};
}

TEST_P(AllocationFree, InEveryPhaseOnceSteady)
{
    if (validating)
        GTEST_SKIP() << "what checks the structures after each frame takes memory of its own";
    for (const Simulation::Request request :
         {Simulation::Request{}, {.clusters = true, .conserved = true, .error_pairs = 10'000}}) {
        SCOPED_TRACE(request.clusters ? "everything asked for" : "nothing asked for");
        ThreadTeam(int(thread_count)).run([&] {
            ASSERT_GE(gather_team(thread_count), thread_count); // one that joins late takes memory of its own
            Simulation simulation(GetParam().settings, GetParam().initial, {});
            for (int frame = 0; frame < warm_up_frames; ++frame)
                simulation.step(request);
            const std::uint64_t before = allocations();
            for (int frame = 0; frame < steady_frames; ++frame)
                simulation.step(request);
            EXPECT_EQ(allocations(), before);
            EXPECT_EQ(simulation.error().samples > 0,
                      request.error_pairs > 0 && simulation.plan().has(Phase::Meter));
        });
    }
}

TEST_P(AllocationFree, InAllPhasesButCommandsAndEmitFromTheStart)
{
    ThreadTeam(int(thread_count)).run([&] {
        ASSERT_GE(gather_team(thread_count), thread_count);
        Simulation simulation(GetParam().settings, GetParam().initial, counting_allocations());
        for (int frame = 1; frame <= warm_up_frames; ++frame) {
            StepProfile taken = simulation.step({}).profile;
            taken[Phase::Commands] = taken[Phase::Emit] = 0;
            for (std::size_t phase = 0; phase < phase_count; ++phase)
                EXPECT_EQ(taken.milliseconds[phase], 0) << names(Phase{})[phase] << " in frame " << frame;
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, AllocationFree, testing::ValuesIn(small_scenes()), name_of);

// The members' chunk has a row of 32 bytes for each of 2^20 particles. Clusters, and room to form an eighth
// of the particles anew, take less than 100 bytes for each; to form all of them once takes some 200.
TEST(SimulationMemory, OfTheFirstFormingIsGivenBackWhereNoneFollows)
{
    constexpr std::uint64_t count = 300'000;
    SmallScene scene{"cloud", quiet_settings(), {}};
    add_cloud(scene.initial, {.count = count}, 1);
    const std::uint64_t before = bytes_held();
    const Simulation simulation(scene.settings, scene.initial, {});
    const std::uint64_t held = bytes_held() - before;
    EXPECT_GT(held, 32U << 20);
    EXPECT_LT(held, (32U << 20) + 100 * count);
    RecordProperty("bytes_per_particle", std::to_string(double(held - (32U << 20)) / double(count)));
}

// Lest the other tests count nothing.
TEST(AllocationCounter, CountsEveryNew)
{
    // Called by name: a compiler may leave out the new and delete of an object nobody uses.
    const auto plain = [] { operator delete(operator new(8)); };
    const auto array = [] { operator delete[](operator new[](8)); };
    const auto without_exceptions = [] { operator delete(operator new(8, std::nothrow), std::nothrow); };
    const auto aligned = [] {
        constexpr std::align_val_t line{64};
        operator delete(operator new(8, line), line);
    };
    const auto count = [](auto allocate) {
        const std::uint64_t before = allocations();
        allocate();
        return allocations() - before;
    };
    EXPECT_EQ(count(plain), 1U);
    EXPECT_EQ(count(array), 1U);
    EXPECT_EQ(count(without_exceptions), 1U);
    EXPECT_EQ(count(aligned), 1U);
    EXPECT_GE(count([&] { for_each_task(1000, [&](std::size_t) { plain(); }); }), 1000U);
}

} // namespace
} // namespace slod::test
