#include "control/error_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace slod {
namespace {

constexpr std::size_t window = 1024;    ///< samples remembered
constexpr std::size_t enough = 256;     ///< samples that a turn is made upon
constexpr std::size_t enough_afar = 64; ///< and where the error is far off; a whole window once it is held
constexpr double afar = 0.5;            ///< such a difference of logarithms
constexpr double band = 0.1;       ///< of the error's logarithm about its target's, within which it rests
constexpr double leave = 0.15;     ///< and above which it no longer does, by a full window
constexpr double most_rise = 0.06; ///< of the logarithm of the size in a frame
constexpr double most_excess = 10; ///< of the error's logarithm over its target's; there may be none at all
/// Largest difference of sizes at which clusters count as still, and frames that they have to be so before
/// samples count: merges come in rounds of 16 frames.
constexpr double still_size = 1e-3;
constexpr int patience = 24;
constexpr int long_patience = 8 * patience; ///< the same where their number is never still: a stream, bursts
constexpr double mean_frames = 16;          ///< of the crowding

/// Largest difference of the crowding and its mean at which clusters count as still. Their number varies by
/// its root where they are formed anew now and then.
double still_crowding(double clusters)
{
    return 0.02 + 1 / std::sqrt(clusters);
}

} // namespace

ErrorController::ErrorController(const ControlSettings& settings, const ControlScope& scope,
                                 const Detail& detail)
    : settings_(settings), scope_(scope), frame_rate_(settings, scope, detail), errors_(window),
      goal_(std::log(detail.cluster_size)), floor_(goal_), size_(goal_), detail_(detail), same_size_(goal_)
{}

void ErrorController::set_scope(const ControlScope& scope)
{
    scope_ = scope;
    forget();
    exceeded_ = false; // by other clusters
    frame_rate_.set_scope(scope);
}

Detail ErrorController::next(const FrameWork& work)
{
    note_size(work);
    if (take_samples(work))
        turn_goal(work.frame);
    floor_ = std::min(goal_, floor_ + most_rise); // downwards the frame rate's controller sets the pace
    frame_rate_.set_finest(floor_);
    FrameWork asked = work;
    if (settings_.priority == ControlPriority::Error)
        asked.target_ms = std::numeric_limits<double>::infinity();
    yields_ = exceeded_ && std::isfinite(asked.target_ms) && frame_rate_.output() > floor_ + still_size;
    const Detail before = std::exchange(detail_, frame_rate_.next(asked));
    if (before.opening != detail_.opening || before.life != detail_.life || before.breadth != detail_.breadth)
        forget(); // these make an error, too
    return detail_;
}

void ErrorController::forget()
{
    same_frames_ = still_frames_ = 0;
    search_ = {};
    state_ = ControlState::Adjusting;
}

ControlState ErrorController::state() const
{
    if (frame_rate_.state() == ControlState::Unreachable)
        return ControlState::Unreachable;
    return yields_ ? ControlState::Yielding : state_;
}

void ErrorController::note_size(const FrameWork& work)
{
    if (work.clusters == 0)
        return;
    const double crowding = std::log(double(work.clusters) / double(work.particles));
    const bool still = std::abs(frame_rate_.output() - size_) < still_size &&
                       std::abs(crowding - crowding_) < still_crowding(double(work.clusters));
    size_ = frame_rate_.output();
    const bool same = std::abs(size_ - same_size_) < still_size;
    same_size_ = same ? same_size_ : size_;
    crowding_ += (crowding - crowding_) / mean_frames;
    same_frames_ = same ? same_frames_ + 1 : 0;
    still_frames_ = still ? still_frames_ + 1 : 0;
}

bool ErrorController::followed() const
{
    return still_frames_ > patience || same_frames_ > long_patience;
}

bool ErrorController::take_samples(const FrameWork& work)
{
    if (!followed()) {
        errors_.clear();
        counts_since_ = work.frame;
        return false;
    }
    const std::size_t before = errors_.size();
    for (const ErrorSample& sample : work.errors)
        if (sample.frame >= counts_since_)
            errors_.add(sample);
    return errors_.size() > before || (errors_.size() == window && !work.errors.empty());
}

void ErrorController::turn_goal(std::uint64_t frame)
{
    if (errors_.size() < enough_afar)
        return;
    const ErrorQuantile median = errors_.estimate().median;
    const double excess =
        std::clamp(std::log(median.value / settings_.target_error), -most_excess, most_excess);
    const bool resting = state_ == ControlState::Holding;
    const std::size_t asked = resting ? window : std::abs(excess) < afar ? enough : enough_afar;
    if (errors_.size() < asked)
        return;
    const bool by_chance = median.low <= settings_.target_error && settings_.target_error <= median.high;
    exceeded_ = excess > 0 && !by_chance;
    if (by_chance || std::abs(excess) < (resting ? leave : band)) {
        state_ = ControlState::Holding;
        goal_ = size_;
        if (errors_.size() == window) // it is no chance that it is held
            search_.held();
        return;
    }
    turn_by(excess, frame);
}

void ErrorController::turn_by(double excess, std::uint64_t frame)
{
    const SizeFactors sizes = size_factors(settings_, scope_);
    const double least = std::log(sizes.least), most = std::log(sizes.most);
    goal_ = std::clamp(search_.next(size_, excess, frame), least, most);
    if (excess > 0 && size_ <= least)
        state_ = ControlState::Unreachable;
    else if (excess < 0 && (size_ >= most || search_.kept_below_jump()))
        state_ = ControlState::Holding;
    else
        state_ = ControlState::Adjusting;
}

} // namespace slod
