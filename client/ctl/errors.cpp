#include <cmath>

#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

/// What one line of the table says: percent, the median with its interval.
Json row_of(const std::string& region, const client::MeasuredError& error)
{
    const auto percent = [](double share) { return std::round(1e5 * share) / 1e3; };
    return {{"region", region.empty() ? "(all)" : region},
            {"samples", error.samples},
            {"frames", std::to_string(error.oldest_frame) + "-" + std::to_string(error.newest_frame)},
            {"median_%", percent(error.median.value)},
            {"low_%", percent(error.median.low)},
            {"high_%", percent(error.median.high)},
            {"p90_%", percent(error.p90.value)},
            {"p99_%", percent(error.p99.value)},
            {"max_%", percent(error.max)},
            {"target_%", error.target > 0 ? Json(percent(error.target)) : Json("-")}};
}

} // namespace

ExitCode run_errors(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.errors = true});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    const auto measured = [&] { return connection.error() != nullptr; };
    if (!wait_for_report(connection, stop, end, measured,
                         "no error was measured in time; it is where the scene has gravity or other effects "
                         "of place, and meter.enabled is true"))
        return ExitCode::TimedOut;
    std::vector<Json> rows;
    for (const auto& [region, error] : connection.errors()) {
        if (line.json) {
            Json json{{"region", region}};
            json.update(json_of(error));
            print(json, true);
        } else {
            rows.push_back(row_of(region, error));
        }
    }
    print_table(rows);
    return ExitCode::Success;
}

} // namespace slod::ctl
