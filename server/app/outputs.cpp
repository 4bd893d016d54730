#include "app/outputs.hpp"

#include <cstdio>
#include <exception>
#include <system_error>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "app/picture.hpp"
#include "app/report.hpp"
#include "scene/content_hash.hpp"

namespace slod {
namespace {

std::string picture_of(const Job& job, const Simulation& simulation, const RunSummary& summary)
{
    const PictureCaption caption{.scene = job.scene.title,
                                 .units = job.scene.simulation.units,
                                 .time = summary.time,
                                 .clusters = summary.clusters};
    return draw_picture(simulation.particles(), viewing_plane(job.scene.simulation), caption).png();
}

} // namespace

Outputs::Outputs(const CommandLine& line, const InputLogHeader& origin)
{
    if (!line.report.empty())
        report_.emplace(line.report);
    if (!line.picture.empty())
        picture_.emplace(line.picture);
    if (!line.output_folder.empty())
        input_log_.emplace(line.output_folder, origin);
    if (!line.trace.empty())
        trace_.emplace(line.trace);
}

void Outputs::record(const LoggedCommand& command)
{
    if (!input_log_)
        return;
    try {
        input_log_->record(command);
    } catch (const std::system_error& error) {
        spdlog::error(
            "{}; the run goes on, but cannot be repeated from frame {} on: make room and start anew "
            "to have a whole log",
            error.what(), command.frame);
        input_log_.reset();
    }
}

void Outputs::trace(const Snapshot& snapshot, const FrameTime& took, const ControlReport& regulation)
{
    if (!trace_)
        return;
    try {
        trace_->add(snapshot, took, regulation);
    } catch (const std::system_error& error) {
        spdlog::error("{}; the run goes on, but its trace ends with frame {}", error.what(), snapshot.frame);
        trace_.reset();
    }
}

Problems Outputs::write(const Job& job, const Server& server, const RunSummary& summary)
{
    Problems failures;
    const auto attempt = [&](const auto& write_one) {
        try {
            write_one();
        } catch (const std::exception& error) {
            failures.emplace_back(error.what());
        }
    };
    if (input_log_)
        attempt([&] { input_log_->finish({.frames = summary.frames, .state_hash = summary.state_hash}); });
    if (trace_)
        attempt([&] { trace_->finish(); });
    if (report_)
        attempt([&] {
            report_->commit(report({.scene = job.scene,
                                    .plan = server.simulation().plan(),
                                    .summary = summary,
                                    .initial_source = job.initial.source,
                                    .isa = server.simulation().isa(),
                                    .threads = server.threads()}));
        });
    if (picture_)
        attempt([&] { picture_->commit(picture_of(job, server.simulation(), summary)); });
    return failures;
}

ExitCode compare_with_log(const Job& job, const RunSummary& summary)
{
    if (!job.expected)
        return ExitCode::Success;
    const std::string now = hash_text(summary.state_hash);
    const std::string then = hash_text(job.expected->state_hash);
    if (summary.frames != job.expected->frames)
        fmt::print(stderr, "slod-server: the replay was stopped at frame {} of {}; nothing was compared\n",
                   summary.frames, job.expected->frames);
    else if (now != then)
        fmt::print(stderr,
                   "slod-server: the replay came out differently: state_hash={} recorded={} frames={}\n", now,
                   then, summary.frames);
    else
        fmt::print("replay agrees: state_hash={} frames={}\n", now, summary.frames);
    return summary.frames == job.expected->frames && now == then ? ExitCode::Success : ExitCode::Failure;
}

} // namespace slod
