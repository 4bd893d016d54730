#include "cost/scene_command.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>
#include <variant>

#include "core/parallel.hpp"
#include "cost/answer.hpp"
#include "cost/command.hpp"
#include "cost/finished_runs.hpp"
#include "cost/html_page.hpp"
#include "cost/report_files.hpp"
#include "cost/sweep.hpp"
#include "idl/gnuplot.hpp"
#include "idl/option_checks.hpp"
#include "idl/version.hpp"
#include "scene/scene.hpp"
#include "simd/kernels.hpp"

namespace slod::cost {
namespace {

/// On a terminal, in place: what runs, how far everything is, and how long it will take.
void show_progress(const std::string& name, double share, double began_ms)
{
    const double left_s = share > 0 ? (wall_milliseconds() - began_ms) * (1 / share - 1) / 1000 : 0;
    std::fprintf(stderr, "\r%3.0f %%  %-28s %4.0f s left ", 100 * share, name.c_str(), left_s);
}

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file);
    stream << text;
    if (!stream.flush())
        throw std::runtime_error("cannot write " + file.string());
}

std::string content(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A scene's text with what was set over it, as remarks.
std::string with_overrides(std::string text, const std::vector<std::string>& overrides)
{
    for (const std::string& override : overrides)
        text += "\n# --set " + override;
    return text;
}

/// Makes names of files absolute that start from the scene's folder.
void find_from_anywhere(Scene& scene, const std::filesystem::path& folder)
{
    for (ColliderSettings& collider : scene.simulation.colliders)
        if (!collider.file.empty())
            collider.file = std::filesystem::absolute(folder / collider.file).lexically_normal().string();
}

} // namespace

SceneCommand::SceneCommand(CLI::App& app)
    : command_(app.add_subcommand("scene", "Sweep motion, cluster size and what else costs time on a scene"))
{
    command_->add_option("SCENE", scene_, "Scene file (TOML)")->option_text("FILE")->required();
    command_
        ->add_option("--out", folder_,
                     "Folder of cost.html, with all in one page, cost.csv, cost.json, cost.png, cost.svg and "
                     "runs.jsonl")
        ->check(writable_folder())
        ->option_text("FOLDER");
    command_->add_option("--input", input_, "Initial conditions, instead of the scene's own")
        ->option_text("FILE");
    command_->add_option("--set", settings_, "A setting, table.key=value, over the scene's; may be repeated")
        ->type_size(1)
        ->allow_extra_args(false)
        ->option_text("KEY=VALUE");
    command_->add_option("--frames", frames_, "Frames of each run; 300, or 100 with --quick")
        ->check(between(10, 1'000'000))
        ->option_text("N");
    add_threads_option(*command_, threads_);
    command_->add_flag("--quick", quick_, "Fewer settings, frames and seeds: some minutes");
    command_->add_flag(
        "--fresh", fresh_,
        "Repeat what was finished before; without it, runs are taken from runs.jsonl in the folder "
        "where scene, frames, threads, version and machine are the same");
    auto* const chosen =
        command_
            ->add_option(
                "--write", chosen_,
                "Scene file to write with the settings found best for --fps or for --error, and with "
                "the controller off. Comments are kept, unless --set changes more than single values")
            ->check(writable_file())
            ->option_text("FILE");
    auto* const rate = command_
                           ->add_option("--fps", wish_.frame_rate_hz,
                                        "With --write: the least error at so many frames a second")
                           ->check(between(0.01, 10'000.0))
                           ->option_text("N")
                           ->needs(chosen);
    command_->add_option("--error", wish_.error, "With --write: the fastest within so many noise floors")
        ->check(between(0.0, 1e30))
        ->option_text("E")
        ->needs(chosen)
        ->excludes(rate);
    command_->footer(
        "An error of 1 is what another seed differs by; below 2 is good, above 3 visible.\n"
        "Exit codes: 0 done, 1 failed, or no setting is good enough to be written, 2 wrong usage, "
        "scene or initial conditions.");
}

Problems SceneCommand::wrong_together() const
{
    if (!chosen_.empty() && !wish_.frame_rate_hz && !wish_.error)
        return {"--write: for what? Add --fps N or --error E."};
    return {};
}

int SceneCommand::run() const
{
    if (const Problems problems = wrong_together(); !problems.empty())
        return complain(problems);
    const auto text = read_scene_text(scene_);
    if (const auto* problems = std::get_if<Problems>(&text))
        return complain(*problems);
    auto loaded = load_scene(std::get<SceneText>(text), settings_);
    if (const auto* problems = std::get_if<Problems>(&loaded))
        return complain(*problems);
    const Scene& scene = std::get<Scene>(loaded);
    const auto first = load_initial(scene, input_);
    if (const auto* problems = std::get_if<Problems>(&first))
        return complain(*problems);
    std::filesystem::create_directories(folder_);

    SweepPlan plan = quick_ ? SweepPlan::quick() : SweepPlan::full();
    if (frames_ > 0)
        plan.frames = frames_;
    const auto& particles = std::get<InitialParticles>(first).particles;
    const FinishedRuns::Json circumstances = {{"scene", fingerprint(scene, particles)},
                                              {"frames", plan.frames},
                                              {"threads", team_size(threads_)},
                                              {"version", std::string(version())},
                                              {"machine", machine_name()},
                                              {"isa", simd::kernels().name}};
    FinishedRuns finished(folder_ / "runs.jsonl", circumstances, fresh_);
    const Sweep found = sweep(scene, plan, finished);
    const int reported = report(found, scene, std::get<SceneText>(text).text, plan.frames);
    return chosen_.empty() ? reported
                           : std::max(reported, write_choice(found.rows, std::get<SceneText>(text), scene));
}

Sweep SceneCommand::sweep(const Scene& scene, const SweepPlan& plan, FinishedRuns& finished) const
{
    const auto initial = [&](std::uint64_t seed) {
        Scene seeded = scene;
        seeded.simulation.seed = seed;
        auto particles = load_initial(seeded, input_);
        if (const auto* problems = std::get_if<Problems>(&particles))
            throw std::runtime_error(problems->front());
        return std::get<InitialParticles>(std::move(particles)).particles;
    };
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    const double began = wall_milliseconds();
    Sweep found;
    ThreadTeam(team_size(threads_)).run([&] {
        const auto show = [&](const std::string& name, double share) {
            if (on_terminal)
                show_progress(name, share, began);
        };
        found = run_sweep(scene.simulation, initial, plan, wall_milliseconds, show, finished);
    });
    if (on_terminal)
        std::fprintf(stderr, "\r%80s\r", "");
    if (found.known > 0)
        std::fprintf(stderr, "slod-cost: %d of %d runs were finished before, in %s; --fresh repeats them.\n",
                     found.known, found.runs, (folder_ / "runs.jsonl").c_str());
    return found;
}

/// Files and what is printed; returns the exit code.
int SceneCommand::report(const Sweep& sweep, const Scene& scene, const std::string& text, int frames) const
{
    const auto& gravity = scene.simulation.gravity;
    const std::string opening = gravity ? opening_of(*gravity).key : "";
    const Circumstances circumstances{.scene = scene.title,
                                      .version = std::string(version()),
                                      .machine = machine_name(),
                                      .particles = std::uint64_t(sweep.rows.front().particles),
                                      .frames = frames,
                                      .threads = team_size(threads_),
                                      .opening = opening};
    write(folder_ / "cost.csv", csv_text(sweep));
    write(folder_ / "cost.json", json_text(sweep, circumstances));
    const std::string undrawn = run_gnuplot(plot_script(sweep, circumstances, folder_ / "cost"));
    write(folder_ / "cost.html",
          html_page(sweep, circumstances, undrawn.empty() ? content(folder_ / "cost.svg") : "",
                    with_overrides(text, settings_)));
    std::printf("%s\n%s", table_text(sweep).c_str(), answer(sweep).c_str());
    if (!undrawn.empty())
        std::fprintf(stderr, "slod-cost: %s\n", undrawn.c_str());
    return undrawn.empty() ? 0 : failed;
}

int SceneCommand::write_choice(const std::vector<Row>& rows, const SceneText& text, const Scene& scene) const
{
    const auto row = choose(rows, wish_);
    if (!row) {
        std::fprintf(stderr, "slod-cost: no setting is good enough; %s is not written.\n", chosen_.c_str());
        return failed;
    }
    Scene chosen = with_choice(scene, row->setting, wish_);
    find_from_anywhere(chosen, text.folder);
    write(chosen_, edited(text, chosen));
    std::printf("%s: %s\n", chosen_.c_str(), row->setting.name().c_str());
    return 0;
}

} // namespace slod::cost
