#include "e2e/command_fixture.hpp"

// The error of accelerations, measured and held while the scene runs: the real server and slodctl.
namespace slod {
namespace {

using ctl::ExitCode;
using test::Child;

class Errors : public CommandTest {};

TEST_F(Errors, AreToldOfAllAndByRegion)
{
    Child running(server({"--set", "background.max_cluster_size=16"}));
    ASSERT_EQ(
        control({"roi", "add", "fine", "--centre", "0,0,0", "--radius", "10", "--set", "max_cluster_size=1"}),
        0)
        << answer;
    client::Connection connection = connect({.errors = true});
    ASSERT_TRUE(sees(connection, [&] {
        return connection.errors().contains("fine") && connection.errors().contains("background");
    })) << running.errors();
    const client::MeasuredError& all = *connection.error();
    EXPECT_GT(all.samples, 0U);
    EXPECT_GT(all.median.value, 0);
    EXPECT_LE(all.median.low, all.median.value);
    EXPECT_GE(all.median.high, all.median.value);
    EXPECT_LE(all.p99.value, all.max);
    EXPECT_EQ(all.target, 0);

    ASSERT_EQ(control({"errors"}), 0);
    EXPECT_EQ(answer.at("region"), "");
    EXPECT_GT(answer.at("samples"), 0);

    ASSERT_EQ(control({"roi", "remove", "fine"}), 0);
    EXPECT_TRUE(sees(connection, [&] { return !connection.errors().contains("fine"); }));
    ASSERT_EQ(control({"set", "meter.enabled=false"}), 0);
    EXPECT_TRUE(sees(connection, [&] { return connection.errors().empty(); }));
}

TEST_F(Errors, ATargetIsTakenAndTold)
{
    Child running(server());
    ASSERT_EQ(control({"target", "error", "0.05"}), 0) << answer;
    client::Connection connection = connect({.stats = true, .errors = true});
    ASSERT_TRUE(sees(connection, [&] { return connection.error() && connection.error()->target == 0.05; }));
    ASSERT_TRUE(
        sees(connection, [&] { return connection.stats() && connection.stats()->control.mode == "error"; }));

    ASSERT_EQ(control({"target", "fps", "50"}), 0) << answer;
    ASSERT_TRUE(sees(connection, [&] {
        return connection.stats()->control.mode == "smooth" &&
               connection.server()->frame_rate_target_hz == 50;
    }));
    ASSERT_EQ(control({"target", "fps", "40", "error", "0.02"}), 0) << answer;
    ASSERT_TRUE(sees(connection, [&] {
        return connection.error() && connection.error()->target == 0.02 &&
               connection.server()->frame_rate_target_hz == 40;
    }));
    ASSERT_EQ(control({"target", "off"}), 0) << answer;
    EXPECT_TRUE(sees(connection, [&] { return connection.stats()->control.mode == "off"; }));
    EXPECT_EQ(control({"target", "error", "-1"}), int(ExitCode::InvalidArgument));
    EXPECT_EQ(control({"set", "meter.enabled=false", "control.mode=error"}), int(ExitCode::InvalidArgument));
}

// A thousand frames a second leave no time for an error that unclustered stars are needed for: one of the two
// targets has to give way, whatever the machine.
TEST_F(Errors, OfTwoTargetsThatCannotBothBeHadThePriorityIsHeld)
{
    Child running(server({"--set", "control.mode=error", "--set", "control.target_error=1e-4", "--set",
                          "server.frame_rate=1000", "--set", "galaxy.particles=10000"}));
    client::Connection connection = connect({.stats = true, .errors = true});
    ASSERT_TRUE(sees(connection, [&] {
        const std::string state = connection.stats() ? connection.stats()->control.state : "";
        return connection.error() && (state == "yielding" || state == "unreachable"); // on a slow machine
    })) << running.errors();
    EXPECT_GT(connection.error()->median.low, 1e-4);

    const double yielding_at = connection.stats()->control.cluster_size;
    ASSERT_EQ(control({"set", "control.priority=error"}), 0) << answer;
    ASSERT_TRUE(sees(connection, [&] {
        return connection.stats()->control.cluster_size < 0.75 * yielding_at &&
               connection.stats()->control.state == "adjusting";
    }));
}

TEST_F(Errors, WhatIsNoTargetIsWrongUsage)
{
    for (const Words& words : {Words{"target"},
                               {"target", "fps"},
                               {"target", "speed", "3"},
                               {"target", "fps", "30", "fps", "40"},
                               {"target", "off", "30"}})
        EXPECT_EQ(control(words), 2);
}

} // namespace
} // namespace slod
