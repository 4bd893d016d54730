#include "ctl/command_line.hpp"

#include <string>

#include <CLI/CLI.hpp>

#include "arguments/parsing.hpp"
#include "ctl/commands.hpp"
#include "idl/version.hpp"

namespace slod::ctl {

namespace {

/// Names a word that is no command before it asks for one, unlike CLI11's own requirement. Groups of options
/// are to CLI11 subcommands without a name.
void require_command(const CLI::App& app)
{
    const auto given = app.get_subcommands();
    if (!given.empty() && !given.front()->get_name().empty())
        require_command(*given.front());
    else if (!app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); }).empty())
        throw CLI::RequiredError("A command");
}

void declare(CLI::App& app, CommandLine& line)
{
    app.add_flag("--json", line.json, "Print one JSON object per line");
    client::add_server_options(app, line.server, "Seconds to wait for a server and for the answer");
    app.set_version_flag("--version", "slodctl " + std::string(version()));
    app.callback([&app] { require_command(app); });
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
        "--json, --domain, --profile and --timeout go with every command.\n"
        "Exit codes: 0 done, 1 network not usable or failed in the server, 2 wrong usage, seen without a\n"
        "server, 65 refused as invalid by the server, 66 unknown name, 69 no server, 75 timed out,\n"
        "77 not permitted.\n"
        "Example: slodctl watch --clusters --json --count 10");
    CommandLine line;
    declare(app, line);
    if (const auto code = client::parse(app, argc, argv))
        return *code;
    return line;
}

} // namespace slod::ctl
