#include "app/publish_state.hpp"

#include <array>
#include <chrono>
#include <unistd.h>

namespace slod {

namespace {

constexpr std::size_t longest_host_name = 64;

std::string_view host_name(std::array<char, longest_host_name + 1>& buffer)
{
    buffer.fill('\0');
    return gethostname(buffer.data(), longest_host_name) == 0 ? std::string_view(buffer.data()) : "unknown";
}

std::int64_t wall_clock_ns()
{
    using namespace std::chrono;
    return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

} // namespace

StateEncoder::StateEncoder(const wire::Uuid& session, const Publisher::Session& facts,
                           std::span<const std::string_view> topics)
    : topics_(topics.size())
{
    wire::set(message_.session, session);
    message_.particles = facts.particles;
    message_.units = {
        .length_m = facts.units.length_m, .mass_kg = facts.units.mass_kg, .time_s = facts.units.time_s};
    message_.time_step = facts.time_step;
    wire::set(message_.scene_title, facts.scene_title);
    wire::set(message_.version, facts.version);
    wire::set(message_.isa, facts.isa);
    message_.threads = static_cast<std::uint32_t>(facts.threads);
    std::array<char, longest_host_name + 1> host;
    wire::set(message_.host, host_name(host));
    message_.process = static_cast<std::uint32_t>(getpid());
    message_.started_ns = wall_clock_ns();
    for (std::size_t i = 0; i < topics.size(); ++i)
        wire::set(topics_[i].name, topics[i]);
    wire::lend(message_.topics, topics_);
}

void StateEncoder::set_frame(const FrameStamp& stamp, std::uint64_t particles, const LoopStats& loop)
{
    message_.frame = stamp.frame;
    message_.time = stamp.time;
    message_.particles = particles;
    message_.frame_rate_target_hz = loop.frame_rate_target_hz;
    message_.frame_rate_hz = loop.frame_rate_hz;
    message_.real_time_factor = loop.real_time_factor;
}

const wire::ServerState& StateEncoder::encode(double idle_ms, std::uint64_t max_sample_bytes)
{
    ++message_.heartbeat;
    message_.idle_ms = idle_ms;
    message_.max_sample_bytes = max_sample_bytes;
    return message_;
}

} // namespace slod
