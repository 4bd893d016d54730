#include <algorithm>
#include <chrono>
#include <random>
#include <string>

#include "common/waiting.hpp"
#include "stress/crew.hpp"
#include "stress/run.hpp"

namespace slod::stress {

namespace {

using client::Clock;

/// Between two looks at the clients.
constexpr std::chrono::milliseconds look_period{20};

/// For many clients at once to find the server.
constexpr std::chrono::seconds longest_start{60};

/// For a client to report: it waits for answers and news twice.
constexpr std::chrono::seconds longest_end{45};

/// Of a server, which gives a sign of life twice a second: as long as its simulation may stand still.
constexpr std::chrono::seconds longest_silence{5};

/// Names of regions that no other run has.
std::string new_run()
{
    constexpr std::uint32_t runs = 1000000;
    return "stress" + std::to_string(std::random_device()() % runs) + "-";
}

Reader reader_of(std::uint32_t index, const Options& options)
{
    const std::array<std::pair<Reader, std::uint32_t>, 4> special{{{Reader::BestEffort, options.best_effort},
                                                                   {Reader::Slow, options.slow},
                                                                   {Reader::Stopped, options.stopped},
                                                                   {Reader::Joining, options.joiners}}};
    for (const auto& [reader, count] : special) {
        if (index < count)
            return reader;
        index -= count;
    }
    return Reader::Steady;
}

std::vector<Order> orders_of(const Options& options, const wire::Uuid& session)
{
    std::vector<Order> orders;
    const std::string run = new_run();
    for (std::uint32_t i = 0; i < options.subscribers + options.commanders; ++i) {
        Order& order = orders.emplace_back();
        if (i < options.subscribers)
            order.reader = reader_of(i, options);
        order.index = i;
        order.run = run;
        order.session = session;
        order.domain = options.server.domain;
        order.profile = std::uint32_t(options.server.profile);
        order.seed = options.seed + i;
        order.region = options.region;
        order.sleep_ms = options.slow_ms;
        order.rates = options.rates;
        order.regions = options.regions;
        order.extent = options.extent;
        if (options.commands > 0)
            order.commands = (options.commands + options.commanders - 1) / options.commanders;
    }
    return orders;
}

/// Watches the server and the crew until `condition()`, `patience` ends or stop is requested.
template <class Condition>
void watch_until(Observer& observer, Crew& crew, Clock::duration patience, const std::stop_token& stop,
                 const Condition& condition)
{
    const Clock::time_point end = Clock::now() + patience;
    while (!condition() && !stop.stop_requested() && Clock::now() < end) {
        observer.wait(stop, look_period);
        crew.poll();
    }
}

/// Why the server is not there after the load; empty when it has given a sign of life since `heartbeat`.
std::string loss_of_server(Observer& observer, Crew& crew, std::uint64_t heartbeat)
{
    const auto heard = [&] { return observer.heartbeat() > heartbeat; };
    watch_until(observer, crew, longest_silence, std::stop_token(),
                [&] { return heard() || !observer.absence().empty(); });
    if (const std::string absence = observer.absence(); !absence.empty())
        return absence;
    return heard() ? "" : "it has been silent since the load ended";
}

/// The server as it was when the load began; what it said since where it is still there.
void describe(Report& report, const client::ServerInfo& server, const Observer& observer)
{
    const client::Connection& connection = observer.connection();
    report.scene = server.scene_title;
    report.host = server.host;
    report.version = server.version;
    if (!observer.sees_server())
        return;
    report.sample_bytes = connection.server()->max_sample_bytes;
    report.particles = connection.stats()->particles;
    report.clusters = connection.stats()->clusters;
}

} // namespace

ServerUse observe_rest(Observer& observer, double seconds, const std::stop_token& stop)
{
    observer.take_samples();
    client::wait_until(observer, stop, Clock::now() + client::from_seconds(seconds), [] { return false; });
    return use_of(observer.take_samples());
}

Report load(Observer& observer, const Options& options, const ServerUse& rest, const std::stop_token& stop)
{
    const client::ServerInfo server = *observer.connection().server();
    Crew crew(orders_of(options, server.session));
    watch_until(observer, crew, longest_start, stop, [&] { return crew.unready() == 0; });
    if (const std::size_t unready = crew.unready(); unready > 0 && !stop.stop_requested())
        complain(std::to_string(unready) +
                 " clients have not found the server in time; the report has what they saw from then on");
    watch_until(observer, crew, client::from_seconds(options.settle_s), stop, [] { return false; });
    observer.take_samples();
    crew.begin(Clock::now());
    watch_until(observer, crew, client::from_seconds(options.seconds), stop, [&] {
        crew.stop_and_go(Clock::now());
        return options.commands > 0 && crew.commanders_done();
    });
    const std::vector<ServerSample> samples = observer.take_samples();
    const std::uint64_t heartbeat = observer.heartbeat();
    std::string lost_server = observer.absence();
    crew.end();
    if (stop.stop_requested())
        complain("the clients wait for answers to what they have sent, and report: up to " +
                 std::to_string(longest_end.count()) + " s; Ctrl-\\ ends all at once, without a report");
    watch_until(observer, crew, longest_end, std::stop_token(), [&] { return crew.all_done(); });
    if (lost_server.empty())
        lost_server = loss_of_server(observer, crew, heartbeat);

    Report report{.subscribers = options.subscribers,
                  .commanders = options.commanders,
                  .missing_workers = crew.missing(),
                  .lost_server = lost_server,
                  .rest = rest,
                  .load = use_of(samples),
                  .commands = report_of(crew.commanders())};
    report.readers = report_of(crew.subscribers(), report.load.seconds);
    describe(report, server, observer);
    return report;
}

} // namespace slod::stress
