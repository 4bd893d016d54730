#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "e2e/server_fixture.hpp"
#include "support/case_rows.hpp"

namespace slod {
namespace {

class Replay : public ServerTest {};

/// A GADGET-2 file (SnapFormat 1, Springel 2005) of eight halo particles at rest, `spacing` apart on a line.
std::string gadget_file(float spacing)
{
    constexpr std::int32_t count = 8;
    std::string bytes;
    const auto record = [&](const void* data, std::size_t size) {
        const auto length = std::uint32_t(size);
        const std::string mark(reinterpret_cast<const char*>(&length), sizeof length);
        bytes += mark + std::string(static_cast<const char*>(data), size) + mark;
    };
    std::array<char, 256> header{};
    const double mass = 1;
    const std::int32_t files = 1;
    std::memcpy(&header[1 * sizeof count], &count, sizeof count); // of type 1, the halo, in this file,
    std::memcpy(&header[24 + 1 * sizeof mass], &mass, sizeof mass);
    std::memcpy(&header[96 + 1 * sizeof count], &count, sizeof count); // and in all files
    std::memcpy(&header[124], &files, sizeof files);
    record(header.data(), header.size());

    std::array<float, 3 * count> positions{}, velocities{};
    std::array<std::uint32_t, count> ids{};
    for (std::uint32_t i = 0; i < count; ++i) {
        positions[3 * i] = spacing * float(i);
        ids[i] = i;
    }
    record(positions.data(), sizeof positions);
    record(velocities.data(), sizeof velocities);
    record(ids.data(), sizeof ids);
    return bytes;
}

TEST_F(Replay, N11_AgreesAtAnotherNumberOfThreadsWithoutTheSceneFile)
{
    const nlohmann::json recorded = reported({"--frames", "40", "--set", "seed=5", "--output-dir", folder_});
    std::filesystem::remove(scene_);
    const ServerRun replay = run_server({"--replay", log_, "--free-run", "--no-dds", "--threads", "3"});
    EXPECT_EQ(replay.exit_code, 0) << replay.output;
    EXPECT_TRUE(contains(replay.output, recorded["state_hash"])) << replay.output;
    test::expect_at_most("replays with another hash", replay.exit_code == 0 ? 0 : 1, 0);
}

TEST_F(Replay, ThatComesOutDifferentlyShowsBothHashes)
{
    const std::string hash = reported({"--frames", "20", "--output-dir", folder_})["state_hash"];
    const std::string other(16, hash[0] == 'a' ? 'b' : 'a');
    std::string log = file_content(log_);
    log.replace(log.rfind(hash), hash.size(), other);
    write_file(log_, log);
    const ServerRun replay = run_server({"--replay", log_, "--free-run", "--no-dds"});
    EXPECT_EQ(replay.exit_code, 1) << replay.output;
    EXPECT_TRUE(contains(replay.output, hash)) << replay.output;
    EXPECT_TRUE(contains(replay.output, other)) << replay.output;
}

TEST_F(Replay, OfAnotherSceneComesOutDifferently)
{
    write_file(scene_, "seed = 1\n" + std::string(fountain));
    reported({"--frames", "20", "--output-dir", folder_});
    std::string log = file_content(log_);
    log.replace(log.find("seed = 1"), 8, "seed = 2");
    write_file(log_, log);
    EXPECT_EQ(run_server({"--replay", log_, "--free-run", "--no-dds"}).exit_code, 1);
}

// A log of one frame; its header is followed by what makes it unfit.
TEST_F(Replay, RefusesALogItCannotRepeat)
{
    reported({"--frames", "1", "--output-dir", folder_});
    const std::string log = file_content(log_);
    const std::string header = log.substr(0, log.find('\n') + 1);
    const std::string end = log.substr(header.size());
    const std::array<std::array<std::string, 2>, 3> cases{{
        {"", "no end"},
        {R"({"frame":1,"command":"dance"})"
         "\n" +
             end,
         "dance"},
        {R"({"frames":0,"state_hash":"0123456789abcdef"})"
         "\n",
         "first frame"},
    }};
    for (const auto& [rest, reason] : cases) {
        write_file(log_, header + rest);
        const ServerRun run = run_server({"--replay", log_, "--no-dds"});
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_TRUE(contains(run.output, reason)) << run.output;
    }
}

// Recorded with the file found through the environment, replayed without that, and again with another file
// there.
TEST_F(Replay, FindsTheRecordedParticlesAndRefusesOthers)
{
    const std::filesystem::path data = folder_ / "stars.gadget2";
    write_file(data, gadget_file(1));
    write_file(scene_, "[[kind]]\nname = \"halo\"\nsoftening = 0.1\n[gravity]\n"
                       "[initial]\nmodel = \"gadget2\"\nfile = \"stars.gadget2\"\n");
    setenv("SLOD_DATA_DIR", folder_.c_str(), 1);
    reported({"--frames", "5", "--output-dir", folder_});
    unsetenv("SLOD_DATA_DIR");
    const Arguments replay{"--replay", log_, "--free-run", "--no-dds"};
    const ServerRun same = run_server(replay);
    EXPECT_EQ(same.exit_code, 0) << same.output;

    write_file(data, gadget_file(2));
    const ServerRun other = run_server(replay);
    EXPECT_EQ(other.exit_code, 2) << other.output;
    EXPECT_TRUE(contains(other.output, data)) << other.output;
}

// What a controller decides depends on the clock, but the log has it.
TEST_F(Replay, N10_AgreesThoughAControllerHeldTheFrameRate)
{
    int others = 0;
    for (const char* mode : {"smooth", "paper", "error"}) {
        const ServerRun held =
            run_server({scene_, "--no-dds", "--frames", "200", "--set", "server.frame_rate=300", "--set",
                        std::string("control.mode=\"") + mode + '"', "--output-dir", folder_});
        EXPECT_EQ(held.exit_code, 0) << held.output;
        EXPECT_TRUE(contains(file_content(log_), "set_detail")) << mode;
        const ServerRun replay = run_server({"--replay", log_, "--free-run", "--no-dds", "--threads", "3"});
        EXPECT_EQ(replay.exit_code, 0) << mode << ": " << replay.output;
        others += replay.exit_code == 0 ? 0 : 1;
    }
    test::expect_at_most("controllers whose replay has another hash", others, 0);
}

// The error goes first, so that only what was measured can have made clusters smaller.
TEST_F(Replay, N10_AgreesThoughAMeasuredErrorTurnedTheSizes)
{
    const std::string galaxy = SLOD_SCENES "/galaxy.toml";
    const ServerRun held = run_server(
        {galaxy, "--no-dds", "--frames", "400", "--set", "galaxy.particles=2000", "--set", "meter.share=0.5",
         "--set", "server.frame_rate=200", "--set", "control.mode=error", "--set", "control.priority=error",
         "--set", "control.target_error=0.01", "--output-dir", folder_});
    ASSERT_EQ(held.exit_code, 0) << held.output;
    double finest = 1;
    std::istringstream log(file_content(log_));
    for (std::string line; std::getline(log, line);) {
        const std::string key = "\"cluster_size=";
        if (const std::size_t found = line.find(key); found != std::string::npos)
            finest = std::min(finest, std::stod(line.substr(found + key.size())));
    }
    test::expect_at_most("finest size that was decided on, of the scene's own", finest, 0.5);
    const ServerRun replay = run_server({"--replay", log_, "--free-run", "--no-dds", "--threads", "3"});
    EXPECT_EQ(replay.exit_code, 0) << replay.output;
    test::expect_at_most("replays with another hash", replay.exit_code == 0 ? 0 : 1, 0);
}

} // namespace
} // namespace slod
