#include "app/meter_budget.hpp"

#include <algorithm>
#include <cmath>

namespace slod {
namespace {

constexpr double most_saved_frames = 8; ///< of which the share may be left for one frame
constexpr double mean_frames = 8;       ///< in which a rate is forgotten

} // namespace

std::uint64_t MeterBudget::pairs(const MeterSettings& settings) const
{
    if (!settings.enabled || credit_ms_ <= 0)
        return 0;
    return std::uint64_t(std::max(credit_ms_ * pairs_per_ms_, 1.0));
}

void MeterBudget::add(const MeterSettings& settings, double frame_ms, double meter_ms, std::uint64_t pairs)
{
    const double share_ms = settings.share * frame_ms;
    if (!std::isfinite(share_ms) || !std::isfinite(meter_ms))
        return; // the clock was turned
    credit_ms_ = std::min(credit_ms_ + share_ms - meter_ms, most_saved_frames * share_ms);
    if (pairs == 0 || meter_ms <= 0)
        return;
    // A frame in which sums begin does fewer, which says nothing of the next.
    const double rate = double(pairs) / meter_ms;
    pairs_per_ms_ = std::max(rate, pairs_per_ms_ + (rate - pairs_per_ms_) / mean_frames);
}

} // namespace slod
