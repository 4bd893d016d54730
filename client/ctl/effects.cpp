#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

Json row_of(const std::string& name, const client::EffectInfo& effect)
{
    Json row{{"effect", name}};
    row.update(json_of(effect));
    return row;
}

/// Waits for what the server tells of its effects; false when none came in time.
bool wait_for_effects(client::Connection& connection, const std::stop_token& stop,
                      client::Clock::time_point end)
{
    if (!wait_until(connection, stop, end, [&] { return !connection.effects().empty(); })) {
        complain(no_news_sentence("no effects came in time; a server tells of them once a second, and while "
                                  "it is paused never",
                                  connection));
        return false;
    }
    constexpr std::chrono::milliseconds rest_of_list{100}; // told right after
    wait_until(connection, stop, client::Clock::now() + rest_of_list, [] { return false; });
    return true;
}

ExitCode list(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.effects = true});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    if (!wait_for_effects(connection, stop, end))
        return ExitCode::TimedOut;
    std::vector<Json> rows;
    for (const auto& [name, effect] : connection.effects()) {
        if (line.json)
            print(row_of(name, effect), true);
        else
            rows.push_back(row_of(name, effect));
    }
    print_table(rows);
    return ExitCode::Success;
}

} // namespace

ExitCode run_effect(const CommandLine& line, const std::stop_token& stop)
{
    return line.request.kind.empty() ? list(line, stop) : run_steering(line, stop);
}

} // namespace slod::ctl
