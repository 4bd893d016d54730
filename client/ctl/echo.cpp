#include "ctl/commands.hpp"
#include "ctl/message_json.hpp"
#include "ctl/topic_stream.hpp"

namespace slod::ctl {

namespace {

/// Looks after a server that ends while nothing comes.
constexpr std::chrono::milliseconds look_around{200};

/// What is left of an instance that is no more is its key.
Json gone(Json message)
{
    return {{"gone", std::move(message)}};
}

template <class Message>
ExitCode echo(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.regions = !line.region.empty()});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    TopicStream<Message> samples(connection.participant(), line.region);
    std::uint64_t printed = 0;
    const auto enough = [&] { return line.count > 0 && printed >= line.count; };
    while (!enough() && !stop.stop_requested()) {
        samples.wait(stop, look_around, [&](const Message& message, const dds_sample_info_t& info) {
            if (enough())
                return;
            print(info.valid_data ? json_of(message) : gone(json_of(message)), line.json);
            if (!line.json)
                print_line("---");
            ++printed;
        });
        connection.poll();
        if (line.count > 0 && !enough() && client::Clock::now() >= end) {
            if (connection.lacks_region(line.region)) {
                complain(client::no_region_sentence(line.region));
                return ExitCode::NotFound;
            }
            complain("no sample came in time: does this server write the topic? Wait longer with --timeout");
            return ExitCode::TimedOut;
        }
        if (connection.status().contact == client::Contact::NoServer) {
            complain(connection.status().reason);
            return ExitCode::NoServer;
        }
    }
    return ExitCode::Success;
}

} // namespace

ExitCode run_echo(const CommandLine& line, const std::stop_token& stop)
{
    return with_topic(line.topic, [&]<class Message>() { return echo<Message>(line, stop); });
}

} // namespace slod::ctl
