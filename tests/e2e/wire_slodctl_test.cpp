#include <chrono>
#include <iterator>
#include <signal.h>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/connection.hpp"
#include "ctl/command_line.hpp"
#include "e2e/wire_support.hpp"

// The real slodctl, and the clients' library, against a server process without a simulation.
namespace slod {
namespace {

using namespace std::chrono_literals;
using client::Connection;
using client::Contact;
using ctl::ExitCode;
using nlohmann::json;
using test::Child;
using test::eventually;

class WireSlodctl : public testing::Test {
protected:
    /// A source of `frames` frames (0: for ever) of 100 clusters.
    std::vector<std::string> source(const std::string& frames) const
    {
        return {WIRE_SOURCE, domain.text(), "100", frames};
    }

    /// slodctl with these arguments on this test's domain; patient, since the machine may be busy.
    std::vector<std::string> slodctl(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), SLODCTL);
        arguments.insert(arguments.end(), {"--domain", domain.text()});
        return arguments;
    }

    Connection connect() const { return Connection(domain.number(), wire::Profile::Loopback, {}); }

    static bool reaches(Connection& connection, Contact contact)
    {
        return eventually([&] {
            connection.wait(std::stop_token(), 50ms);
            return connection.status().contact == contact;
        });
    }

    static bool says(Connection& connection, const char* word)
    {
        return eventually([&] {
            connection.wait(std::stop_token(), 50ms);
            return connection.status().contact == Contact::NoServer &&
                   connection.status().reason.find(word) != std::string::npos;
        });
    }

    test::FreeDomain domain;
};

std::vector<json> objects(const std::string& lines)
{
    std::vector<json> parsed;
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);)
        parsed.push_back(json::parse(line));
    return parsed;
}

TEST_F(WireSlodctl, StatusSaysWhichServerThereIs)
{
    const Child server(source("0"));
    Child status(slodctl({"status", "--json", "--timeout", "30"}));
    ASSERT_EQ(status.wait(), int(ExitCode::Success)) << status.errors();
    const std::vector<json> answers = objects(status.output());
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_TRUE(answers[0].contains("contact"));
    EXPECT_EQ(answers[0].at("scene_title"), "made up");
    EXPECT_EQ(answers[0].at("version"), "0.0.1");
}

TEST_F(WireSlodctl, StatsPrintsOneFramesNumbers)
{
    const Child server(source("0"));
    Child stats(slodctl({"stats", "--json", "--timeout", "30"}));
    ASSERT_EQ(stats.wait(), int(ExitCode::Success)) << stats.errors();
    const json answer = objects(stats.output()).at(0);
    EXPECT_EQ(answer.at("clusters"), 100);
    EXPECT_EQ(answer.at("counts").at("interactions"), 12'345'678'901);
    EXPECT_EQ(answer.at("phases_ms").at("forces"), 4.5);
    EXPECT_TRUE(answer.at("conserved").at("potential_energy").is_null());
}

TEST_F(WireSlodctl, StatsPrintsTheValuesThatAreNamed)
{
    const Child server(source("0"));
    Child stats(slodctl({"stats", "phases_ms.forces", "clusters", "--timeout", "30"}));
    ASSERT_EQ(stats.wait(), int(ExitCode::Success)) << stats.errors();
    EXPECT_EQ(stats.output(), "phases_ms.forces  4.5\nclusters          100\n");
}

TEST_F(WireSlodctl, AnUnknownNameIsNotFound)
{
    const Child server(source("0"));
    Child stats(slodctl({"stats", "phases_ms.lunch", "--timeout", "30"}));
    EXPECT_EQ(stats.wait(), int(ExitCode::NotFound));
    EXPECT_EQ(stats.output(), "");
    EXPECT_NE(stats.errors().find("phases_ms.lunch"), std::string::npos);
}

TEST_F(WireSlodctl, WatchPrintsOneLineForEachUpdate)
{
    const Child server(source("0"));
    Child watch(slodctl({"watch", "--count", "2", "--clusters", "--json", "--timeout", "30"}));
    ASSERT_EQ(watch.wait(), int(ExitCode::Success)) << watch.errors();
    const std::vector<json> updates = objects(watch.output());
    ASSERT_EQ(updates.size(), 2U);
    EXPECT_GT(updates[1].at("frame"), updates[0].at("frame"));
    EXPECT_GT(updates[1].at("receive").at("received"), 0);
}

TEST_F(WireSlodctl, EchoPrintsSamplesOfATopicAsTheyCame)
{
    const Child server(source("0"));
    Child once(slodctl({"echo", "clusters", "--once", "--json", "--timeout", "30"}));
    ASSERT_EQ(once.wait(), int(ExitCode::Success)) << once.errors();
    const std::vector<json> samples = objects(once.output());
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].at("mass").size(), 100U);
    EXPECT_EQ(samples[0].at("position").size(), 300U);
    Child some(slodctl({"echo", "slod/v1/server_state", "--count", "3", "--json", "--timeout", "30"}));
    ASSERT_EQ(some.wait(), int(ExitCode::Success)) << some.errors();
    const std::vector<json> states = objects(some.output());
    ASSERT_EQ(states.size(), 3U);
    EXPECT_GT(states[2].at("heartbeat"), states[0].at("heartbeat"));
}

TEST_F(WireSlodctl, EchoOfWhatDoesNotComeTimesOut)
{
    const Child server(source("0"));
    Child silent(slodctl({"echo", "members", "--once", "--timeout", "2"}));
    EXPECT_EQ(silent.wait(), int(ExitCode::TimedOut));
    EXPECT_NE(silent.errors().find("--timeout"), std::string::npos);
}

TEST_F(WireSlodctl, AnUnknownTopicIsNotFoundAndTheKnownOnesAreNamed)
{
    for (const char* command : {"echo", "hz", "bw", "latency"}) {
        Child child(slodctl({command, "lunch"}));
        EXPECT_EQ(child.wait(), int(ExitCode::NotFound)) << command;
        EXPECT_NE(child.errors().find("clusters, overview"), std::string::npos) << command;
    }
}

// The source offers frames as fast as the rate of clusters lets it: 30 a second.
TEST_F(WireSlodctl, HzBwAndLatencyMeasureATopic)
{
    const Child server(source("0"));
    const auto measured = [&](const char* command) {
        Child child(slodctl({command, "clusters", "--count", "2", "--json", "--timeout", "30"}));
        EXPECT_EQ(child.wait(), int(ExitCode::Success)) << child.errors();
        const std::vector<json> updates = objects(child.output());
        EXPECT_EQ(updates.size(), 2U) << command;
        return updates.back();
    };
    const json hz = measured("hz");
    EXPECT_GT(hz.at("received"), 0);
    EXPECT_GT(hz.at("rate_hz"), 0);
    const json bw = measured("bw");
    EXPECT_GE(bw.at("mean_bytes"), 100 * (3 + 3 + 1 + 1 + 6 + 2 + 2) * 4);
    EXPECT_GT(bw.at("bytes_per_s"), 0);
    EXPECT_GT(measured("latency").at("latency_p50_ms"), 0);
}

TEST_F(WireSlodctl, WatchEndsCleanlyOnCtrlC)
{
    const Child server(source("0"));
    Child watch(slodctl({"watch", "--timeout", "30"}));
    ASSERT_TRUE(eventually([&] { return !watch.output().empty(); }));
    watch.signal(SIGINT);
    EXPECT_EQ(watch.wait(), int(ExitCode::Success));
    EXPECT_EQ(watch.errors(), "");
    EXPECT_EQ(watch.output().back(), '\n');
}

TEST_F(WireSlodctl, WithoutAServerEveryCommandSaysSo)
{
    for (const std::string command : {"status", "watch", "stats", "echo stats", "hz stats"}) {
        std::istringstream words(command);
        std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
        arguments.insert(arguments.end(), {"--timeout", "0.2"});
        Child child(slodctl(arguments));
        EXPECT_EQ(child.wait(), int(ExitCode::NoServer)) << command;
        EXPECT_EQ(child.output(), "") << command;
        EXPECT_NE(child.errors().find("start slod-server"), std::string::npos) << command;
    }
}

TEST_F(WireSlodctl, AServerThatCompletesNoFrameMakesStatsTimeOut)
{
    const Child server(source("1"));
    Connection connection = connect();
    ASSERT_TRUE(reaches(connection, Contact::Stalled));
    Child stats(slodctl({"stats", "--timeout", "3"}));
    EXPECT_EQ(stats.wait(), int(ExitCode::TimedOut));
    EXPECT_EQ(stats.output(), "");
}

TEST_F(WireSlodctl, AWrongCommandLineIsWrongUsageWhateverIsWrongInIt)
{
    EXPECT_EQ(Child({SLODCTL}).wait(), int(ExitCode::Usage));
    EXPECT_EQ(Child(slodctl({"lunch"})).wait(), int(ExitCode::Usage));
    EXPECT_EQ(Child(slodctl({"status", "--lunch"})).wait(), int(ExitCode::Usage));
    EXPECT_EQ(Child({SLODCTL, "status", "--domain", "999"}).wait(), int(ExitCode::Usage));
    EXPECT_EQ(Child(slodctl({"status", "--profile", "moon"})).wait(), int(ExitCode::Usage));
    EXPECT_EQ(Child(slodctl({"watch", "--count", "0"})).wait(), int(ExitCode::Usage));
}

TEST_F(WireSlodctl, HelpAndVersionAreNotErrors)
{
    Child help({SLODCTL, "--help"});
    EXPECT_EQ(help.wait(), int(ExitCode::Success));
    for (const char* word :
         {"status", "watch", "stats", "--json", "--timeout", "--domain", "--profile", "69"})
        EXPECT_NE(help.output().find(word), std::string::npos) << word;
    EXPECT_EQ(Child({SLODCTL, "--version"}).wait(), int(ExitCode::Success));
}

TEST_F(WireSlodctl, AStalledServerIsToldFromADeadOne)
{
    Child server(source("5"));
    Connection connection = connect();
    ASSERT_TRUE(reaches(connection, Contact::Live));
    ASSERT_TRUE(reaches(connection, Contact::Stalled));
    EXPECT_EQ(connection.server()->frame, 5U);
    server.signal(SIGKILL);
    EXPECT_TRUE(says(connection, "silent")) << connection.status().reason;
}

// Its participant answers nobody who joins, but holds its ports.
TEST_F(WireSlodctl, AServerThatIsSuspendedIsHintedAt)
{
    const auto said = [&] {
        Child status(slodctl({"status", "--timeout", "0.5"}));
        EXPECT_EQ(status.wait(), int(ExitCode::NoServer));
        return status.errors();
    };
    Child server(source("5"));
    {
        Connection connection = connect();
        ASSERT_TRUE(reaches(connection, Contact::Live));
    }
    server.signal(SIGSTOP);
    EXPECT_NE(said().find("suspended"), std::string::npos);
    server.signal(SIGKILL);
    server.wait();
    EXPECT_EQ(said().find("suspended"), std::string::npos) << "there is none any more";
}

TEST_F(WireSlodctl, OfTwoServersOnADomainNoneIsSteered)
{
    Child one(source("0")), two(source("0"));
    Connection connection = connect();
    ASSERT_TRUE(eventually([&] {
        connection.wait(std::stop_token(), std::chrono::milliseconds(20));
        return connection.other_servers() == 1;
    }));
    Child pause(slodctl({"pause", "--timeout", "30"}));
    EXPECT_EQ(pause.wait(), int(ExitCode::Failure));
    EXPECT_NE(pause.errors().find("2 servers are heard"), std::string::npos) << pause.errors();
    EXPECT_NE(pause.errors().find("nothing was sent"), std::string::npos) << pause.errors();
}

TEST_F(WireSlodctl, AServerThatIsStoppedTakesLeave)
{
    Child server(source("0"));
    Connection connection = connect();
    ASSERT_TRUE(reaches(connection, Contact::Live));
    server.signal(SIGTERM);
    EXPECT_TRUE(says(connection, "stopped")) << connection.status().reason;
    EXPECT_EQ(server.wait(), 0);
}

TEST_F(WireSlodctl, ARestartedServerIsFoundAgain)
{
    Child first(source("0"));
    Connection connection = connect();
    ASSERT_TRUE(reaches(connection, Contact::Live));
    const wire::Uuid before = connection.server()->session;
    first.signal(SIGKILL);
    ASSERT_TRUE(reaches(connection, Contact::NoServer));
    const Child second(source("0"));
    ASSERT_TRUE(reaches(connection, Contact::Live));
    EXPECT_NE(connection.server()->session, before);
}

} // namespace
} // namespace slod
