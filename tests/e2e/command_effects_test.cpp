#include <sstream>

#include "e2e/command_fixture.hpp"

// Effects that are listed, switched and changed while the scene runs: the real server and slodctl.
namespace slod {
namespace {

using ctl::ExitCode;
using test::Child;

class Effects : public CommandTest {
protected:
    static bool is(client::Connection& connection, const std::string& effect, const std::string& state)
    {
        return sees(connection, [&] {
            const auto found = connection.effects().find(effect);
            return found != connection.effects().end() && found->second.state == state;
        });
    }
};

TEST_F(Effects, AreSwitchedOffAndOnWhileTheSceneRunsAndTheLogRepeatsIt)
{
    {
        Child running(server());
        client::Connection connection = connect({.effects = true});
        ASSERT_TRUE(is(connection, "gravity", "active")) << running.errors();
        EXPECT_GT(connection.effects().at("gravity").clusters, 0U);
        EXPECT_GT(connection.effects().at("gravity").ms, 0);
        EXPECT_TRUE(is(connection, "turbulence", "absent"));

        ASSERT_EQ(control({"effect", "disable", "gravity"}), 0) << answer;
        EXPECT_GT(answer.at("applied_frame"), 0);
        ASSERT_TRUE(is(connection, "gravity", "off"));
        EXPECT_EQ(connection.effects().at("gravity").ms, 0);
        ASSERT_EQ(control({"effect", "set", "linear_drag.rate=0.25", "uniform_wind.velocity=[1, 0, 0]"}), 0)
            << answer;
        ASSERT_TRUE(is(connection, "uniform_wind", "active"));
        ASSERT_EQ(control({"effect", "enable", "gravity"}), 0) << answer;
        ASSERT_TRUE(is(connection, "gravity", "active"));
        ASSERT_EQ(control({"stop"}), 0);
        EXPECT_EQ(running.wait(), 0) << running.errors();
    }
    EXPECT_EQ(replay(), 0);
}

TEST_F(Effects, AreListedWithTheirWork)
{
    Child running(server());
    Child list(slodctl({"effect", "list", "--json"}));
    ASSERT_EQ(list.wait(), 0) << running.errors();
    std::istringstream lines(list.output());
    std::map<std::string, std::string> states;
    for (std::string line; std::getline(lines, line);) {
        const auto effect = nlohmann::json::parse(line);
        states[effect.at("effect")] = effect.at("state");
    }
    EXPECT_EQ(states["gravity"], "active");
    EXPECT_EQ(states["vortex"], "absent");
}

// A face of the box goes through the middle of the galaxy, where there is always a cluster.
TEST_F(Effects, AreListedWithTheClustersThatTheirBoundaryCuts)
{
    Child running(server({"--set", "control.mode=off", "--set", "background.max_cluster_size=32", "--set",
                          "linear_drag.rate=1e-9", "--set",
                          "wind=[{centre=[0,0,1e3], half_extent=[1e3,1e3,1e3], edge=1e-3}]"}));
    client::Connection connection = connect({.effects = true});
    ASSERT_TRUE(is(connection, "wind", "active")) << running.errors();
    Child list(slodctl({"effect", "list", "--json"}));
    ASSERT_EQ(list.wait(), 0) << running.errors();
    std::istringstream lines(list.output());
    std::map<std::string, std::uint64_t> straddling;
    for (std::string line; std::getline(lines, line);) {
        const auto effect = nlohmann::json::parse(line);
        straddling[effect.at("effect")] = effect.at("straddling");
    }
    EXPECT_GT(straddling.at("wind"), 0U);
    EXPECT_EQ(straddling.at("gravity"), 0U);
    ASSERT_EQ(control({"stats"}), 0);
    EXPECT_GT(answer.at("counts").at("wind_straddling"), 0) << answer;
}

TEST_F(Effects, ThatTheSceneHasNotAreNotSwitched)
{
    Child running(server());
    for (const char* verb : {"enable", "disable"}) {
        EXPECT_EQ(control({"effect", verb, "vortex"}), int(ExitCode::InvalidArgument));
        EXPECT_EQ(answer.at("field"), "effects.vortex");
    }
    EXPECT_EQ(control({"effect", "disable", "vertex"}), int(ExitCode::InvalidArgument));
    EXPECT_NE(std::string(answer.at("text")).find("did you mean vortex"), std::string::npos) << answer;
    EXPECT_EQ(control({"effect", "disable"}), int(ExitCode::Usage));
}

} // namespace
} // namespace slod
