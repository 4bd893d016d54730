#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "control/controller.hpp"
#include "support/plant.hpp"

namespace slod::test {

inline constexpr double target_ms = 26;

/// A plant whose clusters give errors that go with a power of their size.
struct ErrorPlant {
    Plant plant{.cost_ms = 0.005};
    double error_at_64 = 0.02; ///< median
    double power = 0.6;        ///< of the size, in the error
    double spread = 1;         ///< of the logarithm of the errors
    int samples = 12;          ///< a frame
    int late = 5;              ///< frames until they are known
    std::uint64_t drawn = 0;

    double size() const { return plant.particles / plant.clusters; }
    double jump_at = 1e30; ///< size from which on errors are
    double jump = 1;       ///< so many times larger

    double median() const
    {
        return error_at_64 * std::pow(size() / 64, power) * (size() < jump_at ? 1 : jump);
    }

    std::vector<ErrorSample> draw()
    {
        std::vector<ErrorSample> errors;
        for (int i = 0; i < samples && plant.frames > std::uint64_t(late); ++i) {
            Random random(11, 3, drawn++);
            const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
            const double normal = radius * std::cos(2 * std::numbers::pi * random.uniform());
            errors.push_back({plant.frames - std::uint64_t(late), median() * std::exp(spread * normal)});
        }
        return errors;
    }
};

/// Runs a frame; what the controller makes of the detail. `work_ms` is left with the frame's work.
inline Detail run_frame(ErrorPlant& plant, Controller& controller, const Detail& detail, double frame_ms,
                        double& work_ms)
{
    work_ms = plant.plant.run(detail);
    FrameWork told = plant.plant.told(work_ms, frame_ms);
    const std::vector<ErrorSample> errors = plant.draw();
    told.frame = plant.plant.frames;
    told.errors = errors;
    return controller.next(told);
}

inline Detail run_frame(ErrorPlant& plant, Controller& controller, const Detail& detail = {})
{
    double work_ms = 0;
    return run_frame(plant, controller, detail, target_ms, work_ms);
}

/// What became of a run.
struct Outcome {
    double work_ms = 0; ///< of the last frame
    double held = 0;    ///< share of the last frames in which the median was within a fifth of the target
    double below = 0;   ///< share of them in which it was below
    double holding = 0; ///< share of them in which the controller said so
    int moves = 0;      ///< of the size in them
    ControlState state = ControlState::Off;
};

inline Outcome run(
    ErrorPlant& plant, const ControlSettings& settings, double frame_ms, int frames = 1500,
    const std::function<void(int)>& disturb = [](int) {}, int last = 300)
{
    const auto controller = make_controller(settings, {}, {});
    Detail detail;
    Outcome outcome;
    for (int frame = 0; frame < frames; ++frame) {
        disturb(frame);
        const Detail next = run_frame(plant, *controller, detail, frame_ms, outcome.work_ms);
        const bool moved = !(std::exchange(detail, next) == next);
        outcome.state = controller->state();
        if (frame < frames - last)
            continue;
        outcome.moves += moved ? 1 : 0;
        outcome.held += std::abs(plant.median() / settings.target_error - 1) < 0.2 ? 1.0 / last : 0;
        outcome.below += plant.median() < settings.target_error ? 1.0 / last : 0;
        outcome.holding += outcome.state == ControlState::Holding ? 1.0 / last : 0;
    }
    return outcome;
}

inline ControlSettings holding(double error, ControlPriority priority = ControlPriority::FrameRate)
{
    return {.mode = ControlMode::Error, .target_error = error, .priority = priority};
}

} // namespace slod::test
