#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

/// What holds the frame rate.
enum class ControlMode : std::uint8_t {
    Off,    ///< nothing: the scene's own detail
    Paper,  ///< one particle more or less per frame (O'Brien et al. 2001, section 6.1)
    Smooth, ///< a controller without a limit cycle
    Error,  ///< the same, and clusters no smaller than a measured error asks for
};

constexpr std::array<std::string_view, 4> names(ControlMode)
{
    return {"off", "paper", "smooth", "error"};
}

/// Which target goes first where both cannot be had.
enum class ControlPriority : std::uint8_t { FrameRate, Error };

constexpr std::array<std::string_view, 2> names(ControlPriority)
{
    return {"frame_rate", "error"};
}

/// How a frame rate is held by changing the level of detail. The frame's work, step and encoding, is held at
/// a share of the frame period.
struct ControlSettings {
    ControlMode mode = ControlMode::Smooth;
    double work_share = 0.8;          ///< of the frame period
    double smallest_cluster_size = 1; ///< bounds of every region's max_cluster_size, particles
    double largest_cluster_size = 256;
    double largest_opening = 4; ///< bounds of the levers that follow when the clusters are largest: factors
    double largest_life = 2;
    double largest_breadth = 4;
    double target_error = 0.01; ///< median error of accelerations, where the mode is Error
    ControlPriority priority = ControlPriority::FrameRate;

    friend bool operator==(const ControlSettings&, const ControlSettings&) = default;
};

/// What is wrong with the settings together; empty when nothing is.
Problems problems(const ControlSettings& control);

template <class Visitor>
void for_each_field(ControlSettings& control, Visitor&& visit)
{
    visit(
        Field{"mode", "", "What holds the frame rate by changing the level of detail; never in a free run."},
        control.mode);
    visit(Field{"work_share", "", "Share of the frame period that step and encoding are to take.", 0.01, 1},
          control.work_share);
    visit(
        Field{"smallest_cluster_size", "particles", "No region's max_cluster_size is made smaller.", 1, 1e6},
        control.smallest_cluster_size);
    visit(Field{"largest_cluster_size", "particles", "No region's max_cluster_size is made larger.", 1, 1e6},
          control.largest_cluster_size);
    visit(Field{"largest_opening", "",
                "Factor up to which gravity.force_tolerance is raised once clusters are largest.", 1, 1000},
          control.largest_opening);
    visit(Field{"largest_life", "", "Factor up to which motion.clock is raised after that.", 1, 1000},
          control.largest_life);
    visit(Field{"largest_breadth", "", "Factor up to which max_breadth is raised after that.", 1, 1000},
          control.largest_breadth);
    visit(Field{"target_error", "",
                "Median error of members' accelerations, relative, that mode \"error\" holds: 0.01 is 1 %.",
                1e-6, 1},
          control.target_error);
    visit(Field{"priority", "",
                "Which target mode \"error\" gives up where it cannot hold both: not this one. In a free run "
                "there is no frame rate to hold."},
          control.priority);
}

} // namespace slod
