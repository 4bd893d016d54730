#pragma once

#include <cstdint>

#include "control/controller.hpp"
#include "control/size_search.hpp"
#include "control/smooth_controller.hpp"
#include "meter/error_window.hpp"

namespace slod {

/// Holds the median error of members' accelerations at a target, and with it, where one is asked for, the
/// frame rate. The error says how large clusters may be, and nothing is made finer than that: what is more
/// accurate than asked for costs work in vain. Where the frame rate goes first it may make them larger still.
///
/// Errors come in samples. It waits until enough have been drawn since clusters followed the last turn, or
/// have had time to where their number is never still, and turns again only when the target is outside the
/// interval that holds the median with 95 % probability and further than the band within which it rests: so
/// chance moves nothing for long. Where to is the matter of `SizeSearch`.
class ErrorController final : public Controller {
public:
    ErrorController(const ControlSettings& settings, const ControlScope& scope, const Detail& detail);

    Detail next(const FrameWork& work) override;
    ControlState state() const override;
    void set_scope(const ControlScope& scope) override;

private:
    void note_size(const FrameWork& work);
    bool followed() const;                    ///< the clusters have, what was turned last
    bool take_samples(const FrameWork& work); ///< false: none came that counts
    void turn_goal(std::uint64_t frame);
    void turn_by(double excess, std::uint64_t frame);
    void forget(); ///< what was learned of other clusters, or at another detail

    ControlSettings settings_;
    ControlScope scope_;
    SmoothController frame_rate_; ///< turns the sizes, between what the error allows and the largest
    ErrorWindow errors_;          ///< of frames in which clusters were as they are
    ControlState state_ = ControlState::Adjusting; ///< of the error's target
    SizeSearch search_;                            ///< since it was last held for sure
    bool exceeded_ = false;                        ///< it was above that when it was last judged
    bool yields_ = false;                          ///< it is, to hold the frame rate

    // Logarithms of the factor of all cluster sizes.
    double goal_;  ///< that the error allows
    double floor_; ///< the same, as it is approached
    double size_;  ///< that was asked for in the last frame

    Detail detail_; ///< the last

    double same_size_;     ///< that the size has been near since it last turned
    double crowding_ = 0;  ///< mean over the last frames of the logarithm of clusters over particles
    int same_frames_ = 0;  ///< in a row in which it was, and no lever turned
    int still_frames_ = 0; ///< of them, in a row in which the crowding did not change either
    std::uint64_t counts_since_ = 0; ///< samples of earlier frames do not count
};

} // namespace slod
