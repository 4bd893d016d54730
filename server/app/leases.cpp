#include "app/leases.hpp"

namespace slod {

void Leases::grant(const std::string& region, const wire::Uuid& owner, double lease_s, Clock::time_point now)
{
    const auto length = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(lease_s));
    leases_[region] = {.owner = owner, .length = length, .renewed = now};
}

void Leases::renew(const wire::Uuid& owner, Clock::time_point now)
{
    for (auto& [region, lease] : leases_)
        if (lease.owner == owner)
            lease.renewed = now;
}

std::vector<std::string> Leases::overdue(Clock::time_point now) const
{
    std::vector<std::string> regions;
    for (const auto& [region, lease] : leases_)
        if (now - lease.renewed > lease.length)
            regions.push_back(region);
    return regions;
}

} // namespace slod
