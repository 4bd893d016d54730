#pragma once

#include <stop_token>

#include "stress/order.hpp"
#include "stress/results.hpp"
#include "stress/tether.hpp"

namespace slod::stress {

// What a client of a run does until its tether or `stop` ends it. Throw wire::DdsError when the domain cannot
// be joined.
SubscriberResult subscribe(const Order& order, Tether& tether, const std::stop_token& stop);
CommanderResult command(const Order& order, Tether& tether, const std::stop_token& stop);

/// The whole of a client's process: `order` is JSON. Returns its exit code.
int run_client(const char* order, const std::stop_token& stop);

} // namespace slod::stress
