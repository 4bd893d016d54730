#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cost/distances.hpp"
#include "cost/drifts.hpp"
#include "cost/setting.hpp"
#include "cost/trial.hpp"

namespace slod::cost {

/// The outcome for one setting.
struct Row {
    Setting setting;
    Setting in_full;                              ///< with what the scene says
    double ms_median = 0, ms_p10 = 0, ms_p90 = 0; ///< of a frame of the scene
    double particles = 0, clusters = 0;           ///< at the end
    Distances apart;                              ///< from the reference
    Distances errors;                             ///< the same in noise floors
    double median_displacement = 0;   ///< of each particle, in rms radii; chaotic where there is gravity
    double r10 = 0, r50 = 0, r90 = 0; ///< Lagrangian radii over the reference's
    double thickness = 0;             ///< over the reference's
    AccelerationErrors force;
    Drifts drifts;
    StepProfile phases; ///< mean ms of a frame
};

/// Calls visit(name, number) for all that is measured by itself, which is all but the errors in noise floors:
/// the only list of these numbers.
template <class SomeRow, class Visitor>
void for_each_number(SomeRow& row, Visitor&& visit) requires std::is_same_v<std::remove_const_t<SomeRow>, Row>
{
    visit("ms_median", row.ms_median);
    visit("ms_p10", row.ms_p10);
    visit("ms_p90", row.ms_p90);
    visit("particles", row.particles);
    visit("clusters", row.clusters);
    for (const DistanceMember& member : distance_members)
        visit(std::string("distance_") + member.name, row.apart.*member.value);
    visit("median_displacement", row.median_displacement);
    visit("r10", row.r10);
    visit("r50", row.r50);
    visit("r90", row.r90);
    visit("thickness", row.thickness);
    visit("force_error_median", row.force.median);
    visit("force_error_p90", row.force.p90);
    visit("force_error_p99", row.force.p99);
    visit("force_error_max", row.force.max);
    visit("momentum_drift", row.drifts.momentum);
    visit("angular_momentum_drift", row.drifts.angular_momentum);
    visit("energy_drift", row.drifts.energy);
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        visit("ms_" + std::string(names(Phase{})[phase]), row.phases.milliseconds[phase]);
}

/// Rows of the motion, and the unclustered ones, that no other of them beats in both time and error, by time.
std::vector<Row> pareto_front(const std::vector<Row>& rows, Motion motion);

} // namespace slod::cost
