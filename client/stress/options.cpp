#include "stress/options.hpp"

#include <cstdio>

#include <CLI/CLI.hpp>

#include "arguments/parsing.hpp"
#include "idl/version.hpp"

namespace slod::stress {

namespace {

// The loopback configuration has room for 200 participants on a machine.
constexpr std::uint32_t most_clients = 160;
constexpr double longest_run_s = 86400;
constexpr double highest_rate_hz = 1000;
constexpr double most = 1e9;

CLI::Option* add_count(CLI::App& app, const char* name, std::uint32_t& value, const char* help)
{
    return app.add_option(name, value, help)
        ->check(between<std::uint32_t>(0, most_clients))
        ->option_text("N [" + std::to_string(value) + "]");
}

CLI::Option* add_number(CLI::App& app, const char* name, double& value, double maximum, const char* unit,
                        const char* help)
{
    std::string preset = std::to_string(value);
    preset.erase(preset.find_last_not_of('0') + 1);
    if (preset.back() == '.')
        preset.pop_back();
    return app.add_option(name, value, help)
        ->check(between(0.0, maximum))
        ->option_text(std::string(unit) + " [" + preset + "]");
}

void add_limit(CLI::App& app, const char* name, std::optional<double>& value, const char* unit,
               const char* help)
{
    app.add_option(name, value, help)->check(between(-most, most))->option_text(unit)->group("Limits");
}

void declare_subscribers(CLI::App& app, Options& options)
{
    const char* const group = "Subscribers";
    add_count(app, "--subscribers", options.subscribers, "Processes that read the cluster states")
        ->group(group);
    add_count(app, "--best-effort", options.best_effort, "Of them, do not ask again for what got lost")
        ->group(group);
    add_count(app, "--slow", options.slow, "Of them, sleep after each sample")->group(group);
    add_number(app, "--slow-ms", options.slow_ms, 10000, "MS", "So long")->group(group);
    add_count(app, "--stopped", options.stopped, "Of them, stand still for two seconds in five (SIGSTOP)")
        ->group(group);
    add_count(app, "--joiners", options.joiners, "Of them, join and leave all the time")->group(group);
    app.add_option("--region", options.region, "Read this region of interest alone")
        ->option_text("NAME")
        ->group(group);
}

void declare_commanders(CLI::App& app, Options& options)
{
    const char* const group = "Commanders (rates are each one's, in commands per second)";
    Rates& rates = options.rates;
    add_count(app, "--commanders", options.commanders, "Processes that command")->group(group);
    add_number(app, "--storm", rates.storm, highest_rate_hz, "HZ",
               "Add, move, resize, set and remove regions of their own")
        ->group(group);
    add_number(app, "--malformed", rates.malformed, highest_rate_hz, "HZ",
               "Unknown kinds, bad names, NaN, values out of range, unknown settings")
        ->group(group);
    add_number(app, "--duplicates", rates.duplicates, highest_rate_hz, "HZ",
               "A request number twice, with the same content or another")
        ->group(group);
    add_number(app, "--reordered", rates.reordered, highest_rate_hz, "HZ",
               "Request numbers out of order, and old ones again")
        ->group(group);
    add_number(app, "--impostors", rates.impostors, highest_rate_hz, "HZ",
               "Others' regions, and others' names under numbers they have used")
        ->group(group);
    add_count(app, "--regions", options.regions, "Regions of each commander")->group(group);
    add_number(app, "--extent", options.extent, most, "LENGTH",
               "Regions lie within so far of the origin, in the scene's unit")
        ->group(group);
    app.add_option("--commands", options.commands, "End after so many commands, or when the time is over")
        ->check(at_least_zero<std::uint64_t>())
        ->option_text("N")
        ->group(group);
}

void declare_limits(CLI::App& app, Limits& limits)
{
    add_limit(app, "--max-loss", limits.loss_percent, "PERCENT",
              "Samples lost by steady and best-effort subscribers");
    add_limit(app, "--max-latency-ms", limits.latency_ms, "MS", "Their 99th percentile from write to read");
    add_limit(app, "--max-round-trip-ms", limits.round_trip_ms, "MS",
              "99th percentile of valid commands from write to answer");
    add_limit(app, "--max-cpu-growth", limits.processor_growth_percent, "PERCENT",
              "Processor time of a frame over that at rest and its encoding");
    add_limit(app, "--max-memory-growth-mb", limits.memory_growth_mib, "MIB",
              "Memory that the server takes in the second half");
    add_limit(app, "--min-frame-rate", limits.frame_rate_hz, "HZ", "Frames per second");
}

void declare(CLI::App& app, Options& options)
{
    add_number(app, "--seconds", options.seconds, longest_run_s, "S", "Time under load");
    add_number(app, "--baseline", options.baseline_s, longest_run_s, "S",
               "Time at rest before, to compare with");
    add_number(app, "--settle", options.settle_s, longest_run_s, "S",
               "Time for the clients to find each other before the load counts");
    app.add_flag("--sweep", options.sweep,
                 "Runs with 1, 2, 4 and so on up to --subscribers: where this machine's bandwidth ends");
    app.add_option("--cpus", options.cpus, "Processors that the clients run on, from 0")
        ->delimiter(',')
        ->check(between(0, 1023))
        ->option_text("LIST");
    app.add_option("--seed", options.seed, "Of all that is random")
        ->check(at_least_zero<std::uint64_t>())
        ->option_text("N [1]");
    app.add_flag("--json", options.json, "Print the report as one JSON object on the last line, too");
    app.add_option("--picture", options.picture, "Draw latencies and delivered shares, with gnuplot")
        ->check(writable_png())
        ->option_text("FILE.png");
    client::add_server_options(app, options.server, "Seconds to wait for a server");
    app.set_version_flag("--version", "slod-stress " + std::string(version()));
    declare_subscribers(app, options);
    declare_commanders(app, options);
    declare_limits(app, options.limits);
}

/// What fits each for itself, but not together; empty when it does.
std::string problem(const Options& options)
{
    const std::uint32_t special = options.best_effort + options.slow + options.stopped + options.joiners;
    if (special > options.subscribers)
        return "--best-effort, --slow, --stopped and --joiners are among the --subscribers: name at least " +
               std::to_string(special);
    if (options.subscribers + options.commanders > most_clients)
        return "a machine has room for " + std::to_string(most_clients) +
               " clients in one domain; name fewer";
    const Rates& rates = options.rates;
    const double rough = rates.malformed + rates.duplicates + rates.reordered + rates.impostors;
    if ((options.commands > 0 || rough > 0) && options.commanders == 0)
        return "--commands, --malformed, --duplicates, --reordered and --impostors need somebody who "
               "commands: "
               "name --commanders";
    if (options.commanders > 0 && options.regions == 0)
        return "commanders change regions of their own: name at least one with --regions";
    if (options.seconds == 0)
        return "nothing is measured in no time: name --seconds above 0";
    if (options.sweep && (options.commanders > 0 || special > 0))
        return "--sweep is about steady subscribers alone: leave the others out";
    if (options.sweep && options.subscribers == 0)
        return "--sweep counts subscribers up from 1: name at least one with --subscribers";
    return {};
}

} // namespace

std::variant<Options, ExitCode> parse_options(int argc, const char* const* argv)
{
    CLI::App app("Loads a running slod-server with many clients, each a process of its own, and judges it.",
                 "slod-stress");
    app.footer(
        "The report goes to stdout, everything else to stderr. CYCLONEDDS_URI, when set, replaces the\n"
        "profile. Exit codes: 0 all held, 1 something did not, 2 wrong usage, 66 no such region,\n"
        "69 no server, 75 timed out, 77 not permitted.\n"
        "Example: slod-stress --subscribers 16 --slow 2 --commanders 4 --malformed 5 --max-loss 1");
    Options options;
    declare(app, options);
    if (const auto code = client::parse(app, argc, argv))
        return *code;
    if (const std::string wrong = problem(options); !wrong.empty()) {
        complain(wrong);
        return ExitCode::Usage;
    }
    return options;
}

void complain(const std::string& sentence)
{
    std::fprintf(stderr, "slod-stress: %s\n", sentence.c_str());
}

} // namespace slod::stress
