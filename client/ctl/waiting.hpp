#pragma once

#include <stop_token>

#include "common/connection.hpp"
#include "common/waiting.hpp"
#include "ctl/command_line.hpp"
#include "ctl/output.hpp"

namespace slod::ctl {

/// Waits for a server; says what to do when there is none, and warns when more are heard, of which one is
/// followed.
inline bool wait_for_server(client::Connection& connection, const std::stop_token& stop,
                            client::Clock::time_point end)
{
    const auto present = [&] { return connection.status().contact != client::Contact::NoServer; };
    if (!wait_until(connection, stop, end, present)) {
        complain(no_server_sentence(connection.status()));
        return false;
    }
    constexpr std::chrono::milliseconds others{100}; // what a server last said reaches who joins late at once
    wait_until(connection, stop, client::Clock::now() + others, [] { return false; });
    if (connection.other_servers() > 0)
        complain("warning: " + std::to_string(1 + connection.other_servers()) +
                 " servers are heard on this domain, and this is of one of them, \"" +
                 connection.server()->scene_title + "\"; give each its own (--domain, wire.domain)");
    return true;
}

/// Waits until the first of what the server tells at once has come, and then for the rest of it. Where
/// nothing comes in time it says what is `missing`, and why that may be.
template <class Arrived>
bool wait_for_report(client::Connection& connection, const std::stop_token& stop,
                     client::Clock::time_point end, const Arrived& arrived, const std::string& missing)
{
    if (!wait_until(connection, stop, end, arrived)) {
        complain(no_news_sentence(missing, connection));
        return false;
    }
    constexpr std::chrono::milliseconds rest{100};
    wait_until(connection, stop, client::Clock::now() + rest, [] { return false; });
    return true;
}

/// Warns when frames of the size the server sends do not fit this machine's receive buffers.
inline void warn_of_large_samples(const client::Connection& connection)
{
    if (const auto warning = wire::receive_buffer_warning(connection.server()->max_sample_bytes))
        complain("warning: " + *warning);
}

} // namespace slod::ctl
