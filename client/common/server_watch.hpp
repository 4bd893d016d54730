#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/messages.hpp"

namespace slod::client {

using Clock = std::chrono::steady_clock;

/// How a client stands with its server.
enum class Contact : std::uint8_t {
    NoServer, ///< there is none, or it is gone: see the reason
    Live,     ///< it answers, and its simulation moves or is paused on purpose
    Stalled,  ///< it answers, but its simulation does not move
};

constexpr std::array<std::string_view, 3> names(Contact)
{
    return {"no server", "live", "stalled"};
}

struct Status {
    Contact contact = Contact::NoServer;
    std::string reason; ///< one sentence without its full stop; empty when live and running

    friend bool operator==(const Status&, const Status&) = default;
};

/// Follows one server among those that are heard, and judges whether it is live. Knows no network: what is
/// heard, and when, is handed in.
class ServerWatch {
public:
    /// A server said how it is.
    void on_state(const wire::ServerState& state, Clock::time_point now);

    /// A server is no longer heard. `took_leave`: it said so itself.
    void on_gone(const wire::Uuid& session, bool took_leave);

    Status status(Clock::time_point now) const;

    /// The server that is followed, also when it is gone; null when there never was one.
    const ServerInfo* server() const;

    /// Servers that are heard besides the one that is followed.
    std::size_t others() const;

private:
    struct Known {
        ServerInfo info;
        Clock::time_point heard;
        bool present = true;
        bool took_leave = false;
    };

    void choose();

    std::map<wire::Uuid, Known> known_;
    std::optional<wire::Uuid> followed_;
};

} // namespace slod::client
