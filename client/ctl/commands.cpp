#include "ctl/commands.hpp"

#include <array>

#include <CLI/CLI.hpp>

#include "arguments/parsing.hpp"
#include "ctl/declarations.hpp"

namespace slod::ctl {

namespace {

void declare_nothing(CLI::App&, CommandLine&) {}

void declare_watch(CLI::App& app, CommandLine& line)
{
    app.add_option("--count", line.count, "End after so many updates; without it, on Ctrl-C")
        ->check(at_least_one())
        ->option_text("N");
    app.add_flag("--clusters", line.clusters,
                 "Receive the cluster states too; show their rate, latency, loss");
    app.add_flag("--best-effort", line.best_effort, "With --clusters: do not ask again for what got lost");
}

void declare_stats(CLI::App& app, CommandLine& line)
{
    app.add_option("NAME", line.names,
                   "Values to print, such as work_ms or phases_ms.forces; without it, all");
}

void declare_topic(CLI::App& app, CommandLine& line)
{
    app.add_option("TOPIC", line.topic, "Such as clusters, stats or roi_state; slod/v1/ may stand before it")
        ->required();
    app.add_option("--region", line.region, "Of topics by region: this one alone; without it, all")
        ->option_text("NAME");
}

void declare_traffic(CLI::App& app, CommandLine& line)
{
    declare_topic(app, line);
    app.add_option("--count", line.count, "End after so many seconds; without it, on Ctrl-C")
        ->check(at_least_one())
        ->option_text("N");
}

void declare_echo(CLI::App& app, CommandLine& line)
{
    declare_topic(app, line);
    CLI::Option* const count =
        app.add_option("--count", line.count,
                       "End after so many samples, which must come within --timeout; without it, on Ctrl-C")
            ->check(at_least_one())
            ->option_text("N");
    app.add_flag_callback(
           "--once", [&line] { line.count = 1; }, "End after one sample")
        ->excludes(count);
}

constexpr std::array all_commands{
    CommandEntry{"status", "Say which server there is, what it runs and whether it is live or stalled.",
                 declare_nothing, run_status},
    CommandEntry{"watch", "Show once a second how the server and the connection do, until Ctrl-C.",
                 declare_watch, run_watch},
    CommandEntry{"stats", "Print the statistics of one frame: times by phase, counts, conserved quantities.",
                 declare_stats, run_stats},
    CommandEntry{"errors", "Print the errors of accelerations, measured while the scene runs, by region.",
                 declare_nothing, run_errors},
    CommandEntry{"hz", "Measure how often samples of a topic arrive, and how many are lost.", declare_traffic,
                 run_traffic},
    CommandEntry{"bw", "Measure the bytes of a topic's samples.", declare_traffic, run_traffic},
    CommandEntry{"latency", "Measure the time from the write to the read of a topic's samples.",
                 declare_traffic, run_traffic},
    CommandEntry{"echo", "Print the samples of a topic as they arrive.", declare_echo, run_echo},
    CommandEntry{"roi", "List, show, add, move, resize, set and remove regions of interest.", declare_roi,
                 run_roi},
    CommandEntry{"effect", "List the effects and what they cost, change them, switch them on and off.",
                 declare_effect, run_effect},
    CommandEntry{"pause", "Stop the passage of scene time.", declare_simple, run_steering},
    CommandEntry{"resume", "Let a paused scene go on.", declare_simple, run_steering},
    CommandEntry{"step", "Run some frames while paused.", declare_step, run_steering},
    CommandEntry{"set", "Change settings of the running scene.", declare_set, run_steering},
    CommandEntry{"target", "Hold a frame rate, an error, or both.", declare_target, run_steering},
    CommandEntry{"stop", "End the server in order.", declare_simple, run_steering},
};

} // namespace

std::span<const CommandEntry> commands()
{
    return all_commands;
}

} // namespace slod::ctl
