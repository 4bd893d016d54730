#include "ctl/command_line.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "ctl/commands.hpp"
#include "idl/version.hpp"

namespace slod::ctl {

namespace {

constexpr std::uint32_t last_domain = 230;
constexpr double longest_timeout_s = 86400;

std::vector<std::string> profile_names()
{
    const auto all = names(wire::Profile{});
    return {all.begin(), all.end()};
}

wire::Profile profile_of(const std::string& name)
{
    const std::vector<std::string> all = profile_names();
    return wire::Profile(std::find(all.begin(), all.end(), name) - all.begin());
}

void declare(CLI::App& app, CommandLine& line)
{
    app.add_flag("--json", line.json, "Print one JSON object per line");
    app.add_option("--timeout", line.timeout_s, "Seconds to wait for a server and for the answer")
        ->check(CLI::Range(0.0, longest_timeout_s))
        ->option_text("SECONDS [3]");
    app.add_option("--domain", line.domain, "DDS domain of the server, 0 to 230")
        ->check(CLI::Range(std::uint32_t{0}, last_domain))
        ->option_text("N [0]");
    app.add_option_function<std::string>(
           "--profile", [&line](const std::string& name) { line.profile = profile_of(name); },
           "Where to look: loopback (this machine) or lan")
        ->check(CLI::IsMember(profile_names()))
        ->option_text("NAME [loopback]");
    app.set_version_flag("--version", "slodctl " + std::string(version()));
    app.require_subcommand(1);
    app.fallthrough();
    for (const CommandEntry& command : commands()) {
        CLI::App* const sub = app.add_subcommand(std::string(command.name), std::string(command.help));
        command.declare(*sub, line);
        sub->callback([&line, &command] { line.command = command.name; });
    }
}

ExitCode code_of(const CLI::ParseError& error)
{
    switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::Success:
        return ExitCode::Success;
    case CLI::ExitCodes::ConversionError:
    case CLI::ExitCodes::ValidationError:
        return ExitCode::InvalidArgument;
    default:
        return ExitCode::Usage;
    }
}

} // namespace

std::variant<CommandLine, ExitCode> parse_command_line(int argc, const char* const* argv)
{
    CLI::App app("Looks after a running slod-server over DDS.", "slodctl");
    app.footer(
        "Data goes to stdout, everything else to stderr. CYCLONEDDS_URI, when set, replaces the profile.\n"
        "Exit codes: 0 done, 1 network not usable, 2 wrong usage, 65 invalid value, 66 unknown name,\n"
        "69 no server, 75 timed out, 77 not permitted.\n"
        "Example: slodctl watch --clusters --json --count 10");
    CommandLine line;
    declare(app, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        app.exit(error);
        return code_of(error);
    }
    return line;
}

} // namespace slod::ctl
