#pragma once

#include <stop_token>

#include "common/connection.hpp"
#include "common/waiting.hpp"
#include "ctl/command_line.hpp"
#include "ctl/output.hpp"

namespace slod::ctl {

/// Waits for a server; says what to do when there is none.
inline bool wait_for_server(client::Connection& connection, const std::stop_token& stop,
                            client::Clock::time_point end)
{
    const auto present = [&] { return connection.status().contact != client::Contact::NoServer; };
    if (wait_until(connection, stop, end, present))
        return true;
    complain(no_server_sentence(connection.status()));
    return false;
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
