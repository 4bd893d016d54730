#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "control/settings.hpp"
#include "meter/error_window.hpp"
#include "tree/detail.hpp"

namespace slod {

/// What a controller is told of the frame that ended.
struct FrameWork {
    double work_ms;   ///< step and encoding; one that is not above 0 and finite is not taken for a time
    double target_ms; ///< that it is to take; above 0; infinite: as long as it likes
    std::uint64_t particles, clusters;     ///< at its end
    double growth = 0;                     ///< particles born less those that died
    std::uint64_t frame = 0;               ///< its number
    std::span<const ErrorSample> errors{}; ///< that came to be known in it
};

/// What there is to turn in a scene.
struct ControlScope {
    double least_size = 64, most_size = 64; ///< regions' max_cluster_size as the scene has them, from and to
    std::size_t regions = 1;                ///< the background included
    bool opening = false;                   ///< gravity
    bool life = false;                      ///< clusters have lives
    bool breadth = false;                   ///< some max_breadth is finite

    friend bool operator==(const ControlScope&, const ControlScope&) = default;
};

/// How things stand between a controller and its target.
enum class ControlState : std::uint8_t {
    Off,         ///< there is no controller
    Holding,     ///< the target is met
    Adjusting,   ///< on the way to it
    Finest,      ///< faster than asked for, with the finest detail there is
    Unreachable, ///< slower than asked for with the coarsest, or less accurate with the finest
    Yielding,    ///< less accurate than asked for, to hold the frame rate
};

constexpr std::array<std::string_view, 6> names(ControlState)
{
    return {"off", "holding", "adjusting", "finest", "unreachable", "yielding"};
}

/// How a frame rate is held at present.
struct ControlReport {
    ControlMode mode = ControlMode::Off;
    ControlState state = ControlState::Off;
    double target_ms = 0;        ///< work that a frame is to take; 0: none is held
    double target_error = 0;     ///< median error of accelerations; 0: none is held
    std::uint64_t decisions = 0; ///< changes of detail so far
};

/// Factors of all cluster sizes between which a controller may choose: where all regions have their smallest
/// and where all have their largest clusters.
struct SizeFactors {
    double least, most;
};
SizeFactors size_factors(const ControlSettings& settings, const ControlScope& scope);

/// The detail within the settings' bounds of cluster sizes.
Detail bounded(Detail detail, const ControlSettings& settings);

/// Decides on the level of detail, frame by frame, from the work of frames alone. Knows no clock and no
/// simulation: the same works give the same decisions.
class Controller {
public:
    virtual ~Controller() = default;

    /// Takes in a frame and says at which detail the next is to be run.
    virtual Detail next(const FrameWork& work) = 0;

    virtual ControlState state() const = 0;

    /// The scene has other regions now, or other sizes of them.
    virtual void set_scope(const ControlScope& scope) = 0;
};

/// Null where the mode is off. Starts from `detail`, which a controller before it may have left.
std::unique_ptr<Controller> make_controller(const ControlSettings& settings, const ControlScope& scope,
                                            const Detail& detail);

} // namespace slod
