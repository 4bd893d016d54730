#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

ExitCode run_status(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {});
    if (!wait_for_server(connection, stop, deadline(line.server)))
        return ExitCode::NoServer;
    Json answer = json_of(connection.status());
    answer.update(json_of(*connection.server()));
    print(answer, line.json);
    warn_of_large_samples(connection);
    if (connection.other_servers() > 0)
        complain("warning: " + std::to_string(connection.other_servers()) +
                 " more server(s) on this domain; give each its own domain");
    return ExitCode::Success;
}

} // namespace slod::ctl
