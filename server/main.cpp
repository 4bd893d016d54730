#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <variant>

#include "app/command_line.hpp"
#include "app/job.hpp"
#include "app/log.hpp"
#include "app/outputs.hpp"
#include "app/server.hpp"
#include "app/status.hpp"
#include "idl/stop_on_signal.hpp"

namespace {

int say(const std::string& text)
{
    std::puts(text.c_str());
    return int(slod::ExitCode::Success);
}

int complain(const slod::Problems& problems, slod::ExitCode code)
{
    for (const std::string& problem : problems)
        std::fprintf(stderr, "slod-server: %s\n", problem.c_str());
    return int(code);
}

} // namespace

int main(int argc, char** argv)
try {
    const slod::StopOnSignal signals; // first: every later thread inherits the blocked signals
    const auto parsed = slod::parse_command_line(argc, argv);
    if (const auto* code = std::get_if<slod::ExitCode>(&parsed))
        return int(*code);
    const auto& line = std::get<slod::CommandLine>(parsed);
    if (line.keys)
        return say(slod::scene_reference());

    auto loaded = slod::load_job(line);
    if (const auto* problems = std::get_if<slod::Problems>(&loaded))
        return complain(*problems, slod::ExitCode::Usage);
    auto& job = std::get<slod::Job>(loaded);
    if (line.check)
        say(slod::soundness(job));
    if (line.explain)
        say(slod::plan_text(job));
    if (line.check || line.explain)
        return int(slod::ExitCode::Success);
    if (signals.token().stop_requested())
        return say("stopped before the first frame");

    slod::Logging logging;
    slod::log_job(job);
    slod::Outputs outputs(line, job.origin); // before the run, which may be long
    slod::StatusDisplay status(logging);
    slod::Server server(job, line.free_run,
                        {.each_second = [&](const slod::RunStatus& now) { status.update(now); },
                         .each_frame = [&](const auto&... what_it_took) { outputs.trace(what_it_took...); },
                         .record = [&](const slod::LoggedCommand& command) { outputs.record(command); }});
    const slod::RunSummary summary = server.run(signals.token());
    const slod::Problems unwritten = outputs.write(job, server, summary);
    const slod::ExitCode outcome = slod::compare_with_log(job, summary);
    return unwritten.empty() ? int(outcome) : complain(unwritten, slod::ExitCode::Failure);
} catch (const std::exception& error) {
    std::fprintf(stderr, "slod-server: %s\n", error.what());
    return int(slod::ExitCode::Failure);
}
