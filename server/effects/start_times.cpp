#include "effects/start_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slod {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How many k have time_of(k) < time, at most `most`, whatever the guess; near to it this takes two looks.
template <class TimeOf>
std::uint64_t count_before(double time, double guess, std::uint64_t most, const TimeOf& time_of)
{
    const auto started = [&](std::uint64_t k) { return time_of(k) < time; };
    auto low = std::uint64_t(std::clamp(std::ceil(guess), 0.0, double(most)));
    std::uint64_t high = low; // the answer is from low to high, as soon as both have been looked at
    for (std::uint64_t stride = 1; low > 0 && !started(low - 1); stride *= 2) {
        high = low - 1;
        low -= std::min(low, stride);
    }
    for (std::uint64_t stride = 1; high < most && started(high); stride *= 2) {
        low = high + 1;
        high += std::min(most - high, stride);
    }
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (started(middle))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

} // namespace

StartTimes::StartTimes(const EmitterSettings& settings)
    : burst_(settings.burst), period_(settings.burst_period)
{
    if (settings.schedule.empty())
        pieces_.push_back({0, 0, settings.rate});
    for (const auto& [time, rate] : settings.schedule) {
        const double before =
            pieces_.empty() ? 0.0 : pieces_.back().count + pieces_.back().rate * (time - pieces_.back().time);
        pieces_.push_back({time, before, rate});
    }
}

std::uint64_t StartTimes::count_before(double time) const
{
    const std::uint64_t steady = steady_before(time);
    return burst_ == 0 ? steady : std::min(steady + burst_ * bursts_before(time), most);
}

StartTimes::Window StartTimes::window(double from, double to) const
{
    return burst_ == 0 ? Window{0, 0} : Window{bursts_before(from), bursts_before(to)};
}

/// Of particles that start together those of the burst come first. So burst j has the k from
/// j * burst + (the steady ones before it) on, and each other k is a steady one.
double StartTimes::time_of(std::uint64_t k, const Window& window) const
{
    if (burst_ == 0)
        return steady_time(k);
    const auto first_of = [&](std::uint64_t j) { return j * burst_ + steady_before(burst_time(j)); };
    std::uint64_t begun = std::max<std::uint64_t>(window.least_bursts, 1), most_begun = window.most_bursts;
    while (begun < most_begun) {
        const std::uint64_t middle = begun + (most_begun - begun) / 2;
        if (first_of(middle) <= k)
            begun = middle + 1;
        else
            most_begun = middle;
    }
    const std::uint64_t last = begun - 1;
    return k < first_of(last) + burst_ ? burst_time(last) : steady_time(k - begun * burst_);
}

std::uint64_t StartTimes::steady_before(double time) const
{
    const auto later = [&](double t, const Piece& piece) { return t <= piece.time; };
    const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), time, later);
    if (next == pieces_.begin())
        return 0;
    const Piece& piece = *(next - 1);
    // Not of a rate of 0, whose product with an infinite time is no number.
    const double guess = piece.rate > 0 ? piece.count + piece.rate * (time - piece.time) : piece.count;
    return slod::count_before(time, guess, most, [&](std::uint64_t k) { return steady_time(k); });
}

double StartTimes::steady_time(std::uint64_t k) const
{
    const double count = double(k);
    const auto more = [](double n, const Piece& piece) { return n < piece.count; };
    const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), count, more);
    if (next == pieces_.begin())
        return infinity; // not reached: the first piece has counted nothing
    const Piece& piece = *(next - 1);
    if (!(piece.rate > 0))
        return infinity;
    const double time = piece.time + (count - piece.count) / piece.rate;
    return next == pieces_.end() ? time : std::min(time, next->time);
}

std::uint64_t StartTimes::bursts_before(double time) const
{
    return slod::count_before(time, time / period_, most / burst_,
                              [&](std::uint64_t k) { return burst_time(k); });
}

double StartTimes::burst_time(std::uint64_t k) const
{
    return k == 0 ? 0.0 : double(k) * period_;
}

} // namespace slod
