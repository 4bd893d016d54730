#pragma once

#include <cstdint>
#include <string>

#include "common/connection.hpp"
#include "idl/profile.hpp"

namespace CLI {
class App;
}

namespace slod::client {

/// The server that a client is for, and how long the client waits for it.
struct ServerChoice {
    std::uint32_t domain = 0; ///< 0 to wire::last_domain
    wire::Profile profile = wire::Profile::Loopback;
    double timeout_s = 3; ///< 0 to a day
};

/// Declares --domain, --profile and --timeout; `timeout_help` says what is waited for.
void add_server_options(CLI::App& app, ServerChoice& server, const std::string& timeout_help);

/// The moment at which the user's patience ends, from now on.
Clock::time_point deadline(const ServerChoice& server);

/// What to tell a user whose client found no server: why, and what helps.
std::string no_server_sentence(const Status& status);

/// What to tell a user whose client found one and did not get what it waited for: that, which is how the
/// sentence begins, why, and what helps.
std::string no_news_sentence(const std::string& missing, const Connection& connection);

/// That the server takes no commands, and the remedy.
std::string no_commands_sentence();

/// That not all regions have come in time, and the remedy.
std::string late_regions_sentence();

/// That there is no region of that name, and how to see those that there are.
std::string no_region_sentence(const std::string& name);

} // namespace slod::client
