#include "cost/paper_command.hpp"

#include <cstdio>
#include <unistd.h>
#include <variant>

#include "core/parallel.hpp"
#include "cost/command.hpp"
#include "cost/figure9.hpp"
#include "cost/paper_report.hpp"
#include "idl/gnuplot.hpp"
#include "idl/option_checks.hpp"
#include "idl/version.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t default_droplets = 1'000'000, quick_droplets = 30'000;

PaperPlan quick_plan()
{
    return {.motions = {Motion::Flow, Motion::Rigid},
            .sizes = {4, 8, 16, 32, 64},
            .settle_frames = 4,
            .least_frames = 2,
            .most_frames = 20,
            .run_ms = 100};
}

} // namespace

PaperCommand::PaperCommand(CLI::App& app)
    : command_(
          app.add_subcommand("paper", "Measure the speed-ups of Figures 5 and 9 of O'Brien et al. 2001")),
      scenes_(SLOD_SCENES), droplets_(default_droplets)
{
    command_->add_option("--scenes", scenes_, "Folder of galaxy.toml, fountain.toml and paper-fountain.toml")
        ->option_text("FOLDER");
    command_->add_option("--droplets", droplets_, "Of the fountain; 1000000, or 30000 with --quick")
        ->check(between<std::size_t>(1000, 20'000'000))
        ->option_text("N");
    command_->add_option("--picture", picture_, "Draw Figure 9, the fountain side by side, as PNG or SVG")
        ->check(writable_file())
        ->option_text("FILE");
    add_threads_option(*command_, threads_);
    command_->add_flag("--quick", quick_, "A few frames of each, within seconds: to see that it works");
    command_->add_flag("--json", as_json_, "Print one JSON object instead");
    command_->footer("All have the same threads. Times are means of a frame.\n"
                     "Exit codes: 0 done, whatever came out; 1 failed, 2 wrong usage or scene.");
}

int PaperCommand::run() const
{
    const auto galaxy = load_scene(scenes_ / "galaxy.toml", {});
    if (const auto* problems = std::get_if<Problems>(&galaxy))
        return complain(*problems);
    const auto fountain = load_scene(scenes_ / "fountain.toml", {});
    if (const auto* problems = std::get_if<Problems>(&fountain))
        return complain(*problems);
    const auto with_nozzles = load_scene(scenes_ / "paper-fountain.toml", {});
    if (const auto* problems = std::get_if<Problems>(&with_nozzles))
        return complain(*problems);
    const auto stars = load_initial(std::get<Scene>(galaxy), {});
    if (const auto* problems = std::get_if<Problems>(&stars))
        return complain(*problems);
    return measure(std::get<Scene>(galaxy), std::get<InitialParticles>(stars).particles,
                   std::get<Scene>(fountain), std::get<Scene>(with_nozzles));
}

int PaperCommand::measure(const Scene& galaxy, const ParticleSet& stars, const Scene& fountain,
                          const Scene& with_nozzles) const
{
    const PaperPlan plan = quick_ ? quick_plan() : PaperPlan{};
    const std::size_t droplets = quick_ && droplets_ == default_droplets ? quick_droplets : droplets_;
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    const auto announce = [&](const std::string& name) {
        if (on_terminal)
            std::fprintf(stderr, "\r%-60s", name.c_str());
    };
    PaperRun of_galaxy, of_fountain;
    std::vector<FountainView> views;
    ThreadTeam(team_size(threads_)).run([&] {
        of_galaxy = run_galaxy(galaxy.simulation, stars, plan, wall_milliseconds, announce);
        of_fountain = run_fountain(fountain.simulation, droplets, plan, wall_milliseconds, announce);
        views = view_fountain(with_nozzles.simulation, figure9_s, wall_milliseconds);
    });
    if (on_terminal)
        std::fprintf(stderr, "\r%60s\r", "");
    const nlohmann::ordered_json json = {{"benchmark", "paper"},
                                         {"version", version()},
                                         {"machine", machine_name()},
                                         {"threads", team_size(threads_)},
                                         {"galaxy", json_of(of_galaxy, paper_galaxy)},
                                         {"fountain", json_of(of_fountain, paper_fountain)},
                                         {"figure9", json_of(views)}};
    if (as_json_)
        std::printf("%s\n", json.dump().c_str());
    else
        std::printf("%s, %d threads\n\n%s\n%s\n%s", machine_name().c_str(), team_size(threads_),
                    text(of_galaxy, paper_galaxy).c_str(), text(of_fountain, paper_fountain).c_str(),
                    text(views).c_str());
    const std::string undrawn = picture_.empty() ? "" : run_gnuplot(side_by_side_script(views, picture_));
    if (!undrawn.empty())
        std::fprintf(stderr, "slod-cost: %s\n", undrawn.c_str());
    return undrawn.empty() ? 0 : failed;
}

} // namespace slod::cost
