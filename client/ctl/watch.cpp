#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

constexpr std::chrono::seconds update_period{1};

/// What one update says.
Json update_of(const client::Connection& connection, bool with_clusters)
{
    const client::Status status = connection.status();
    Json update = json_of(status);
    if (status.contact != client::Contact::NoServer) {
        const client::ServerInfo& server = *connection.server();
        update["frame"] = server.frame;
        update["time"] = server.time;
        update["frame_rate_hz"] = server.frame_rate_hz;
        update["real_time_factor"] = server.real_time_factor;
        update["particles"] = server.particles;
        if (server.alarms > 0)
            update["alarms"] = server.alarms;
    }
    if (const client::ServerStats* stats = connection.stats()) {
        update["work_ms"] = stats->work_ms;
        update["clusters"] = stats->clusters;
    }
    if (const client::MeasuredError* error = connection.error())
        update["error"] = {{"median", error->median.value},
                           {"low", error->median.low},
                           {"high", error->median.high},
                           {"p99", error->p99.value}};
    if (with_clusters) {
        update["complete_frames"] = connection.complete_frames();
        update["receive"] = json_of(connection.clusters_traffic());
    }
    return update;
}

/// Characters that fit on a line of the terminal that stdout is; 0 when it is none.
std::size_t terminal_width()
{
    winsize size{};
    const bool terminal = isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
    return terminal ? size.ws_col : 0;
}

/// Shows updates one below the other, or on a terminal each in the place of the one before.
class Display {
public:
    explicit Display(bool as_json) : as_json_(as_json) {}

    void show(const Json& update)
    {
        const std::size_t width = terminal_width();
        if (as_json_)
            print(update, true);
        else if (width == 0)
            print_line(one_line(update));
        else
            redraw(update, width);
        std::fflush(stdout);
    }

private:
    void redraw(const Json& update, std::size_t width)
    {
        if (lines_ > 0)
            std::printf("\033[%zuA\033[J", lines_); // up so many lines, and clear from there
        const std::vector<std::string> lines = lines_of(update);
        for (const std::string& line : lines)
            print_line(line.substr(0, width - 1));
        lines_ = lines.size();
    }

    bool as_json_;
    std::size_t lines_ = 0; ///< on the terminal
};

} // namespace

ExitCode run_watch(const CommandLine& line, const std::stop_token& stop)
{
    const client::Subscription subscription{.stats = true,
                                            .clusters = line.clusters,
                                            .errors = true,
                                            .repair = line.best_effort ? wire::Repair::GoOn
                                                                       : wire::Repair::AskAgain};
    client::Connection connection(line.server.domain, line.server.profile, subscription);
    if (!wait_for_server(connection, stop, deadline(line.server)))
        return ExitCode::NoServer;
    Display display(line.json);
    client::Clock::time_point next = client::Clock::now();
    for (std::uint64_t update = 0; line.count == 0 || update < line.count; ++update) {
        next += update_period;
        wait_until(connection, stop, next, [] { return false; });
        if (stop.stop_requested())
            break;
        display.show(update_of(connection, line.clusters));
    }
    if (stop.stop_requested())
        return ExitCode::Success;
    if (connection.status().contact == client::Contact::NoServer) {
        complain(connection.status().reason);
        return ExitCode::NoServer;
    }
    if (line.clusters)
        warn_of_large_samples(connection);
    return ExitCode::Success;
}

} // namespace slod::ctl
