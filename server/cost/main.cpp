#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/parallel.hpp"
#include "cost/answer.hpp"
#include "cost/report_files.hpp"
#include "cost/sweep.hpp"
#include "idl/gnuplot.hpp"
#include "idl/version.hpp"

namespace {

using namespace slod;

constexpr int failed = 1, wrong = 2;

struct CommandLine {
    std::filesystem::path scene, input, folder = "cost";
    std::vector<std::string> settings;
    bool quick = false;
    int frames = 0;
    int threads = 0;
};

int complain(const Problems& problems)
{
    for (const std::string& problem : problems)
        std::fprintf(stderr, "slod-cost: %s\n", problem.c_str());
    return wrong;
}

double milliseconds()
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// On a terminal, in place: what runs, how far everything is, and how long it will take.
void show_progress(const std::string& name, double share, double began_ms)
{
    const double left_s = share > 0 ? (milliseconds() - began_ms) * (1 / share - 1) / 1000 : 0;
    std::fprintf(stderr, "\r%3.0f %%  %-28s %4.0f s left ", 100 * share, name.c_str(), left_s);
}

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file);
    stream << text;
    if (!stream.flush())
        throw std::runtime_error("cannot write " + file.string());
}

int measure(const CommandLine& line)
{
    auto loaded = load_scene(line.scene, line.settings);
    if (const auto* problems = std::get_if<Problems>(&loaded))
        return complain(*problems);
    const Scene& scene = std::get<Scene>(loaded);
    if (const auto first = load_initial(scene, line.input); std::holds_alternative<Problems>(first))
        return complain(std::get<Problems>(first));
    std::filesystem::create_directories(line.folder);

    const auto initial = [&](std::uint64_t seed) {
        Scene seeded = scene;
        seeded.simulation.seed = seed;
        auto particles = load_initial(seeded, line.input);
        if (const auto* problems = std::get_if<Problems>(&particles))
            throw std::runtime_error(problems->front());
        return std::get<InitialParticles>(std::move(particles)).particles;
    };
    cost::SweepPlan plan = line.quick ? cost::SweepPlan::quick() : cost::SweepPlan::full();
    if (line.frames > 0)
        plan.frames = line.frames;
    const int threads =
        line.threads > 0 ? line.threads : int(std::max(std::thread::hardware_concurrency(), 1U));
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    const double began = milliseconds();
    ThreadTeam team(threads);
    cost::Sweep sweep;
    team.run([&] {
        sweep = cost::run_sweep(scene.simulation, initial, plan, milliseconds,
                                [&](const std::string& name, double share) {
                                    if (on_terminal)
                                        show_progress(name, share, began);
                                });
    });
    if (on_terminal)
        std::fprintf(stderr, "\r%60s\r", "");

    std::array<char, 65> host{};
    gethostname(host.data(), host.size() - 1);
    const cost::Circumstances circumstances{.scene = scene.title,
                                            .version = std::string(version()),
                                            .machine = std::string(host.data()) + ", " +
                                                       std::to_string(std::thread::hardware_concurrency()) +
                                                       " processors",
                                            .particles = sweep.rows.front().clusters,
                                            .frames = plan.frames,
                                            .threads = threads};
    write(line.folder / "cost.csv", cost::csv_text(sweep));
    write(line.folder / "cost.json", cost::json_text(sweep, circumstances));
    const std::string undrawn = run_gnuplot(cost::plot_script(sweep, circumstances, line.folder / "cost"));
    std::printf("%s\n%s", cost::table_text(sweep).c_str(), cost::answer(sweep).c_str());
    if (!undrawn.empty())
        std::fprintf(stderr, "slod-cost: %s\n", undrawn.c_str());
    return undrawn.empty() ? 0 : failed;
}

} // namespace

int main(int argc, char** argv)
try {
    CLI::App app("What accuracy costs in time: runs a scene at many settings, and compares each with the "
                 "unclustered run.\nExample: slod-cost scene config/scenes/galaxy.toml --quick --out cost");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string(version()));
    CommandLine line;
    CLI::App* const scene = app.add_subcommand("scene", "Sweep motion and cluster size on a scene");
    scene->add_option("SCENE", line.scene, "Scene file (TOML)")->option_text("FILE")->required();
    scene->add_option("--out", line.folder, "Folder of cost.csv, cost.json, cost.png and cost.svg")
        ->option_text("FOLDER");
    scene->add_option("--input", line.input, "Initial conditions, instead of the scene's own")
        ->option_text("FILE");
    scene->add_option("--set", line.settings, "A setting, table.key=value, over the scene's; may be repeated")
        ->type_size(1)
        ->allow_extra_args(false)
        ->option_text("KEY=VALUE");
    scene->add_option("--frames", line.frames, "Frames of each run; 300, or 100 with --quick")
        ->check(CLI::Range(10, 1'000'000))
        ->option_text("N");
    scene->add_option("--threads", line.threads, "Threads; without it, one per core")
        ->check(CLI::Range(1, 1024))
        ->option_text("N");
    scene->add_flag("--quick", line.quick, "Fewer settings, frames and seeds: some minutes");
    scene->footer("An error of 1 is what another seed differs by; below 2 is good, above 3 visible.\n"
                  "Exit codes: 0 done, 1 failed, 2 wrong usage, scene or initial conditions.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : wrong;
    }
    return measure(line);
} catch (const std::exception& error) {
    std::fprintf(stderr, "slod-cost: %s\n", error.what());
    return failed;
}
