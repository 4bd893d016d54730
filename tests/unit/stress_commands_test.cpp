#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stress/answer_book.hpp"
#include "stress/misuse.hpp"
#include "stress/region_model.hpp"
#include "stress/storm.hpp"

namespace slod::stress {
namespace {

constexpr const char* applied = "applied";

Draft move_to(double x)
{
    return {.kind = "move_roi", .region = "a", .centre = {x, 0, 0}};
}

/// A box that was added and moved.
RegionModel moved_box()
{
    RegionModel model;
    model.on_answer(add_box("a", {1, 2, 3}, 0.5, 0), {applied, 7, 4});
    model.on_answer(move_to(9), {applied, 8, 5});
    return model;
}

RegionState moved_box_as_told()
{
    return {.shape = "box",
            .centre = {9, 0, 0},
            .half_extent = {0.5, 0.5, 0.5},
            .max_cluster_size = 64,
            .revision = 5};
}

TEST(RegionModel, AgreesWithTheStateThatTheAnswersDescribe)
{
    EXPECT_EQ(moved_box().problems({{"a", moved_box_as_told()}, {"another's", {}}}),
              std::vector<std::string>());
}

TEST(RegionModel, SeesACommandThatWasAppliedTwiceByItsRevision)
{
    RegionState told = moved_box_as_told();
    told.revision = 6;
    EXPECT_EQ(moved_box().problems({{"a", told}}),
              std::vector<std::string>{"a: revision is 6, but must be 5"});
}

TEST(RegionModel, SeesACommandThatWasLost)
{
    RegionState told = moved_box_as_told();
    told.centre = {1, 2, 3};
    EXPECT_EQ(moved_box().problems({{"a", told}}),
              std::vector<std::string>{"a: centre is 1,2,3, but must be 9,0,0"});
    EXPECT_EQ(moved_box().problems({}), std::vector<std::string>{"a: is not there, but must be"});
}

TEST(RegionModel, ARefusalChangesNothing)
{
    RegionModel model = moved_box();
    model.on_answer(move_to(-1), {"invalid", 0, 0});
    model.on_answer({.kind = "remove_roi", .region = "a"}, {"stale_revision", 0, 0});
    EXPECT_TRUE(model.problems({{"a", moved_box_as_told()}}).empty());
}

TEST(RegionModel, SizesAndSettingsAreOfTheLastAnswer)
{
    RegionModel model = moved_box();
    model.on_answer({.kind = "resize_roi", .region = "a", .half_extent = {3, 2, 1}}, {applied, 9, 6});
    model.on_answer({.kind = "set_roi", .region = "a", .settings = {{"max_cluster_size", "17"}}},
                    {applied, 9, 7});
    RegionState told = moved_box_as_told();
    EXPECT_EQ(model.problems({{"a", told}}).size(), 3U) << "half_extent, max_cluster_size, revision";
    told.half_extent = {3, 2, 1};
    told.max_cluster_size = 17;
    told.revision = 7;
    EXPECT_TRUE(model.problems({{"a", told}}).empty());
}

TEST(RegionModel, WhatWasRemovedMustBeGoneUntilItIsAddedAgain)
{
    RegionModel model = moved_box();
    model.on_answer({.kind = "remove_roi", .region = "a"}, {applied, 9, 0});
    EXPECT_TRUE(model.problems({}).empty());
    EXPECT_EQ(model.problems({{"a", moved_box_as_told()}}),
              std::vector<std::string>{"a: is there, but was removed"});
    model.on_answer(add_box("a", {}, 1, 0), {applied, 10, 8});
    EXPECT_EQ(model.problems({}).size(), 1U);
}

TEST(AnswerBook, ACommandWithoutAnAnswerIsLost)
{
    AnswerBook book;
    book.on_sent(1, move_to(1), {applied});
    book.on_sent(2, move_to(2), {applied});
    EXPECT_NE(book.on_answer(2, {applied, 1, 1}), nullptr);
    EXPECT_EQ(book.waiting(), 1U);
    EXPECT_EQ(book.tally().lost, 1U);
    EXPECT_EQ(book.tally().results.at(applied), 1U);
}

TEST(AnswerBook, TheSameAnswerAgainIsRightAndAnotherOneIsNot)
{
    AnswerBook book;
    book.on_sent(1, move_to(1), {applied});
    book.on_sent_again();
    EXPECT_NE(book.on_answer(1, {applied, 3, 3}), nullptr);
    EXPECT_EQ(book.on_answer(1, {applied, 3, 3}), nullptr) << "it is no first answer";
    EXPECT_EQ(book.tally().contradicted, 0U);
    EXPECT_EQ(book.tally().surplus(), 0U);
    book.on_answer(1, {applied, 4, 4});
    EXPECT_EQ(book.tally().contradicted, 1U) << "applied twice";
    EXPECT_EQ(book.tally().surplus(), 1U) << "written twice, answered three times";
    EXPECT_EQ(book.problems(),
              std::vector<std::string>{"request 1 (move_roi a) was answered applied at revision "
                                       "3, frame 3, and then applied at revision 4, frame 4"});
}

TEST(AnswerBook, AForgottenNumberMayBeRefused)
{
    AnswerBook book;
    book.on_sent(1, move_to(1), {applied});
    book.on_answer(1, {applied, 3, 3});
    book.on_answer(1, {"limit_reached", 0, 0});
    EXPECT_EQ(book.tally().contradicted, 0U);
}

TEST(AnswerBook, AnAnswerThatIsNotRightIsUnexpected)
{
    AnswerBook book;
    book.on_sent(1, move_to(1), {"invalid"});
    book.on_sent(2, move_to(1), {});
    book.on_answer(1, {applied, 3, 3});
    book.on_answer(2, {applied, 3, 3});
    EXPECT_EQ(book.tally().unexpected, 1U);
}

TEST(AnswerBook, RemembersWhatWaitsHoweverMuchIsAnsweredMeanwhile)
{
    AnswerBook book;
    book.on_sent(1, move_to(1), {applied});
    for (std::uint64_t number = 2; number < 5000; ++number) {
        book.on_sent(number, move_to(1), {applied});
        book.on_answer(number, {applied, 1, 1});
    }
    EXPECT_NE(book.on_answer(1, {applied, 1, 1}), nullptr);
    EXPECT_EQ(book.tally().lost, 0U);
}

TEST(Storm, HasOneCommandUnderWayForEachRegionAndUsesEveryKind)
{
    Storm storm({.prefix = "s-", .regions = 3, .extent = 10, .lease_s = 60, .seed = 7});
    std::set<std::string> kinds;
    std::uint64_t revision = 0;
    for (int round = 0; round < 500; ++round) {
        std::map<std::string, Draft> under_way;
        for (std::optional<Draft> draft = storm.next(); draft; draft = storm.next()) {
            EXPECT_EQ(draft->kind == "add_roi", !storm.model().contains(draft->region));
            for (const double coordinate : draft->centre)
                EXPECT_LE(std::abs(coordinate), 10);
            kinds.insert(draft->kind);
            EXPECT_TRUE(under_way.emplace(draft->region, *draft).second) << draft->region;
        }
        ASSERT_EQ(under_way.size(), 3U);
        for (const auto& [region, draft] : under_way)
            storm.on_answer(draft, {applied, 1, ++revision});
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"add_roi", "move_roi", "remove_roi", "resize_roi", "set_roi"}));
    EXPECT_EQ(storm.clean_up().size(), storm.model().regions().size());
}

// The wire's bounded texts are cut where they are too long, which would make another command of them.
TEST(Misuse, NothingIsLongerThanTheWireTakes)
{
    for (const Misuse& misuse : misuses("box")) {
        EXPECT_LE(misuse.draft.kind.size(), 32U) << misuse.wrong;
        EXPECT_LE(misuse.draft.region.size(), 32U) << misuse.wrong;
        EXPECT_LE(misuse.draft.settings.size(), 64U) << misuse.wrong;
        for (const auto& [setting, value] : misuse.draft.settings) {
            EXPECT_LE(setting.size(), 64U) << misuse.wrong;
            EXPECT_LE(value.size(), 128U) << misuse.wrong;
        }
        EXPECT_NE(misuse.right_result, applied) << misuse.wrong;
    }
}

} // namespace
} // namespace slod::stress
