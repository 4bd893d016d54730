#pragma once

#include <array>
#include <limits>

#include "control/controller.hpp"

namespace slod {

/// Holds a frame's work at its target without a limit cycle. It turns the factor of all maximum cluster
/// sizes; clusters follow that many frames later, but the work follows the clusters at once. So it
///
///  - says from the work and the clusters of the same frames which number of clusters would be right,
///    whatever is still on its way;
///  - and asks for the sizes at which there will be so many. How full clusters are is learned while nothing
///    changes: the integral part, which cannot wind up, as what it learns from is what there is. Where
///    clusters do not follow they seem to be emptier, and it asks for more.
///
/// The work per cluster is a median over the last frames, of few where the error is large and of more where
/// it is small: an outlier, or a clock that jumps, changes nothing. Within a band about the target the output
/// rests, and is left only where the error is above twice that. The output rises by no more than 6 % a frame,
/// by 12 % where the work is far above its target, and falls by no more than 2.5 %, as a frame that is late
/// is worse than one that is early; by 6 % where more than a fifth of the time is left and particles hardly
/// grow in number, and 9 % where far more is. Clusters split at sizes of their own (Detail), so that few of
/// them change in any frame. Particles that will have been born when clusters have followed are taken into
/// account; where it is asked whether to rest, at their mean rate.
///
/// Where clusters are at their largest and that is not enough, other levers follow in steps, in the order
/// opening, life, breadth; where clusters are less than half that large, or as small as they may be with time
/// left, they go back in reverse.
class SmoothController final : public Controller {
public:
    SmoothController(const ControlSettings& settings, const ControlScope& scope, const Detail& detail);

    Detail next(const FrameWork& work) override;
    ControlState state() const override { return state_; }
    void set_scope(const ControlScope& scope) override;

    /// The factor of the cluster sizes is not to fall below exp(logarithm).
    void set_finest(double logarithm) { finest_ = logarithm; }
    double output() const { return output_; } ///< logarithm of the cluster size's factor

private:
    /// A further lever: where it is in the detail, whether the scene has it, and its largest factor.
    struct Lever {
        double Detail::*factor;
        bool ControlScope::*there;
        double ControlSettings::*most;
    };
    static const std::array<Lever, 3> levers;

    /// Of the logarithms of work per cluster over the last `frames`.
    double median_cost(std::size_t frames) const;
    /// `error`: logarithm of work over target. `crowding`: of clusters over particles. `growth`: of particles
    /// there will be over those there are; `mean_growth`: the same at their mean rate.
    void turn_size(double error, double crowding, double growth, double mean_growth);
    void learn_fill(double crowding);
    void turn_levers(double error);
    /// Turns the first lever that can be turned, or the last that was; false when there is none.
    bool turn_lever(bool coarser);
    void judge(double error);

    double least_output() const; ///< where all regions have their smallest clusters
    double most_output() const;

    ControlSettings settings_;
    ControlScope scope_;
    Detail detail_;
    ControlState state_ = ControlState::Adjusting;

    static constexpr std::size_t window = 15; ///< frames remembered
    std::array<double, window> costs_{};      ///< logarithm of work per cluster, by frame modulo the window
    std::size_t frames_ = 0;                  ///< taken in so far
    double finest_ = -std::numeric_limits<double>::infinity(); ///< bound of the output
    double output_;                                            ///< logarithm of the cluster size's factor
    double lagged_;                                            ///< the same, as the clusters follow it
    double fill_ = 0;            ///< crowding + output once clusters have followed
    double crowding_before_ = 0; ///< mean of the last frames
    double mean_growth_ = 0;     ///< particles born less those that died, over the last frames
    int turn_frames_ = 0;        ///< in a row that asked for a turn of the further levers
    bool exhausted_ = false;     ///< none is left to turn
};

} // namespace slod
