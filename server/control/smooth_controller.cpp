#include "control/smooth_controller.hpp"

#include <algorithm>
#include <cmath>

namespace slod {
namespace {

/// Share of an error that is taken up at once. More than the whole where it may, as births follow the size at
/// once, but what is there merges in rounds, and may have died before the last; with gravity less, as the
/// work grows faster than the clusters and would swing.
constexpr double gain_of_fields = 2.75, gain_of_gravity = 0.9;
/// Largest rise and fall of the output in a frame, and those where the work is further above or below its
/// target than `far_off`, as a logarithm. Under twice the load the fountain's work is within a tenth of its
/// target after 24 frames in place of 30 to 61 without steep ones, and 15 in place of 19 once it is over;
/// that of the plant of fields in the tests within a twentieth after 26 in place of 20.
constexpr double most_rise = 0.06, steep_rise = 0.12;
constexpr double most_fall = 0.025, steep_fall = 0.09;
constexpr double far_off = 0.35;
/// With so much time to spare, and no more growth than that over the foresight, both as logarithms, the
/// output may fall as fast as it rises, or more steeply.
constexpr double ample = 0.2, no_growth = 0.05;
constexpr double rest = 0.02;    ///< error within which the output rests
constexpr double leave = 0.04;   ///< and above which it no longer does
constexpr double reached = 0.05; ///< error up to which the target counts as met
/// Frames in which clusters begin to follow: splits are swept over 8 frames, merges over 16.
constexpr double lag_frames = 6;
/// Frames whose births are taken into account: those until a size decided now is that of most clusters, two
/// rounds of merges. With 10 a stream that fills exceeds the target by a seventh, with 32 by a fourteenth;
/// with 45 it falls short by a fourteenth.
constexpr double foresight_frames = 32;
/// Largest differences, of output and lagged output and of crowding and the mean of its last frames, at which
/// the fill is learned: either the clusters have followed, or they do not.
constexpr double steady = 0.03, stuck = 0.005;
constexpr std::size_t few = 5; ///< frames of the median where the error is large
constexpr double large = 0.1;  ///< such an error
constexpr double lever_step = 1.4142135623730951;
constexpr int patience = 30; ///< frames that ask for a turn of the further levers before there is one
/// Below the largest output levers are turned back, which costs 0.35 at most; and wherever there is time
/// left.
constexpr double half_size = 0.7;

} // namespace

const std::array<SmoothController::Lever, 3> SmoothController::levers{{
    {&Detail::opening, &ControlScope::opening, &ControlSettings::largest_opening},
    {&Detail::life, &ControlScope::life, &ControlSettings::largest_life},
    {&Detail::breadth, &ControlScope::breadth, &ControlSettings::largest_breadth},
}};

SmoothController::SmoothController(const ControlSettings& settings, const ControlScope& scope,
                                   const Detail& detail)
    : settings_(settings), scope_(scope), detail_(bounded(detail, settings)),
      output_(std::log(detail.cluster_size)), lagged_(output_)
{
    detail_.dithered = true;
}

void SmoothController::set_scope(const ControlScope& scope)
{
    scope_ = scope;
    turn_frames_ = 0;
}

double SmoothController::least_output() const
{
    return std::clamp(finest_, std::log(size_factors(settings_, scope_).least), most_output());
}

double SmoothController::most_output() const
{
    return std::log(size_factors(settings_, scope_).most);
}

Detail SmoothController::next(const FrameWork& work)
{
    if (!(work.work_ms > 0 && std::isfinite(work.work_ms)) || work.clusters == 0)
        return detail_;
    const double clusters = std::log(double(work.clusters));
    const double crowding = clusters - std::log(double(work.particles));
    if (frames_ == 0) {
        fill_ = crowding + output_;
        crowding_before_ = crowding;
        mean_growth_ = work.growth;
    }
    mean_growth_ += (work.growth - mean_growth_) / lag_frames;
    costs_[frames_++ % window] = std::log(work.work_ms) - clusters;
    if (frames_ < few)
        return detail_;
    const auto error_over = [&](std::size_t frames) {
        return median_cost(frames) + clusters - std::log(work.target_ms);
    };
    const double quick = error_over(few);
    const double error = std::abs(quick) > large ? quick : error_over(std::min(frames_, window));
    const auto foreseen = [&](double growth) {
        return std::log(std::max(1 + foresight_frames * growth / double(work.particles), 0.1));
    };
    turn_size(error, crowding, foreseen(work.growth), foreseen(mean_growth_));
    learn_fill(crowding);
    turn_levers(error);
    judge(error);
    detail_.cluster_size = std::exp(output_);
    return detail_;
}

double SmoothController::median_cost(std::size_t frames) const
{
    std::array<double, window> recent{};
    for (std::size_t i = 0; i < frames; ++i)
        recent[i] = costs_[(frames_ - 1 - i) % window];
    const auto middle = recent.begin() + std::ptrdiff_t(frames / 2);
    std::nth_element(recent.begin(), middle, recent.begin() + std::ptrdiff_t(frames));
    return *middle;
}

void SmoothController::turn_size(double error, double crowding, double growth, double mean_growth)
{
    const bool resting = std::abs(error + mean_growth) < (state_ == ControlState::Holding ? leave : rest);
    if (!resting) {
        const double gain = scope_.opening ? gain_of_gravity : gain_of_fields;
        const double wanted = fill_ - crowding + gain * error + growth;
        const double rise = error > far_off ? steep_rise : most_rise;
        const double ample_fall = error < -far_off ? steep_fall : most_rise;
        const bool fast = error < -ample && growth < no_growth;
        output_ += std::clamp(wanted - output_, fast ? -ample_fall : -most_fall, rise);
    }
    output_ = std::clamp(output_, least_output(), most_output());
    lagged_ += (output_ - lagged_) / lag_frames;
}

void SmoothController::learn_fill(double crowding)
{
    const bool followed = std::abs(output_ - lagged_) < steady;
    if (followed || std::abs(crowding - crowding_before_) < stuck)
        fill_ += (crowding + lagged_ - fill_) / lag_frames;
    crowding_before_ += (crowding - crowding_before_) / lag_frames;
}

void SmoothController::turn_levers(double error)
{
    const bool slow = error > reached && output_ == most_output();
    const bool small = output_ < most_output() - half_size;
    const bool idle = error < -reached && output_ == least_output();
    turn_frames_ = slow || small || idle ? turn_frames_ + 1 : 0;
    exhausted_ = exhausted_ && slow;
    if (turn_frames_ < patience)
        return;
    turn_frames_ = 0;
    exhausted_ = !turn_lever(slow) && slow;
}

bool SmoothController::turn_lever(bool coarser)
{
    const auto turn = [&](const Lever& lever) {
        double& factor = detail_.*lever.factor;
        const double wanted = std::clamp(coarser ? factor * lever_step : factor / lever_step, 1.0,
                                         std::max(settings_.*lever.most, 1.0));
        if (!(scope_.*lever.there) || wanted == factor)
            return false;
        factor = wanted;
        return true;
    };
    return coarser ? std::any_of(levers.begin(), levers.end(), turn)
                   : std::any_of(levers.rbegin(), levers.rend(), turn);
}

void SmoothController::judge(double error)
{
    if (exhausted_)
        state_ = ControlState::Unreachable;
    else if (error < -reached && output_ == least_output())
        state_ = ControlState::Finest;
    else if (std::abs(error) < rest)
        state_ = ControlState::Holding;
    else if (std::abs(error) > leave)
        state_ = ControlState::Adjusting;
}

} // namespace slod
