#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "stress/client_process.hpp"
#include "stress/order.hpp"
#include "stress/results.hpp"

namespace slod::stress {

/// All clients of a run. They end with it.
class Crew {
public:
    using Clock = std::chrono::steady_clock;

    explicit Crew(const std::vector<Order>& orders);

    /// Takes in what the clients have written.
    void poll();

    /// How many have not said that they are ready, and still may.
    std::size_t unready() const;

    void begin(Clock::time_point now);
    void end();

    /// Stops and continues those whose part that is.
    void stop_and_go(Clock::time_point now);

    /// Whether all commanders, or all clients, have reported or are gone.
    bool commanders_done() const { return done(true); }
    bool all_done() const { return done(false); }

    std::vector<SubscriberResult> subscribers() const;
    std::vector<CommanderResult> commanders() const;

    /// Clients that ended without a result.
    std::uint64_t missing() const;

private:
    struct Member {
        Order order;
        ClientProcess process;
    };

    bool done(bool commanders_only) const;

    std::vector<Member> members_;
    Clock::time_point begun_{};
    bool stopped_ = false;
};

} // namespace slod::stress
