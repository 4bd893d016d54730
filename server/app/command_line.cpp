#include "app/command_line.hpp"

#include <cstdint>
#include <optional>

#include <CLI/CLI.hpp>

#include "idl/option_checks.hpp"
#include "idl/version.hpp"

namespace slod {
namespace {

/// Options that are short for a setting.
struct Shorthands {
    std::optional<std::uint32_t> threads;
    std::optional<std::uint32_t> domain;
    bool no_dds = false;

    std::vector<std::string> settings() const
    {
        std::vector<std::string> list;
        if (threads)
            list.push_back("server.threads=" + std::to_string(*threads));
        if (domain)
            list.push_back("wire.domain=" + std::to_string(*domain));
        if (no_dds)
            list.emplace_back("wire.enabled=false");
        return list;
    }
};

void declare(CLI::App& app, CommandLine& line, Shorthands& shorthands)
{
    auto* scene = app.add_option("SCENE", line.scene, "Scene file (TOML)")->option_text("FILE");
    auto* input = app.add_option("--input", line.input, "Initial conditions, instead of the scene's own")
                      ->option_text("FILE");
    auto* frames = app.add_option("--frames", line.frames, "Frames to run; without it, until stopped")
                       ->check(at_least_one())
                       ->option_text("N");
    auto* settings = app.add_option("--set", line.settings,
                                    "A setting, table.key=value, over the scene's; may be repeated")
                         ->type_size(1)
                         ->allow_extra_args(false)
                         ->option_text("KEY=VALUE");
    app.add_option("--replay", line.replay,
                   "Input log to run again, instead of SCENE, --input, --frames and --set; fails unless the "
                   "outcome is the same")
        ->option_text("FILE")
        ->excludes(scene)
        ->excludes(input)
        ->excludes(frames)
        ->excludes(settings);
    app.add_flag("--free-run", line.free_run, "Run as fast as possible instead of at server.frame_rate");
    app.add_option("--threads", shorthands.threads, "Short for --set server.threads=N; 0 is one per core")
        ->check(at_least_zero<std::uint32_t>())
        ->option_text("N");
    app.add_flag("--no-dds", shorthands.no_dds, "Short for --set wire.enabled=false");
    app.add_option("--domain", shorthands.domain,
                   "Short for --set wire.domain=N, but of this run alone: input logs do not have it")
        ->check(at_least_zero<std::uint32_t>())
        ->option_text("N");
    app.add_option("--report", line.report, "Write figures of the run, as JSON, at its end")
        ->check(writable_file())
        ->option_text("FILE");
    app.add_option("--trace", line.trace, "Write a line for each frame, as CSV, as the run goes")
        ->check(writable_file())
        ->option_text("FILE");
    app.add_option("--picture", line.picture, "Write a density map of the last state, as PNG")
        ->check(writable_png())
        ->option_text("FILE.png");
    app.add_option("--output-dir", line.output_folder, "Write the input log here, for --replay")
        ->check(writable_folder())
        ->option_text("FOLDER");
    app.add_flag("--explain", line.explain, "Print what the scene comes down to, and run nothing");
    app.add_flag("--check", line.check,
                 "Read scene and initial conditions, say whether they are sound, run nothing");
    app.add_flag("--keys", line.keys,
                 "Print every key of a scene file with unit, default, range and meaning");
    app.set_version_flag("--version", "slod-server " + std::string(version()));
}

} // namespace

std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv)
{
    CLI::App app("Simulates a scene of particles in real time and publishes it over DDS.", "slod-server");
    app.footer("Ctrl-C or SIGTERM ends a run in order.\n"
               "Exit codes: 0 done, 1 failed, 2 wrong usage, scene or initial conditions.\n"
               "Example: slod-server config/scenes/galaxy.toml --free-run --frames 300 --picture galaxy.png");
    CommandLine line;
    Shorthands shorthands;
    declare(app, line, shorthands);
    try {
        app.parse(argc, argv);
        if (line.scene.empty() && line.replay.empty() && !line.keys)
            throw CLI::RequiredError("SCENE");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? ExitCode::Success : ExitCode::Usage;
    }
    line.placement = shorthands.settings();
    return line;
}

} // namespace slod
