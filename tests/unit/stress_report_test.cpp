#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "stress/limits.hpp"
#include "stress/picture.hpp"
#include "stress/report.hpp"

namespace slod::stress {
namespace {

SubscriberResult reader(Reader kind, std::uint64_t received, std::uint64_t last, double latency_ms)
{
    SubscriberResult result{.reader = kind,
                            .received = received,
                            .sent = last,
                            .open = {{"background", {.first = 1, .last = last, .received = received}}},
                            .bytes = received * 1000000};
    for (std::uint64_t i = 0; i < received; ++i)
        result.latency.add(latency_ms);
    return result;
}

/// Of 100 samples one steady reader got all, another one 90; a slow one got 10.
Report some_report()
{
    Report report{.subscribers = 3};
    report.load.frame_rate_hz = 29;
    report.load.processor_ms = 11;
    report.rest.processor_ms = 10;
    report.readers = report_of({reader(Reader::Steady, 100, 100, 2), reader(Reader::Steady, 90, 100, 4),
                                reader(Reader::Slow, 10, 100, 500)},
                               10);
    return report;
}

/// The commands of one client, all answered.
Report with_commands()
{
    Report report = some_report();
    report.commanders = 1;
    CommanderResult result{};
    result.valid = {.commands = 10, .writes = 10, .answers = 10, .results = {{"applied", 10}}};
    result.round_trip.add(30);
    report.commands = report_of(std::vector{result});
    return report;
}

bool holds(const Report& report, const Limits& limits = {})
{
    return all_held(checks(report, limits));
}

TEST(StressReport, AddsUpEachKindOfReader)
{
    const std::vector<ReaderReport> readers = some_report().readers;
    ASSERT_EQ(readers.size(), 2U);
    EXPECT_EQ(readers[0].readers, 2U);
    EXPECT_DOUBLE_EQ(readers[0].delivered, 0.95);
    EXPECT_DOUBLE_EQ(readers[0].mb_s, 19);
    EXPECT_EQ(readers[1].reader, Reader::Slow);
    EXPECT_DOUBLE_EQ(readers[1].delivered, 0.1);
}

TEST(StressReport, AReaderThatGotNothingHasLostAll)
{
    const SubscriberResult nothing{.reader = Reader::Steady};
    const auto readers = report_of({reader(Reader::Steady, 100, 100, 2), nothing}, 10);
    EXPECT_DOUBLE_EQ(readers[0].delivered, 0.5);
    EXPECT_DOUBLE_EQ(report_of({nothing}, 10)[0].delivered, 0) << "whether or not others got something";
}

TEST(StressLimits, EachHoldsAtItsFigureAndNotBeyond)
{
    const Report report = with_commands();
    EXPECT_TRUE(holds(report));
    EXPECT_TRUE(holds(report, {.loss_percent = 5.1}));
    EXPECT_FALSE(holds(report, {.loss_percent = 4.9}));
    EXPECT_TRUE(holds(report, {.latency_ms = 4.1})) << "that of the slow reader does not count";
    EXPECT_FALSE(holds(report, {.latency_ms = 3.9}));
    EXPECT_TRUE(holds(report, {.round_trip_ms = 31}));
    EXPECT_FALSE(holds(report, {.round_trip_ms = 29}));
    EXPECT_TRUE(holds(report, {.processor_growth_percent = 10.1}));
    EXPECT_FALSE(holds(report, {.processor_growth_percent = 9.9}));
    EXPECT_TRUE(holds(report, {.frame_rate_hz = 29}));
    EXPECT_FALSE(holds(report, {.frame_rate_hz = 30}));
}

TEST(StressLimits, ALimitOnWhatWasNotMeasuredDoesNotHold)
{
    EXPECT_FALSE(holds(some_report(), {.round_trip_ms = 1000}));
    EXPECT_FALSE(holds(some_report(), {.memory_growth_mib = 1000}));
    Report report = some_report();
    report.readers =
        report_of({reader(Reader::Steady, 100, 100, 2), reader(Reader::BestEffort, 0, 0, 0)}, 10);
    EXPECT_TRUE(holds(report)) << "nothing was asked for";
    EXPECT_FALSE(holds(report, {.loss_percent = 100})) << "one kind got nothing";
    EXPECT_FALSE(holds(report, {.latency_ms = 1000}));
}

TEST(StressLimits, WhatMustNeverBeIsJudgedWithoutALimit)
{
    const auto fails = [](const auto& spoil) {
        Report report = with_commands();
        spoil(report);
        return !holds(report);
    };
    EXPECT_TRUE(fails([](Report& report) { report.load.delayed_frames = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.load.refused_samples = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.load.longest_standstill_s = 6; }));
    EXPECT_TRUE(fails([](Report& report) { report.missing_workers = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.lost_server = "it was killed"; }));
    EXPECT_TRUE(fails([](Report& report) { report.commands.valid.lost = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.commands.rough.contradicted = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.commands.rough.unexpected = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.commands.wrong_regions = 1; }));
    EXPECT_TRUE(fails([](Report& report) { report.commands.valid.answers = 11; }));
}

TEST(StressPicture, HasACurveForEveryKindAndAQuotedFile)
{
    const std::string script = load_script(with_commands(), "it's.png");
    EXPECT_NE(script.find("'it''s.png'"), std::string::npos);
    for (const char* curve : {"'latency, steady'", "'latency, slow'", "'command to answer'"})
        EXPECT_NE(script.find(curve), std::string::npos) << curve;
    EXPECT_NE(sweep_script({some_report()}, "a.png").find("\n3 95 "), std::string::npos);
}

TEST(StressReport, TextAndJsonSayTheSame)
{
    const Report report = with_commands();
    EXPECT_NE(text_of(report).find(" 95.00 % delivered"), std::string::npos) << text_of(report);
    const Json json = json_of(report);
    EXPECT_DOUBLE_EQ(json.at("readers").at(0).at("delivered").get<double>(), 0.95);
    EXPECT_EQ(json.at("commands").at("valid").at("results").at("applied"), 10);
    EXPECT_TRUE(json.at("memory_growth_mib").is_null());
}

} // namespace
} // namespace slod::stress
