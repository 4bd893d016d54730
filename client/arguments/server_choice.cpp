#include "arguments/server_choice.hpp"

#include "arguments/parsing.hpp"
#include "common/waiting.hpp"

namespace slod::client {

namespace {

constexpr double longest_timeout_s = 86400;

} // namespace

void add_server_options(CLI::App& app, ServerChoice& server, const std::string& timeout_help)
{
    app.add_option("--domain", server.domain,
                   "DDS domain of the server, 0 to " + std::to_string(wire::last_domain))
        ->check(between<std::uint32_t>(0, wire::last_domain))
        ->option_text("N [0]");
    add_choice(app, "--profile", server.profile, "Where to look: loopback (this machine) or lan");
    app.add_option("--timeout", server.timeout_s, timeout_help)
        ->check(between(0.0, longest_timeout_s))
        ->option_text("SECONDS [3]");
}

Clock::time_point deadline(const ServerChoice& server)
{
    return Clock::now() + from_seconds(server.timeout_s);
}

std::string no_server_sentence(const Status& status)
{
    return status.reason +
           "; start slod-server, name its --domain and --profile, or wait longer with --timeout";
}

std::string no_news_sentence(const std::string& missing, const Connection& connection)
{
    const Status status = connection.status();
    std::string remedy = "wait longer with --timeout";
    if (status.contact == Contact::NoServer)
        remedy = "start it again";
    else if (connection.server()->paused)
        remedy = "let it go on with slodctl resume";
    return missing + (status.reason.empty() ? "" : ": " + status.reason) + "; " + remedy;
}

std::string no_commands_sentence()
{
    return "the server takes no commands; start it with wire.commands = true";
}

std::string late_regions_sentence()
{
    return "not all regions came in time; wait longer with --timeout";
}

std::string no_region_sentence(const std::string& name)
{
    return "there is no region named " + name + "; slodctl roi list prints all of them";
}

} // namespace slod::client
