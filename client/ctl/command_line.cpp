#include "ctl/command_line.hpp"

#include "arguments/parsing.hpp"

#include <string>

#include <CLI/CLI.hpp>

#include "ctl/commands.hpp"
#include "idl/version.hpp"

namespace slod::ctl {

namespace {

void declare(CLI::App& app, CommandLine& line)
{
    app.add_flag("--json", line.json, "Print one JSON object per line");
    client::add_server_options(app, line.server, "Seconds to wait for a server and for the answer");
    app.set_version_flag("--version", "slodctl " + std::string(version()));
    app.require_subcommand(1);
    app.fallthrough();
    for (const CommandEntry& command : commands()) {
        CLI::App* const sub = app.add_subcommand(std::string(command.name), std::string(command.help));
        command.declare(*sub, line);
        sub->callback([&line, &command] { line.command = command.name; });
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
    if (const auto code = client::parse(app, argc, argv))
        return *code;
    return line;
}

} // namespace slod::ctl
