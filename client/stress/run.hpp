#pragma once

#include <stop_token>
#include <vector>

#include "stress/observer.hpp"
#include "stress/options.hpp"
#include "stress/report.hpp"

namespace slod::stress {

/// Finds the server, loads it as asked, reports and judges.
ExitCode run(const Options& options, const std::stop_token& stop);

/// Watches the server at rest, with none of this program's clients.
ServerUse observe_rest(Observer& observer, double seconds, const std::stop_token& stop);

/// Loads the server with the clients asked for; `rest` is what to compare with.
Report load(Observer& observer, const Options& options, const ServerUse& rest, const std::stop_token& stop);

} // namespace slod::stress
