#include "common/server_watch.hpp"

#include <algorithm>
#include <cstdio>

namespace slod::client {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// A simulation that has completed no frame for so long is stalled: four of its frames, and at least as long
/// as nobody takes for a hiccup.
double stall_after_ms(const ServerInfo& info)
{
    constexpr double hiccup_ms = 2000;
    const double frame_ms = info.frame_rate_hz > 0 ? 1000 / info.frame_rate_hz : 0;
    return std::max(hiccup_ms, 4 * frame_ms);
}

std::string seconds(double milliseconds)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.1f s", milliseconds / 1000);
    return text.data();
}

} // namespace

void ServerWatch::on_state(const wire::ServerState& state, Clock::time_point now)
{
    Known& known = known_[wire::uuid_of(state.session)];
    assign(known.info, state);
    known.heard = now;
    known.present = true;
    choose();
}

void ServerWatch::on_gone(const wire::Uuid& session, bool took_leave)
{
    const auto found = known_.find(session);
    if (found == known_.end())
        return;
    // A server that takes leave also falls silent afterwards; its own word is the better reason.
    found->second.took_leave = took_leave || (found->second.took_leave && !found->second.present);
    found->second.present = false;
    choose();
}

/// Stays with the server that is followed; when it is gone, goes to the one that started last.
void ServerWatch::choose()
{
    if (followed_ && known_.at(*followed_).present)
        return;
    std::int64_t latest_start = 0;
    for (const auto& [session, known] : known_)
        if (known.present && known.info.started_ns >= latest_start) {
            latest_start = known.info.started_ns;
            followed_ = session;
        }
    std::erase_if(known_,
                  [this](const auto& entry) { return !entry.second.present && entry.first != followed_; });
}

Status ServerWatch::status(Clock::time_point now) const
{
    if (!followed_)
        return {Contact::NoServer, "none was heard"};
    const Known& known = known_.at(*followed_);
    const double silence_ms = Milliseconds(now - known.heard).count();
    if (!known.present)
        return {Contact::NoServer, known.took_leave ? "the server was stopped"
                                                    : "the server fell silent " + seconds(silence_ms) +
                                                          " ago: it was killed, or the network is cut"};
    const double idle_ms = known.info.idle_ms + silence_ms;
    if (known.info.paused)
        return {Contact::Live, "the simulation is paused"};
    if (idle_ms > stall_after_ms(known.info))
        return {Contact::Stalled, "the server answers, but has completed no frame for " + seconds(idle_ms)};
    return {Contact::Live, {}};
}

const ServerInfo* ServerWatch::server() const
{
    return followed_ ? &known_.at(*followed_).info : nullptr;
}

std::size_t ServerWatch::others() const
{
    const auto present = std::count_if(known_.begin(), known_.end(), [this](const auto& entry) {
        return entry.second.present && entry.first != followed_;
    });
    return static_cast<std::size_t>(present);
}

} // namespace slod::client
