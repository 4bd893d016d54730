#include <string>
#include <string_view>
#include <unistd.h>

#include "common/stream_meter.hpp"
#include "ctl/commands.hpp"
#include "ctl/topic_stream.hpp"

namespace slod::ctl {

namespace {

using client::StreamMeter;

constexpr std::chrono::seconds update_period{1};

/// The samples of a stream that are numbered: by region, where the topic has regions.
template <class Message>
void measure(StreamMeter& meter, const Message& message, const dds_sample_info_t& info)
{
    std::uint64_t serial = 0;
    if constexpr (requires { message.serial; })
        serial = message.serial;
    std::string_view stream;
    if constexpr (TopicStream<Message>::by_region)
        stream = message.region;
    meter.on_sample(stream, serial, wire::wire_bytes(message),
                    std::chrono::nanoseconds(dds_time() - info.source_timestamp), client::Clock::now());
}

/// What the command was asked for of all that is measured.
Json chosen(const std::string& command, const StreamMeter::Report& report)
{
    if (command == "hz")
        return {{"rate_hz", report.rate_hz},
                {"longest_gap_ms", report.longest_gap_ms},
                {"received", report.received},
                {"lost", report.lost}};
    if (command == "bw")
        return {{"bytes_per_s", report.bytes_per_s},
                {"mean_bytes", report.received > 0 ? report.bytes / report.received : 0},
                {"received", report.received},
                {"bytes", report.bytes}};
    return {{"latency_p50_ms", report.latency_p50_ms},
            {"latency_p99_ms", report.latency_p99_ms},
            {"received", report.received}};
}

void warn_of_another_clock(const client::Connection& connection)
{
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    if (connection.server()->host != host.data())
        complain("warning: the server is on " + connection.server()->host +
                 ", and latencies are as wrong as its clock is against this machine's");
}

template <class Message>
ExitCode measure_topic(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    if (line.command == "latency")
        warn_of_another_clock(connection);
    TopicStream<Message> samples(connection.participant(), line.region);
    StreamMeter meter;
    const auto take = [&](const Message& message, const dds_sample_info_t& info) {
        if (info.valid_data)
            measure(meter, message, info);
    };
    client::Clock::time_point next = client::Clock::now();
    for (std::uint64_t update = 0; line.count == 0 || update < line.count; ++update) {
        next += update_period;
        while (client::Clock::now() < next && !stop.stop_requested())
            samples.wait(stop, next - client::Clock::now(), take);
        if (stop.stop_requested())
            return ExitCode::Success;
        const Json update_line = chosen(line.command, meter.report(client::Clock::now()));
        if (line.json)
            print(update_line, true);
        else
            print_line(one_line(update_line));
        connection.poll();
        if (connection.status().contact == client::Contact::NoServer) {
            complain(connection.status().reason);
            return ExitCode::NoServer;
        }
    }
    if (meter.report(client::Clock::now()).received > 0)
        return ExitCode::Success;
    complain(
        "no sample came in that time: is there such a region, and does this server write the topic? Measure "
        "longer with --count");
    return ExitCode::TimedOut;
}

} // namespace

ExitCode run_traffic(const CommandLine& line, const std::stop_token& stop)
{
    return with_topic(line.topic, [&]<class Message>() { return measure_topic<Message>(line, stop); });
}

} // namespace slod::ctl
