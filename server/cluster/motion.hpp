#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

/// How a cluster's members move with it.
enum class Motion : std::uint8_t {
    Flow,   ///< by the tangent of the step: exact in linear fields, first order elsewhere
    Stream, ///< freely, with their own velocities: the flow map without tides
    Rigid,  ///< by the cluster's displacement (O'Brien et al. 2001, section 4.4)
};

constexpr std::array<std::string_view, 3> names(Motion)
{
    return {"flow", "stream", "rigid"};
}

/// What becomes of the velocities of members whose clusters merge. O'Brien et al. 2001 have both: they move
/// members by a common change of velocity (section 4.4) and speak of velocities that are averaged (5.1).
enum class MergedVelocities : std::uint8_t {
    Keep,     ///< each member's own, so that a split restores it; energy of the centres becomes internal
    Collapse, ///< both clusters take the mean: the energy of their relative motion is lost
};

constexpr std::array<std::string_view, 2> names(MergedVelocities)
{
    return {"keep", "collapse"};
}

struct MotionSettings {
    Motion motion = Motion::Flow;
    double clock = 0.2;              ///< tau: a map lives tau / sqrt(|tidal tensor|)
    std::uint32_t shortest_life = 2; ///< frames
    std::uint32_t longest_life = 64; ///< frames
    MergedVelocities merged_velocities = MergedVelocities::Keep;
    /// Where clusters may merge, those that are formed at the start are divided until speed ratio and angle
    /// hold within each. Without it the start divides by place alone, as in the paper.
    bool build_respects_limits = false;

    friend bool operator==(const MotionSettings&, const MotionSettings&) = default;
};

template <class Visitor>
void for_each_field(MotionSettings& motion, Visitor&& visit)
{
    visit(
        Field{"kind", "", "How members move with their cluster: by its linearised flow, freely, or rigidly."},
        motion.motion);
    visit(
        Field{"clock", "", "A flow map is renewed after this share of the tidal time 1/sqrt(|T|).", 1e-3, 10},
        motion.clock);
    visit(Field{"shortest_life", "frames", "Shortest life of a flow map; a power of two.", 1, 1024},
          motion.shortest_life);
    visit(Field{"longest_life", "frames", "Longest life of a flow map; a power of two.", 1, 65536},
          motion.longest_life);
    visit(Field{"merged_velocities", "", "Of clusters that merge: kept, or both set to their mean."},
          motion.merged_velocities);
    visit(Field{"build_respects_limits", "",
                "The first clusters are divided until speed_ratio and angle hold within each."},
          motion.build_respects_limits);
}

} // namespace slod
