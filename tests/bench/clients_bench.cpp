// What clients cost a server: its processor time of a frame with readers and commanders, the server on one
// processor and the clients on another, beside that of a replay of the same run, which has the same commands
// in the same frames and nobody to talk to.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <signal.h>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "e2e/wire_support.hpp"
#include "support/scratch_folder.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;
using slod::test::Child;

struct Options {
    std::uint64_t particles = 1'000'000;
    double frame_rate = 5;
    std::uint32_t subscribers = 64, commanders = 16;
    double seconds = 60;
    bool best_effort = false;
    bool json = false;
};

/// In a session of its own, as Linux shares processors out by session, and on the first processor.
Words server(Words words)
{
    const Words pinned{"/usr/bin/setsid", "/usr/bin/taskset", "-c", "0", SLOD_SERVER};
    words.insert(words.begin(), pinned.begin(), pinned.end());
    words.insert(words.end(), {"--threads", "1"});
    return words;
}

Json read_json(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream)
        throw std::runtime_error("there is no " + file.string());
    return Json::parse(stream);
}

/// The last line of what slod-stress prints.
Json report_of(const Child& load)
{
    const std::string output = load.output();
    const std::size_t last = output.rfind("\n{");
    if (last == std::string::npos)
        throw std::runtime_error("slod-stress gave no report: " + load.errors());
    return Json::parse(output.substr(last));
}

void expect_end(int code, const std::string& what, const Child& child)
{
    if (code != 0)
        throw std::runtime_error(what + " ended with " + std::to_string(code) + ": " + child.errors());
}

struct Runs {
    Json stress, live, replay;
};

Runs run(const Options& options, const std::filesystem::path& folder)
{
    const slod::test::FreeDomain domain;
    Runs runs;
    {
        Child scene(server({SLOD_SCENE, "--domain", domain.text(), "--output-dir", folder / "live",
                            "--report", folder / "live.json", "--set", "control.mode=off", "--set",
                            "galaxy.particles=" + std::to_string(options.particles), "--set",
                            "server.frame_rate=" + std::to_string(options.frame_rate)}));
        Words words{SLOD_STRESS, "--json", "--domain", domain.text(), "--timeout", "120", "--cpus", "1"};
        const auto add = [&](const char* option, const std::string& value) {
            words.insert(words.end(), {option, value});
        };
        add("--subscribers", std::to_string(options.subscribers));
        add("--commanders", std::to_string(options.commanders));
        add("--seconds", std::to_string(options.seconds));
        if (options.best_effort)
            add("--best-effort", std::to_string(options.subscribers));
        Child load(words);
        const int held = load.wait();
        runs.stress = report_of(load);
        runs.stress["held"] = held == 0;
        scene.signal(SIGTERM);
        expect_end(scene.wait(), "slod-server", scene);
    }
    Child replay(server({"--replay", folder / "live" / "input.log", "--domain", domain.text(), "--report",
                         folder / "replay.json"}));
    expect_end(replay.wait(), "the replay", replay);
    runs.live = read_json(folder / "live.json");
    runs.replay = read_json(folder / "replay.json");
    return runs;
}

double frame_ms(const Json& report)
{
    return 1e3 * report["processor_s"].get<double>() / report["frames"].get<double>();
}

/// Of all frames of rest and load, by frame; NaN where the kernel did not say.
double mean(const Json& stress, const char* key)
{
    const Json &rest = stress["rest"], &load = stress["load"];
    const double at_rest = rest["frames"], loaded = load["frames"];
    if (!rest[key].is_number() || !load[key].is_number())
        return std::nan("");
    return (at_rest * rest[key].get<double>() + loaded * load[key].get<double>()) / (at_rest + loaded);
}

Json judge(const Runs& runs)
{
    const double live = frame_ms(runs.live), replay = frame_ms(runs.replay);
    const double encode = mean(runs.stress, "encode_ms");
    return {{"particles", runs.stress["particles"]},
            {"clusters", runs.stress["clusters"]},
            {"subscribers", runs.stress["subscribers"]},
            {"commanders", runs.stress["commanders"]},
            {"commands", runs.stress["commands"]["valid"]["commands"]},
            {"held", runs.stress["held"]},
            {"frames", runs.live["frames"]},
            {"same_hash", runs.live["state_hash"] == runs.replay["state_hash"]},
            {"frame_rate_hz", runs.stress["load"]["frame_rate_hz"]},
            {"rest_ms", runs.stress["rest"]["processor_ms"]},
            {"live_ms", live},
            {"replay_ms", replay},
            {"encode_ms", encode},
            {"network_ms", mean(runs.stress, "network_ms")},
            {"growth_percent", 100 * (live / (replay + encode) - 1)},
            {"growth_over_rest_percent", runs.stress["processor_growth_percent"]}};
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("What clients cost a server, beside the replay of the same run without them");
    Options options;
    app.add_option("--particles", options.particles, "Stars of the galaxy [1000000]")
        ->check(CLI::Range(1000, 100'000'000));
    app.add_option("--frame-rate", options.frame_rate, "Frames per second [5]")
        ->check(CLI::Range(0.1, 1000.0));
    app.add_option("--subscribers", options.subscribers, "Readers [64]")->check(CLI::Range(1, 120));
    app.add_option("--commanders", options.commanders, "Processes that command [16]")
        ->check(CLI::Range(0, 60));
    app.add_option("--seconds", options.seconds, "Time under load [60]")->check(CLI::Range(1.0, 3600.0));
    app.add_flag("--best-effort", options.best_effort, "Readers do not ask for lost samples");
    app.add_flag("--json", options.json, "One JSON object on the last line");
    CLI11_PARSE(app, argc, argv);

    const slod::ScratchFolder folder;
    const Json result = judge(run(options, folder.path()));
    std::printf("%s\n", result.dump(2).c_str());
    if (options.json)
        std::printf("%s\n", result.dump().c_str());
    return result["same_hash"] && result["held"] ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench-clients: %s\n", error.what());
    return 1;
}
