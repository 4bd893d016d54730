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

/// Warns when frames of the size the server sends do not fit this machine's receive buffers.
inline void warn_of_large_samples(const client::Connection& connection)
{
    if (const auto warning = wire::receive_buffer_warning(connection.server()->max_sample_bytes))
        complain("warning: " + *warning);
}

} // namespace slod::ctl
