#include "e2e/command_fixture.hpp"

// Alarms, from the real server to slodctl.
namespace slod {
namespace {

using ctl::ExitCode;
using test::Child;

class CommandAlarms : public CommandTest {
protected:
    bool shows(const std::string& alarm)
    {
        return test::eventually(
            [&] { return control({"status"}) == 0 && answer.at("alarms").contains(alarm); });
    }
    bool shows_none()
    {
        return test::eventually([&] { return control({"status"}) == 0 && answer.at("alarms").empty(); });
    }
};

TEST_F(CommandAlarms, ComeWithTheirRemedyAndGoWhenTheLimitDoes)
{
    Child running(server({"--set", "time.substep_angle=1e-6"}));
    ASSERT_TRUE(shows("under_resolved")) << running.errors();
    const std::string text = answer.at("alarms").at("under_resolved");
    EXPECT_NE(text.find("warning: "), std::string::npos) << text;
    EXPECT_NE(text.find("time.max_substeps"), std::string::npos) << text;
    ASSERT_EQ(control({"set", "alarms.under_resolved=1"}), 0) << answer;
    EXPECT_TRUE(shows_none()) << answer;
    ASSERT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_NE(running.errors().find("alarm under_resolved is over"), std::string::npos) << running.errors();
}

TEST_F(CommandAlarms, WithoutOneSayNone)
{
    Child running(server());
    EXPECT_EQ(control({"status"}), 0);
    EXPECT_TRUE(answer.at("alarms").empty()) << answer;
}

TEST_F(CommandAlarms, OnWhatTheSceneDoesNotConserveAreRefused)
{
    Child running(server());
    EXPECT_EQ(control({"set", "alarms.energy_drift=0.1"}), int(ExitCode::InvalidArgument));
    EXPECT_EQ(answer.at("field"), "alarms.energy_drift");
    EXPECT_NE(std::string(answer.at("text")).find("max_cluster_size"), std::string::npos) << answer;
}

} // namespace
} // namespace slod
