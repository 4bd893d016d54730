#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "app/scene_editor.hpp"
#include "control/controller.hpp"
#include "scene/server_settings.hpp"
#include "sim/simulation.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// Holds the frame rate and the error: tells a controller how long frames work, and has done what it decides.
/// Belongs to the simulation's thread.
class Regulator {
public:
    /// `paced`: there is a frame rate to hold.
    explicit Regulator(bool paced) : paced_(paced) {}

    /// Takes up other settings, another plan and other regions, where they are. Another controller goes on
    /// from the detail that the last one left, and so does one under another plan, which makes other work and
    /// other errors; values that change under the same plan, such as an attractor's place, leave it as it is.
    /// Without one the scene has its own again. Where nothing can be turned, as in a
    /// scene planned without clusters, there is none.
    void set(const LoopSettings& settings, const SceneEditor& editor, const Simulation& simulation);

    /// Takes in a frame that worked for so long, and errors that came to be known in it.
    void add(const Snapshot& snapshot, double work_ms, std::span<const ErrorSample> errors);

    /// Gives the simulation the detail that is decided on for `frame`, the next to run.
    void apply(SceneEditor& editor, std::uint64_t frame);

    ControlReport report() const;

private:
    bool paced_;
    ControlSettings settings_{.mode = ControlMode::Off};
    double frame_rate_hz_ = 0;
    std::uint64_t revision_ = 0;     ///< of the regions that the scope is of
    std::uint64_t plan_changes_ = 0; ///< that the controller knows of
    ControlScope scope_;
    std::unique_ptr<Controller> controller_;
    std::optional<Detail> decided_;
    std::uint64_t decisions_ = 0;
};

} // namespace slod
