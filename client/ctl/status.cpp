#include "common/alarm_board.hpp"
#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

/// The alarms that the server says it has, as far as they come in time, by name.
Json alarms_of(client::Connection& connection, const std::stop_token& stop, client::Clock::time_point end)
{
    client::AlarmBoard board(connection.participant());
    Json alarms;
    const auto all_here = [&] {
        board.poll();
        alarms = Json::object();
        for (const auto& [key, alarm] : board.entries())
            if (key.first == connection.server()->session)
                alarms[key.second] = std::string(client::word_of(alarm.severity)) + ": " + alarm.text;
        return alarms.size() >= connection.server()->alarms;
    };
    client::wait_until(connection, stop, end, all_here);
    return alarms;
}

} // namespace

ExitCode run_status(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    Json answer = json_of(connection.status());
    answer.update(json_of(*connection.server()));
    const Json alarms = alarms_of(connection, stop, end);
    answer["alarms"] = alarms.empty() && !line.json ? Json("none") : alarms;
    print(answer, line.json);
    warn_of_large_samples(connection);
    return ExitCode::Success;
}

} // namespace slod::ctl
