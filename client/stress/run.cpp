#include "stress/run.hpp"

#include <cstdio>
#include <optional>
#include <sched.h>
#include <string>

#include "common/waiting.hpp"
#include "idl/gnuplot.hpp"
#include "stress/picture.hpp"

namespace slod::stress {

namespace {

/// For this process and those it starts. False where it may not run on each: Linux leaves out those that are
/// not there.
bool run_on(const std::vector<int>& cpus)
{
    if (cpus.empty())
        return true;
    cpu_set_t asked, given;
    CPU_ZERO(&asked);
    for (const int cpu : cpus)
        CPU_SET(std::size_t(cpu), &asked);
    return sched_setaffinity(0, sizeof asked, &asked) == 0 &&
           sched_getaffinity(0, sizeof given, &given) == 0 && CPU_EQUAL(&asked, &given);
}

/// What would make the figures mean something else; empty when nothing does.
std::string caveat(const Options& options, const client::Connection& connection, const ServerUse& rest)
{
    if (rest.published_frames > 0)
        return "others read cluster states while the server was to be at rest";
    if (connection.other_servers() > 0)
        return "there is more than one server on this domain; give each its own";
    if (connection.server()->paused)
        return "the simulation is paused";
    if (options.subscribers > 0)
        if (const auto warning = wire::receive_buffer_warning(connection.server()->max_sample_bytes))
            return *warning;
    return {};
}

/// Waits until it is known whether the region to read, where one is named, is there; complains when it is
/// not.
ExitCode find_region(Observer& observer, const Options& options, const std::stop_token& stop,
                     client::Clock::time_point end)
{
    if (options.region.empty())
        return ExitCode::Success;
    const client::Connection& connection = observer.connection();
    const auto there = [&] { return connection.regions().contains(options.region); };
    const auto absent = [&] { return connection.lacks_region(options.region); };
    if (!client::wait_until(observer, stop, end, [&] { return there() || absent(); })) {
        complain(client::late_regions_sentence());
        return ExitCode::TimedOut;
    }
    if (there())
        return ExitCode::Success;
    complain(client::no_region_sentence(options.region));
    return ExitCode::NotFound;
}

/// One run, or for a sweep one for each number of subscribers as long as the server is there; at least one.
std::vector<Report> reports_of(Observer& observer, const Options& options, const std::stop_token& stop)
{
    const ServerUse rest = observe_rest(observer, options.baseline_s, stop);
    if (!options.sweep)
        return {load(observer, options, rest, stop)};
    std::vector<Report> reports;
    Options step = options;
    step.subscribers = 1;
    do {
        reports.push_back(load(observer, step, rest, stop));
        std::fputs(sweep_line(reports.back()).c_str(), stdout);
        std::fflush(stdout);
        step.subscribers *= 2;
    } while (step.subscribers <= options.subscribers && reports.back().lost_server.empty() &&
             !stop.stop_requested());
    return reports;
}

void print_json(const std::vector<Report>& reports, const Limits& limits, bool sweep)
{
    Json list = Json::array();
    for (const Report& report : reports) {
        list.push_back(json_of(report));
        list.back()["checks"] = json_of(checks(report, limits));
    }
    std::puts((sweep ? Json{{"sweep", list}} : list.at(0)).dump().c_str());
}

bool draw(const std::vector<Report>& reports, const Options& options)
{
    if (options.picture.empty())
        return true;
    const std::string script = options.sweep ? sweep_script(reports, options.picture)
                                             : load_script(reports.front(), options.picture);
    const std::string problem = run_gnuplot(script);
    if (!problem.empty())
        complain("cannot draw " + options.picture + ": " + problem);
    return problem.empty();
}

} // namespace

ExitCode run(const Options& options, const std::stop_token& stop)
{
    if (!run_on(options.cpus)) {
        complain("not all processors that --cpus names are there for this program; "
                 "name some of those that taskset --cpu-list --pid $$ lists");
        return ExitCode::Usage;
    }
    Observer observer(options.server.domain, options.server.profile, !options.region.empty());
    const client::Clock::time_point end = deadline(options.server);
    if (!client::wait_until(observer, stop, end, [&] { return observer.sees_server(); })) {
        const client::Connection& connection = observer.connection();
        const client::Status status = connection.status();
        const bool absent = status.contact == client::Contact::NoServer;
        complain(absent ? no_server_sentence(status)
                        : no_news_sentence("no statistics came in time", connection));
        return absent ? ExitCode::NoServer : ExitCode::TimedOut;
    }
    if (options.commanders > 0 && !observer.connection().server()->takes_commands()) {
        complain(client::no_commands_sentence());
        return ExitCode::NotPermitted;
    }
    if (const ExitCode code = find_region(observer, options, stop, end); code != ExitCode::Success)
        return code;
    const std::vector<Report> reports = reports_of(observer, options, stop);
    if (const std::string warning = caveat(options, observer.connection(), reports.front().rest);
        !warning.empty())
        complain("warning: " + warning);
    bool held = true;
    for (const Report& report : reports) {
        const std::vector<Check> judged = checks(report, options.limits);
        held = held && all_held(judged);
        if (!options.sweep)
            std::fputs((text_of(report) + text_of(judged)).c_str(), stdout);
        else if (!all_held(judged))
            std::fputs((sweep_line(report) + text_of(judged)).c_str(), stdout);
    }
    const bool drawn = draw(reports, options);
    if (options.json)
        print_json(reports, options.limits, options.sweep);
    return held && drawn ? ExitCode::Success : ExitCode::Failure;
}

} // namespace slod::stress
