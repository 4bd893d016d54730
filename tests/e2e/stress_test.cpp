#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <signal.h>
#include <sstream>
#include <string>
#include <vector>

#include "e2e/command_fixture.hpp"
#include "support/case_rows.hpp"

// slod-stress against the real server, over loopback.
namespace slod {
namespace {

using nlohmann::json;
using test::Child;

class Stress : public CommandTest {
protected:
    Words stress(Words words) const
    {
        words.insert(words.begin(), SLOD_STRESS);
        words.insert(words.end(), {"--domain", domain.text(), "--timeout", "30", "--settle", "0"});
        return words;
    }

    /// Runs slod-stress to its end; its exit code, and in `report` what --json printed.
    int load(Words words)
    {
        words.emplace_back("--json");
        Child child(stress(words));
        const int code = child.wait();
        const std::string output = child.output();
        const std::size_t last = output.rfind("\n{");
        report = last == std::string::npos ? json() : json::parse(output.substr(last));
        said = output + child.errors();
        return code;
    }

    json report;
    std::string said;
};

/// State letters of the processes whose command line has `word` (proc(5)).
std::string states_of(const std::string& word)
{
    const auto text_of = [](const std::filesystem::path& path) { // a process may end meanwhile
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    };
    std::string states;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
        if (text_of(entry.path() / "cmdline").find(word) != std::string::npos) {
            const std::string stat = text_of(entry.path() / "stat");
            const std::size_t bracket = stat.rfind(')');
            states += bracket == std::string::npos ? "" : stat.substr(bracket + 2, 1);
        }
    return states;
}

TEST_F(Stress, N21_ASmallCrowdOfEveryKindLeavesTheServerAndItsStateAsTheyShouldBe)
{
    Child running(server());
    ASSERT_EQ(load({"--subscribers", "6",  "--slow",      "1",  "--stopped",    "1",  "--joiners",   "1",
                    "--commanders",  "3",  "--malformed", "20", "--duplicates", "10", "--reordered", "10",
                    "--impostors",   "10", "--seconds",   "6",  "--baseline",   "1"}),
              0)
        << said;
    EXPECT_EQ(report.at("readers").size(), 4U) << "steady, slow, stopped and joining";
    test::expect_at_least("kinds of readers served at once", double(report.at("readers").size()), 4);
    for (const json& readers : report.at("readers"))
        EXPECT_GT(readers.at("received"), 0) << readers;
    const json& commands = report.at("commands");
    for (const char* conduct : {"valid", "rough"})
        EXPECT_EQ(commands.at(conduct).at("contradicted"), 0) << conduct;
    EXPECT_GT(commands.at("valid").at("results").at("applied"), 0);
    for (const char* kind : {"malformed", "duplicate", "duplicate with other content", "numbers out of order",
                             "another's region", "another's name"})
        EXPECT_GT(commands.at("kinds").value(kind, 0), 0) << kind;
    EXPECT_GT(report.at("load").at("processor_ms"), 0);
    EXPECT_EQ(control({"status"}), 0);
    EXPECT_EQ(answer.at("regions"), 1) << "the clients have tidied up";
    EXPECT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_EQ(replay(), 0) << "what was applied is in the log, and nothing else";
}

// SLOD_STRESS_COMMANDS in the environment asks for more of them.
TEST_F(Stress, N22_CommandsThatNoClientShouldSendAreEachAnsweredAndChangeNothing)
{
    const char* const asked = std::getenv("SLOD_STRESS_COMMANDS");
    const std::string count = asked ? asked : "4000";
    Child running(server());
    ASSERT_EQ(
        load({"--subscribers", "0",   "--commanders", "4",   "--storm",     "20",  "--malformed", "400",
              "--duplicates",  "150", "--reordered",  "150", "--impostors", "400", "--seconds",   "3600",
              "--baseline",    "0",   "--commands",   count}),
        0)
        << said;
    const json& rough = report.at("commands").at("rough");
    EXPECT_GE(rough.at("commands").get<int>() + report.at("commands").at("valid").at("commands").get<int>(),
              std::stoi(count));
    for (const char* refusal : {"invalid", "unsupported", "unknown_region", "not_owner", "stale_revision",
                                "region_exists", "not_permitted"})
        EXPECT_GT(rough.at("results").value(refusal, 0), 0) << refusal;
    EXPECT_EQ(control({"status"}), 0);
    test::report_value("commands that no client should send", rough.at("commands").get<double>());
    test::expect_at_most("regions they left behind", answer.at("regions").get<double>() - 1, 0);
    EXPECT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_EQ(replay(), 0);
}

TEST_F(Stress, TheExitCodeSaysWhetherLimitsHeld)
{
    EXPECT_EQ(Child({SLOD_STRESS, "--domain", domain.text(), "--timeout", "0.2"}).wait(), 69);
    const Child running(server());
    const Words brief{"--subscribers", "1", "--seconds", "2", "--baseline", "0"};
    const auto with = [&brief](Words words) {
        words.insert(words.begin(), brief.begin(), brief.end());
        return words;
    };
    EXPECT_EQ(load(with({"--max-latency-ms", "60000", "--max-loss", "100"})), 0) << said;
    EXPECT_EQ(load(with({"--max-latency-ms", "0"})), 1);
    EXPECT_NE(said.find("NOT HELD  latency p99 [ms] at most 0"), std::string::npos) << said;
    EXPECT_EQ(load(with({"--max-round-trip-ms", "1000"})), 1) << "nobody commands, so nothing is measured";
    EXPECT_EQ(load({"--subscribers", "2", "--slow", "3"}), 2);
    EXPECT_EQ(load(with({"--picture", (scratch.path() / "no folder" / "load.png").string()})), 2);
    EXPECT_NE(said.find("--picture: there is no folder "), std::string::npos) << said;
    EXPECT_EQ(load({"--commands", "5"}), 2) << "and nobody commands";
    EXPECT_EQ(load({"--malformed", "5"}), 2) << "likewise";
    EXPECT_EQ(load({"--commanders", "1", "--regions", "0"}), 2);
    EXPECT_EQ(load({"--seconds", "0"}), 2);
    EXPECT_EQ(load({"--sweep", "--subscribers", "0"}), 2);
    EXPECT_EQ(load({"--cpus", "0,1023"}), 2) << "Linux itself would take the first alone";
    EXPECT_EQ(load({"--subscribers", "many"}), 2);
    EXPECT_EQ(load({"--lunch"}), 2);
}

TEST_F(Stress, ARegionThatIsNotThereIsNamedBeforeAnyLoad)
{
    Child running(server());
    EXPECT_EQ(load({"--subscribers", "1", "--region", "nosuch", "--seconds", "1", "--baseline", "0"}),
              int(ctl::ExitCode::NotFound));
    EXPECT_NE(said.find("no region named nosuch"), std::string::npos) << said;
    ASSERT_EQ(control({"roi", "add", "near", "--centre", "0,0,0", "--radius", "5"}), 0) << answer;
    EXPECT_EQ(load({"--subscribers", "1", "--region", "near", "--seconds", "1", "--baseline", "0"}), 0)
        << said;
    EXPECT_GT(report.at("readers").at(0).at("received"), 0) << report;
}

TEST_F(Stress, ASweepHasAReportForEachNumberOfSubscribersAndAPicture)
{
    const Child running(server());
    const std::filesystem::path picture = scratch.path() / "sweep.png";
    ASSERT_EQ(load({"--sweep", "--subscribers", "4", "--seconds", "1", "--baseline", "0", "--picture",
                    picture.string()}),
              0)
        << said;
    ASSERT_EQ(report.at("sweep").size(), 3U);
    EXPECT_EQ(report.at("sweep").at(2).at("subscribers"), 4);
    EXPECT_GT(std::filesystem::file_size(picture), 1000U);
}

TEST_F(Stress, NoClientOutlivesTheProgram)
{
    const Child running(server());
    const std::string mark = "mark-" + std::to_string(getpid());
    ASSERT_EQ(control({"roi", "add", mark, "--radius", "1"}), 0);
    const auto clients = [&] { return states_of("\"region\":\"" + mark); };
    const Child load(stress({"--subscribers", "3", "--stopped", "1", "--commanders", "1", "--seconds", "600",
                             "--baseline", "0", "--region", mark}));
    ASSERT_TRUE(test::eventually([&] { return clients().find('T') != std::string::npos; }))
        << "one stands still: " << clients() << load.errors();
    EXPECT_EQ(clients().size(), 4U);
    load.signal(SIGKILL);
    EXPECT_TRUE(test::eventually([&] { return clients().empty(); })) << clients();
}

// Killed, it takes no leave: that it is gone is seen by its silence alone. One reader stands still from the
// third second of the load to the fifth, which shows that it is under way.
TEST_F(Stress, AServerThatIsKilledUnderLoadDoesNotHold)
{
    const std::string mark = "mark-" + std::to_string(getpid());
    for (const bool starts_again : {false, true}) {
        SCOPED_TRACE(starts_again ? "and starts again" : "for good");
        const Child killed(server());
        ASSERT_EQ(control({"roi", "add", mark, "--radius", "1"}), 0);
        Child load(stress({"--subscribers", "2", "--stopped", "1", "--seconds", "12", "--baseline", "0",
                           "--region", mark}));
        ASSERT_TRUE(test::eventually([&] {
            return states_of("\"region\":\"" + mark).find('T') != std::string::npos;
        })) << load.errors();
        killed.signal(SIGKILL);
        const auto again = starts_again ? std::make_unique<Child>(server()) : nullptr;
        EXPECT_EQ(load.wait(), 1) << load.output() << load.errors();
        EXPECT_NE(load.output().find("NOT HELD  the server is there, and the same one"), std::string::npos)
            << load.output();
    }
}

TEST_F(Stress, AnInterruptEndsTheRunWithAReport)
{
    const Child running(server());
    const std::string mark = "mark-" + std::to_string(getpid());
    ASSERT_EQ(control({"roi", "add", mark, "--radius", "1"}), 0);
    Child load(stress({"--subscribers", "2", "--seconds", "600", "--baseline", "0", "--region", mark}));
    ASSERT_TRUE(test::eventually([&] { return states_of("\"region\":\"" + mark).size() == 2; }));
    load.signal(SIGINT);
    EXPECT_EQ(load.wait(), 0) << load.errors();
    EXPECT_NE(load.errors().find("the clients wait for answers"), std::string::npos) << load.errors();
    EXPECT_NE(load.output().find("2 steady"), std::string::npos) << load.output();
    EXPECT_EQ(states_of("\"region\":\"" + mark), "");
}

} // namespace
} // namespace slod
