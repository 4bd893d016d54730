#include "stress/observer.hpp"

#include <array>
#include <string>
#include <unistd.h>
#include <utility>

#include "stress/process_use.hpp"

namespace slod::stress {

namespace {

std::string this_host()
{
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

} // namespace

Observer::Observer(std::uint32_t domain, wire::Profile profile, bool regions)
    : connection_(domain, profile, {.stats = true, .regions = regions})
{}

void Observer::wait(const std::stop_token& stop, std::chrono::nanoseconds timeout)
{
    connection_.wait(stop, timeout);
    if (!session_ && connection_.stats())
        session_ = connection_.server()->session;
    if (!sees_server())
        return;
    if (samples_.empty() || samples_.back().frame != connection_.stats()->frame)
        samples_.push_back(sample());
}

/// Statistics are of the server that is followed, so that there is one when there are any.
bool Observer::sees_server() const
{
    return session_ && connection_.stats() && connection_.server()->session == *session_;
}

std::string Observer::absence() const
{
    if (session_ && connection_.server()->session != *session_)
        return "it ended, and another one has taken its place";
    const client::Status status = connection_.status();
    return status.contact == client::Contact::NoServer ? status.reason : "";
}

std::uint64_t Observer::heartbeat() const
{
    return connection_.server() ? connection_.server()->heartbeat : 0;
}

std::vector<ServerSample> Observer::take_samples()
{
    constexpr double silence_s = 1;
    if (!samples_.empty() && sees_server() && sample().when_s - samples_.back().when_s > silence_s)
        samples_.push_back(sample());
    return std::exchange(samples_, {});
}

ServerSample Observer::sample() const
{
    const client::ServerStats& stats = *connection_.stats();
    const client::ServerInfo& server = *connection_.server();
    const std::chrono::duration<double> now = client::Clock::now().time_since_epoch();
    ServerSample sample{.when_s = now.count(),
                        .frame = stats.frame,
                        .published_frames = stats.wire.published_frames,
                        .published_bytes = stats.wire.published_bytes,
                        .delayed_frames = stats.wire.delayed_frames,
                        .refused_samples = stats.wire.refused_samples,
                        .encode_ms = stats.wire.encode_ms,
                        .work_ms = stats.work_ms};
    if (server.host == this_host()) {
        const ProcessUse use = use_of_process(server.process);
        sample.processor_s = use.processor_s;
        sample.network_s = use.network_s;
        sample.resident_mib = use.resident_mib;
    }
    return sample;
}

} // namespace slod::stress
