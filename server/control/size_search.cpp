#include "control/size_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slod {
namespace {

/// Largest turn at once. Between 0.3 and 1.2 (flow maps, galaxies and pairs of them) is the power of the size
/// that the error goes with, so that a turn leaves a fifth to seven tenths of the excess; it is 6 between
/// single particles and pairs, where a turn goes too far and the next is between two ends.
constexpr double most_turn = 0.7;
constexpr double near_by = 0.05;    ///< the same where the size wanted is; each turn there doubles it
constexpr double nearest = 0.25;    ///< to an end that is gone to, as a part of the distance of both
constexpr double narrowest = 0.02;  ///< distance of two ends that something is looked for between
constexpr int least_patience = 512; ///< judgements; there is one a frame
constexpr int most_patience = 8192;

} // namespace

SizeSearch::SizeSearch() : reach_(most_turn) {}

void SizeSearch::held()
{
    *this = {};
    reach_ = near_by;
}

void SizeSearch::note(double size, double excess)
{
    const double distance = std::abs(coarse_.size - fine_.size);
    (excess > 0 ? coarse_ : fine_) = {size, excess, true};
    End& other = excess > 0 ? fine_ : coarse_;
    if (other.known && fine_.size >= coarse_.size) {
        other.known = false;
        reach_ = std::clamp(2 * distance, near_by, most_turn);
    }
}

double SizeSearch::next(double size, double excess)
{
    note(size, excess);
    const double distance = coarse_.size - fine_.size;
    const bool between = fine_.known && coarse_.known;
    if (between && distance < narrowest)
        return keep_below_jump(excess);
    rested_ = 0;
    if (!between) {
        const double reach = std::exchange(reach_, std::min(2 * reach_, most_turn));
        return size - std::clamp(excess, -reach, reach);
    }
    const double part = fine_.excess / (fine_.excess - coarse_.excess);
    return fine_.size + std::clamp(part, nearest, 1 - nearest) * distance;
}

double SizeSearch::keep_below_jump(double excess)
{
    if (excess > 0) {
        rested_ = 0;
        patience_ = std::clamp(2 * patience_, least_patience, most_patience);
        return fine_.size;
    }
    rested_ = rested_ < patience_ ? rested_ + 1 : 0;
    return rested_ > 0 ? fine_.size : coarse_.size;
}

} // namespace slod
