#include <chrono>

#include <gtest/gtest.h>

#include "app/answer_memory.hpp"

namespace slod {
namespace {

using namespace std::chrono_literals;

constexpr wire::Uuid alice{1}, bob{2}, carol{3};
constexpr AnswerMemory::Clock::time_point now{1h};
constexpr std::uint64_t kept = AnswerMemory::answers_per_client;

Answer answer(const wire::Uuid& client, std::uint64_t number)
{
    return {.client = client, .number = number, .applied_frame = 100 + number};
}

TEST(AnswerMemory, AnAnswerIsFoundByClientAndNumber)
{
    AnswerMemory memory(4);
    memory.remember(answer(alice, 1), now);
    ASSERT_TRUE(memory.find(alice, 1));
    EXPECT_EQ(memory.find(alice, 1)->applied_frame, 101U);
    EXPECT_FALSE(memory.find(alice, 2));
    EXPECT_FALSE(memory.find(bob, 1));
}

TEST(AnswerMemory, TheLast64OfAClientAreKept)
{
    AnswerMemory memory(4);
    for (std::uint64_t number = 1; number <= kept + 1; ++number)
        memory.remember(answer(alice, number), now);
    EXPECT_FALSE(memory.find(alice, 1));
    EXPECT_TRUE(memory.too_old(alice, 1));
    EXPECT_TRUE(memory.find(alice, 2));
    EXPECT_FALSE(memory.too_old(alice, 2));
    EXPECT_FALSE(memory.too_old(bob, 1));
}

// A request that was overtaken by later ones on its way is new, not old.
TEST(AnswerMemory, ALateRequestIsNotTooOldWhileNothingIsForgotten)
{
    AnswerMemory memory(4);
    for (std::uint64_t number = 2; number <= kept; ++number)
        memory.remember(answer(alice, number), now);
    EXPECT_FALSE(memory.too_old(alice, 1));
    EXPECT_FALSE(memory.find(alice, 1));
}

// What comes again within a request's life must find its answer, however many other clients command.
TEST(AnswerMemory, AClientIsForgottenOnlyWhenNothingItSentCanStillArrive)
{
    AnswerMemory memory(2);
    memory.remember(answer(alice, 1), now);
    memory.remember(answer(bob, 1), now + 1s);
    EXPECT_TRUE(memory.has_room(bob, now + 1s));
    EXPECT_FALSE(memory.has_room(carol, now + 10s));
    EXPECT_TRUE(memory.find(alice, 1));
    memory.renew(alice, now + 5s);
    EXPECT_FALSE(memory.has_room(carol, now + 11s));
    EXPECT_TRUE(memory.has_room(carol, now + 12s));
    memory.remember(answer(carol, 1), now + 12s);
    EXPECT_TRUE(memory.find(alice, 1));
    EXPECT_FALSE(memory.find(bob, 1));
    EXPECT_TRUE(memory.find(carol, 1));
}

} // namespace
} // namespace slod
