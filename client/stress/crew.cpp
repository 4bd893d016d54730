#include "stress/crew.hpp"

#include <algorithm>
#include <signal.h>

namespace slod::stress {

namespace {

// The rhythm of those that are stopped: longer than a hiccup, shorter than what DDS takes for a death.
constexpr std::chrono::seconds cycle{5}, stand_still{2};

} // namespace

Crew::Crew(const std::vector<Order>& orders)
{
    members_.reserve(orders.size());
    for (const Order& order : orders)
        members_.push_back({order, ClientProcess(json_of(order).dump())});
}

void Crew::poll()
{
    for (Member& member : members_)
        member.process.poll();
}

std::size_t Crew::unready() const
{
    const auto count = std::count_if(members_.begin(), members_.end(), [](const Member& member) {
        return !member.process.ready() && !member.process.gone();
    });
    return std::size_t(count);
}

void Crew::begin(Clock::time_point now)
{
    begun_ = now;
    for (Member& member : members_)
        member.process.begin();
}

void Crew::end()
{
    for (Member& member : members_) {
        member.process.signal(SIGCONT);
        member.process.end();
    }
}

void Crew::stop_and_go(Clock::time_point now)
{
    const bool stop = (now - begun_) % cycle >= cycle - stand_still;
    if (stop == stopped_)
        return;
    stopped_ = stop;
    for (const Member& member : members_)
        if (member.order.reader == Reader::Stopped)
            member.process.signal(stop ? SIGSTOP : SIGCONT);
}

bool Crew::done(bool commanders_only) const
{
    return std::all_of(members_.begin(), members_.end(), [&](const Member& member) {
        return (commanders_only && member.order.reader) || member.process.result() || member.process.gone();
    });
}

std::vector<SubscriberResult> Crew::subscribers() const
{
    std::vector<SubscriberResult> results;
    for (const Member& member : members_)
        if (member.order.reader && member.process.result())
            results.push_back(subscriber_result(Json::parse(*member.process.result())));
    return results;
}

std::vector<CommanderResult> Crew::commanders() const
{
    std::vector<CommanderResult> results;
    for (const Member& member : members_)
        if (!member.order.reader && member.process.result())
            results.push_back(commander_result(Json::parse(*member.process.result())));
    return results;
}

std::uint64_t Crew::missing() const
{
    const auto count = std::count_if(members_.begin(), members_.end(),
                                     [](const Member& member) { return !member.process.result(); });
    return std::uint64_t(count);
}

} // namespace slod::stress
