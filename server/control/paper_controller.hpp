#pragma once

#include <array>

#include "control/controller.hpp"

namespace slod {

/// The paper's rule (O'Brien et al. 2001, sections 5.2 and 6.1): whenever the mean of the last three frames
/// is above the target, the maximum cluster size goes up by one, below it down by one, each frame; with
/// several regions all sizes go by the same percent. After several such steps in vain at the largest size the
/// maximum breadth is doubled, and with it the grid. It never comes to rest: see SmoothController.
class PaperController final : public Controller {
public:
    /// Of all sizes, where there are several regions; the paper gives no figure.
    static constexpr double percent = 10;
    /// Steps in vain before the breadth changes, and its factor; "several" in the paper.
    static constexpr int patience = 5;
    static constexpr double breadth_step = 2;

    PaperController(const ControlSettings& settings, const ControlScope& scope, const Detail& detail);

    Detail next(const FrameWork& work) override;
    ControlState state() const override { return state_; }
    void set_scope(const ControlScope& scope) override;

private:
    /// Turns the cluster size up or down by a step; false when it is at its end already.
    bool turn_size(bool coarser);
    /// Turns the breadth likewise, at the last of `patience` calls in a row.
    bool turn_breadth(bool coarser);

    ControlSettings settings_;
    ControlScope scope_;
    Detail detail_;
    ControlState state_ = ControlState::Adjusting;
    std::array<double, 3> works_{}; ///< of the last frames, ms
    int frames_ = 0;                ///< taken in so far, up to three
    int in_vain_ = 0;               ///< steps at the end of the cluster size
};

} // namespace slod
