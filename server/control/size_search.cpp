#include "control/size_search.hpp"

#include <algorithm>
#include <cmath>

namespace slod {
namespace {

/// Largest turn at once. The error goes with a power of the size, 0.3 to 1.2 for flow maps of galaxies and of
/// pairs of them, so that a turn by the excess leaves a fifth to seven tenths of it. Between single particles
/// and pairs it goes with the sixth: a turn goes too far there, and the next is between two ends.
constexpr double most_turn = 0.7;
constexpr double near_by = 0.05;     ///< the same where the size wanted is near; each turn there doubles it
constexpr double least_part = 0.25;  ///< of the distance of two ends, that the next size keeps from both
constexpr double narrowest = 0.02;   ///< distance of two ends that something is looked for between
constexpr double same_size = 1e-3;   ///< largest difference of sizes that count as one
constexpr double other_error = 0.15; ///< difference of errors at one size that is no chance
constexpr std::uint64_t least_patience = 512, most_patience = 8192;

} // namespace

SizeSearch::SizeSearch() : reach_(most_turn) {}

void SizeSearch::held()
{
    if (at_jump())
        return;
    *this = {};
    reach_ = near_by;
}

bool SizeSearch::at_jump() const
{
    return fine_.known && coarse_.known && coarse_.size - fine_.size < narrowest;
}

bool SizeSearch::trial_is_due(std::uint64_t frame) const
{
    return frame >= trial_.next || fine_.excess < trial_.excess - other_error;
}

void SizeSearch::note(double size, double excess)
{
    End& end = excess > 0 ? coarse_ : fine_;
    End& other = excess > 0 ? fine_ : coarse_;
    const double distance = std::abs((end.known ? end.size : size) - other.size);
    const bool turned = end.known && std::abs(end.size - size) > same_size;
    if (!other.known && turned)
        reach_ = std::min(2 * reach_, most_turn);
    end = {size, excess, true};
    if (!other.known || fine_.size < coarse_.size)
        return;
    other.known = false;
    reach_ = std::clamp(2 * distance, near_by, most_turn);
    trial_ = {}; // a jump that is found next is another
}

double SizeSearch::next(double size, double excess, std::uint64_t frame)
{
    note(size, excess);
    kept_below_ = false;
    if (at_jump())
        return keep_below_jump(excess, frame);
    if (!fine_.known || !coarse_.known)
        return size - std::clamp(excess, -reach_, reach_);
    const double part = fine_.excess / (fine_.excess - coarse_.excess);
    return std::lerp(fine_.size, coarse_.size, std::clamp(part, least_part, 1 - least_part));
}

double SizeSearch::keep_below_jump(double excess, std::uint64_t frame)
{
    if (excess < 0 && trial_is_due(frame))
        return coarse_.size;
    if (excess > 0 && trial_is_due(frame)) {
        trial_.excess = fine_.excess;
        trial_.patience = std::clamp(2 * trial_.patience, least_patience, most_patience);
        trial_.next = frame + trial_.patience;
    }
    kept_below_ = excess < 0;
    return fine_.size;
}

} // namespace slod
