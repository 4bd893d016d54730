#include <csignal>
#include <fstream>
#include <sys/stat.h>

#include "e2e/server_fixture.hpp"
#include "support/case_rows.hpp"

namespace slod {
namespace {

using Json = nlohmann::json;

class Server : public ServerTest {};

TEST_F(Server, RunsTheFramesAskedForAndReportsThem)
{
    const Json report = reported({"--frames", "60", "--threads", "3"});
    EXPECT_EQ(report["frames"], 60);
    EXPECT_EQ(report["scene"], "A small fountain");
    EXPECT_EQ(report["threads"], 3);
    EXPECT_EQ(report["counts"]["born"], 6000) << "a second of simulated time";
    EXPECT_EQ(report["particles"].get<int>() + report["counts"]["died"].get<int>(), 6000);
    EXPECT_TRUE(report["phases"].contains("emit"));
    EXPECT_FALSE(report["phases"].contains("forces")) << "nothing in the scene calls for them";
    EXPECT_EQ(report["state_hash"].get<std::string>().size(), 16U);
    EXPECT_EQ(report["settings"]["emitter"][0]["rate"], 6000);
}

// What decides how and where a scene runs has no part in what comes out.
TEST_F(Server, N06_PaceThreadsAndWireDoNotChangeTheOutcome)
{
    int other = 0;
    const auto compare = [&](const Json& hash, const Json& expected) {
        other += hash == expected ? 0 : 1;
        EXPECT_EQ(hash, expected);
    };
    const Json expected = reported({"--frames", "30"})["state_hash"];
    compare(reported({"--frames", "30", "--threads", "1"})["state_hash"], expected);
    const ServerRun paced =
        run_server({scene_, "--frames", "30", "--domain", "117", "--set", "server.frame_rate=1000", "--set",
                    "control.mode=\"off\"", "--report", report_});
    EXPECT_EQ(paced.exit_code, 0) << paced.output;
    compare(Json::parse(file_content(report_))["state_hash"], expected);
    test::expect_at_most("ways of running that change the outcome", other, 0);
    EXPECT_NE(reported({"--frames", "30", "--set", "seed=2"})["state_hash"], expected)
        << "the hash says nothing";
}

class StopSignal : public Server, public testing::WithParamInterface<int> {};

// A frame lasts 100 seconds here, nearly all of it the pacer's wait. The server must neither sit that out (it
// counts as hanging before) nor begin another frame.
TEST_P(StopSignal, EndsTheRunWithinTheFrame)
{
    ServerProcess server({scene_, "--no-dds", "--set", "server.frame_rate=0.01", "--report", report_});
    ASSERT_TRUE(server.prints(" started ")) << server.output();
    server.signal(GetParam());
    EXPECT_EQ(server.wait(), 0) << server.output();
    EXPECT_LE(Json::parse(file_content(report_))["frames"], 1);
}

INSTANTIATE_TEST_SUITE_P(Both, StopSignal, testing::Values(SIGINT, SIGTERM));

TEST_F(Server, NamesFileLineAndKeyOfEveryMistakeInAScene)
{
    write_file(scene_,
               "title = \"bad\"\n[time]\nstep = -1.0\n[[kind]]\nname = \"water\"\n[motion]\nclok = 0.2\n");
    const ServerRun run = run_server({scene_, "--no-dds", "--frames", "1"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(contains(run.output, scene_.string() + ":3")) << run.output;
    EXPECT_TRUE(contains(run.output, "time.step")) << run.output;
    EXPECT_TRUE(contains(run.output, scene_.string() + ":7")) << run.output;
    EXPECT_TRUE(contains(run.output, "motion.clok")) << run.output;
}

TEST_F(Server, RefusesWrongSettingsOnTheCommandLine)
{
    for (const Arguments& wrong :
         {Arguments{"--set", "time.step=-1"}, Arguments{"--threads", "5000"}, Arguments{"--domain", "999"},
          Arguments{"--set", "no.such.key=1"}, Arguments{"--set", "server.isa=avx9"},
          Arguments{"--input", (folder_ / "none.gadget2").string()}}) {
        Arguments arguments{scene_, "--no-dds", "--frames", "1"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        const ServerRun run = run_server(arguments);
        EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(wrong) << run.output;
    }
}

TEST_F(Server, RefusesWhatIsNoSceneFile)
{
    for (const std::string& file :
         {(folder_ / "none.toml").string(), folder_.string(), std::string("/dev/zero")}) {
        const ServerRun run = run_server({file, "--no-dds", "--frames", "1"});
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_TRUE(contains(run.output, file + ": ")) << run.output;
    }
}

// A pipe gives its text once: to the run and to its log.
TEST_F(Server, TakesASceneFromAPipe)
{
    const std::filesystem::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    ServerProcess server({pipe, "--no-dds", "--free-run", "--frames", "5", "--output-dir", folder_});
    write_file(pipe, fountain);
    EXPECT_EQ(server.wait(), 0) << server.output();
    EXPECT_EQ(run_server({"--replay", log_, "--no-dds", "--free-run"}).exit_code, 0);
}

// The signal comes while the server waits for its scene, whose stars take it long enough to notice.
TEST_F(Server, StoppedBeforeItsFirstFrameEndsInOrder)
{
    const std::filesystem::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    ServerProcess server({pipe, "--no-dds", "--report", report_});
    {
        std::ofstream scene(pipe); // opens when the server does
        server.signal(SIGTERM);
        scene
            << "[[kind]]\nname = \"disc\"\n[[kind]]\nname = \"bulge\"\n[[kind]]\nname = \"halo\"\n[gravity]\n"
               "[initial]\nmodel = \"galaxy\"\n[galaxy]\nparticles = 100000\n";
    }
    EXPECT_EQ(server.wait(), 0) << server.output();
    EXPECT_TRUE(contains(server.output(), "stopped before the first frame")) << server.output();
    EXPECT_FALSE(std::filesystem::exists(report_)) << "there is nothing to report";
}

// Were the place tried only at the end, this would run for ever: there is no --frames.
TEST_F(Server, RefusesAPlaceItCannotWriteBeforeTheFirstFrame)
{
    const std::string place = folder_ / "none" / "file";
    write_file(folder_ / "file", "");
    const std::string no_folder = folder_ / "file" / "folder";
    for (const Arguments& output : {Arguments{"--report", place}, Arguments{"--picture", place},
                                    Arguments{"--trace", place}, Arguments{"--output-dir", no_folder}}) {
        const ServerRun run = run_server({scene_, "--no-dds", output[0], output[1]});
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_TRUE(contains(run.output, output[0] + ": ")) << run.output;
        EXPECT_FALSE(contains(run.output, " started ")) << run.output;
    }
}

TEST_F(Server, DrawsAPicture)
{
    const std::filesystem::path picture = folder_ / "picture.png";
    reported({"--frames", "30", "--picture", picture});
    EXPECT_EQ(file_content(picture).substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST_F(Server, AnOutputThatCannotBeWrittenCostsNoOther)
{
    const std::filesystem::path picture = folder_ / "picture.png", report = folder_ / "report.json";
    std::filesystem::create_symlink("/dev/full", report); // by way of a link, lest the device be replaced
    const ServerRun run = run_server({scene_, "--no-dds", "--free-run", "--frames", "5", "--report", report,
                                      "--picture", picture, "--output-dir", folder_});
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_TRUE(contains(run.output, "cannot write " + report.string())) << run.output;
    EXPECT_GT(std::filesystem::file_size(picture), 0U);
    EXPECT_EQ(run_server({"--replay", log_, "--no-dds", "--free-run"}).exit_code, 0);
}

TEST_F(Server, ChecksExplainsAndListsKeysWithoutRunning)
{
    const ServerRun check = run_server({scene_, "--check"});
    EXPECT_EQ(check.exit_code, 0) << check.output;
    EXPECT_TRUE(contains(check.output, "sound")) << check.output;
    const ServerRun bowl = run_server({SLOD_SCENES "/bowl.toml", "--check"});
    EXPECT_TRUE(contains(bowl.output, "stepped-bowl.obj has 312 triangles from [")) << bowl.output;
    const ServerRun explained = run_server({scene_, "--explain"});
    EXPECT_EQ(explained.exit_code, 0);
    EXPECT_TRUE(contains(explained.output, "emit")) << explained.output;
    const ServerRun both = run_server({scene_, "--check", "--explain"});
    EXPECT_EQ(both.output, check.output + explained.output);
    const ServerRun keys = run_server({"--keys"});
    EXPECT_EQ(keys.exit_code, 0);
    EXPECT_TRUE(contains(keys.output, "max_cluster_size")) << keys.output;
    for (const ServerRun& run : {check, explained, keys})
        EXPECT_FALSE(contains(run.output, " started ")) << run.output;
}

} // namespace
} // namespace slod
