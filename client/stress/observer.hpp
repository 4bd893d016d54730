#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "common/connection.hpp"
#include "stress/server_use.hpp"

namespace slod::stress {

/// Watches the server from outside the load: its statistics, and where it runs on this host its process.
class Observer {
public:
    /// Reads the regions of interest, too, where asked to. Throws wire::DdsError with a remedy when the
    /// domain cannot be joined.
    Observer(std::uint32_t domain, wire::Profile profile, bool regions);

    /// Takes in what comes within `timeout`; returns early when something does.
    void wait(const std::stop_token& stop, std::chrono::nanoseconds timeout);

    const client::Connection& connection() const { return connection_; }

    /// Whether the server speaks: the first one that did, and no other that came in its place.
    bool sees_server() const;

    /// Why the server is not there, as a sentence without its full stop; empty when it is.
    std::string absence() const;

    /// Grows with every sign of life of whichever server is followed; 0 when none ever was.
    std::uint64_t heartbeat() const;

    /// The samples of that server since the last call; after a second's silence one more, of how it is at
    /// present.
    std::vector<ServerSample> take_samples();

private:
    ServerSample sample() const;

    client::Connection connection_;
    std::optional<wire::Uuid> session_; ///< of the first server that was seen
    std::vector<ServerSample> samples_;
};

} // namespace slod::stress
