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

ExitCode list(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.effects = true});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    const auto told = [&] { return !connection.effects().empty(); };
    if (!wait_for_report(connection, stop, end, told,
                         "no effects came in time; a server tells of them once a second, and while it is "
                         "paused never"))
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
