#include <optional>

#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

ExitCode code_of(wire::ResultCode result)
{
    switch (result) {
    case slod_v1_RESULT_APPLIED:
        return ExitCode::Success;
    case slod_v1_RESULT_UNKNOWN_REGION:
        return ExitCode::NotFound;
    case slod_v1_RESULT_NOT_OWNER:
    case slod_v1_RESULT_NOT_PERMITTED:
        return ExitCode::NotPermitted;
    case slod_v1_RESULT_FAILED:
        return ExitCode::Failure;
    default:
        return ExitCode::InvalidArgument;
    }
}

ExitCode show(const client::CommandAnswer& answer, bool as_json)
{
    if (!answer.applied())
        complain(answer.text);
    if (answer.applied() || as_json) {
        Json json{{"result", client::word_of(answer.result)}};
        if (answer.applied())
            json["applied_frame"] = answer.applied_frame;
        if (answer.revision > 0)
            json["revision"] = answer.revision;
        if (!answer.applied()) {
            json["field"] = answer.field;
            json["text"] = answer.text;
        }
        print(json, as_json);
    }
    return code_of(answer.result);
}

} // namespace

ExitCode run_steering(const CommandLine& line, const std::stop_token& stop)
{
    if (const std::string wrong = problem(line.request); !wrong.empty()) {
        complain(wrong);
        return ExitCode::Usage;
    }
    client::Connection connection(line.server.domain, line.server.profile, {});
    client::Commander commander(connection.participant());
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    if (connection.other_servers() > 0) {
        complain("nothing was sent: it would meet one of them by chance");
        return ExitCode::Failure;
    }
    if (!connection.server()->takes_commands()) {
        complain(client::no_commands_sentence());
        return ExitCode::NotPermitted;
    }
    const std::uint64_t number = commander.send(line.request, connection.server()->session);
    std::optional<client::CommandAnswer> answer;
    const auto answered = [&] { return (answer = commander.take_answer(number)).has_value(); };
    if (wait_until(commander, stop, end, answered))
        return show(*answer, line.json);
    complain(commander.connected() ? "the server has not answered in time; wait longer with --timeout"
                                   : "the server could not be reached in time; wait longer with --timeout");
    return ExitCode::TimedOut;
}

} // namespace slod::ctl
