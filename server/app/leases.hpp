#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "idl/messages.hpp"

namespace slod {

/// Regions that go when their owner is silent for too long. Knows no clock: it is told the time.
class Leases {
public:
    using Clock = std::chrono::steady_clock;

    /// `lease_s` of wall time, in (0, 1e6].
    void grant(const std::string& region, const wire::Uuid& owner, double lease_s, Clock::time_point now);

    /// The owner gave a sign of life: all its leases begin anew.
    void renew(const wire::Uuid& owner, Clock::time_point now);

    void end(const std::string& region) { leases_.erase(region); }

    /// Regions whose lease has run out, by name.
    std::vector<std::string> overdue(Clock::time_point now) const;

private:
    struct Lease {
        wire::Uuid owner;
        Clock::duration length;
        Clock::time_point renewed;
    };

    std::map<std::string, Lease> leases_; ///< by region
};

} // namespace slod
