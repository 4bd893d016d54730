#pragma once

#include <chrono>
#include <stop_token>

#include "common/connection.hpp"
#include "ctl/command_line.hpp"
#include "ctl/output.hpp"

namespace slod::ctl {

/// The moment at which the user's patience ends.
inline client::Clock::time_point deadline(const CommandLine& line)
{
    return client::Clock::now() +
           std::chrono::duration_cast<client::Clock::duration>(std::chrono::duration<double>(line.timeout_s));
}

/// Waits until `arrived()`; false when the deadline or a stop came first.
template <class Condition>
bool wait_until(client::Connection& connection, const std::stop_token& stop, client::Clock::time_point end,
                const Condition& arrived)
{
    while (!arrived()) {
        const client::Clock::time_point now = client::Clock::now();
        if (now >= end || stop.stop_requested())
            return false;
        connection.wait(stop, end - now);
    }
    return true;
}

/// Waits for a server; says what to do when there is none.
inline bool wait_for_server(client::Connection& connection, const std::stop_token& stop,
                            client::Clock::time_point end)
{
    const auto present = [&] { return connection.status().contact != client::Contact::NoServer; };
    if (wait_until(connection, stop, end, present))
        return true;
    complain(connection.status().reason +
             "; start slod-server, name its --domain and --profile, or wait longer with --timeout");
    return false;
}

/// Warns when frames of the size the server sends do not fit this machine's receive buffers.
inline void warn_of_large_samples(const client::Connection& connection)
{
    if (const auto warning = wire::receive_buffer_warning(connection.server()->max_sample_bytes))
        complain("warning: " + *warning);
}

} // namespace slod::ctl
