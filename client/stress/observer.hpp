#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "common/connection.hpp"
#include "stress/server_use.hpp"

namespace slod::stress {

/// Watches the server from outside the load: its statistics, and where it runs on this host its process.
class Observer {
public:
    /// Throws wire::DdsError with a remedy when the domain cannot be joined.
    Observer(std::uint32_t domain, wire::Profile profile);

    /// Takes in what comes within `timeout`; returns early when something does.
    void watch(const std::stop_token& stop, std::chrono::nanoseconds timeout);

    const client::Connection& connection() const { return connection_; }
    bool sees_server() const { return connection_.stats() && connection_.server(); }

    /// The samples since the last call; after a second's silence one more, of how it is at present.
    std::vector<ServerSample> take_samples();

private:
    ServerSample sample() const;

    client::Connection connection_;
    std::vector<ServerSample> samples_;
};

} // namespace slod::stress
