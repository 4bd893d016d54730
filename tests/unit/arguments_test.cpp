#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "arguments/parsing.hpp"
#include "arguments/server_choice.hpp"
#include "common/waiting.hpp"

namespace slod::client {
namespace {

using namespace std::chrono_literals;

/// What a program whose only options are those of its server makes of a command line.
struct Program {
    ServerChoice server;
    std::string printed;

    std::optional<ExitCode> reads(const std::vector<std::string>& words)
    {
        std::vector<const char*> arguments{"program"};
        for (const std::string& word : words)
            arguments.push_back(word.c_str());
        CLI::App app("A client.", "program");
        add_server_options(app, server, "Seconds to wait");
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const auto code = parse(app, int(arguments.size()), arguments.data());
        printed = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
        return code;
    }
};

TEST(Arguments, TheServerIsAsTheOptionsSayAndElseOnThisMachine)
{
    Program program;
    EXPECT_FALSE(program.reads({}));
    EXPECT_EQ(program.server.domain, 0U);
    EXPECT_EQ(program.server.profile, wire::Profile::Loopback);
    EXPECT_FALSE(program.reads({"--domain", "230", "--profile", "lan", "--timeout", "0.5"}));
    EXPECT_EQ(program.server.domain, 230U);
    EXPECT_EQ(program.server.profile, wire::Profile::Lan);
    EXPECT_EQ(program.server.timeout_s, 0.5);
    EXPECT_EQ(program.printed, "");
}

TEST(Arguments, WhateverIsWrongIsWrongUsageAndSaysWhatIsRight)
{
    Program program;
    EXPECT_EQ(program.reads({"--help"}), ExitCode::Success);
    EXPECT_NE(program.printed.find("--timeout SECONDS [3]"), std::string::npos) << program.printed;
    EXPECT_NE(program.printed.find("--profile NAME [loopback]"), std::string::npos) << program.printed;
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--domain", "231"},
                                                  {"--domain", "x"},
                                                  {"--profile", "wan"},
                                                  {"--timeout", "-1"}}) {
        EXPECT_EQ(program.reads(wrong), ExitCode::Usage) << wrong[1];
        EXPECT_NE(program.printed.find(wrong[0]), std::string::npos) << program.printed;
    }
    EXPECT_EQ(program.reads({"--timeout", "nan"}), ExitCode::Usage);
    EXPECT_NE(program.printed.find("nan is no number from 0 to 86400"), std::string::npos) << program.printed;
    EXPECT_EQ(program.reads({"--lunch"}), ExitCode::Usage);
    EXPECT_EQ(program.reads({"--domain"}), ExitCode::Usage);
}

/// Counts how often it is waited for.
struct Bell {
    int rings = 0;

    void wait(const std::stop_token&, std::chrono::nanoseconds) { ++rings; }
};

TEST(Waiting, EndsWithWhatIsWaitedForThoughTheTimeIsOver)
{
    Bell bell;
    EXPECT_TRUE(wait_until(bell, {}, Clock::now() + 1h, [&] { return bell.rings == 3; }));
    EXPECT_EQ(bell.rings, 3);
    EXPECT_TRUE(wait_until(bell, {}, Clock::time_point::min(), [] { return true; }));
    EXPECT_EQ(bell.rings, 3);
}

TEST(Waiting, EndsWithoutItAtTheDeadlineOrAStop)
{
    Bell bell;
    EXPECT_FALSE(wait_until(bell, {}, Clock::time_point::min(), [] { return false; }));
    EXPECT_EQ(bell.rings, 0);
    std::stop_source stop;
    const auto ask_to_stop = [&] {
        if (bell.rings == 2)
            stop.request_stop();
        return false;
    };
    EXPECT_FALSE(wait_until(bell, stop.get_token(), Clock::time_point::max(), ask_to_stop));
    EXPECT_EQ(bell.rings, 2);
}

} // namespace
} // namespace slod::client
