#include "app/run_summary.hpp"

#include <cmath>
#include <limits>

namespace slod {
namespace {

double ratio(double change, double scale)
{
    return scale > 0 ? change / scale : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

void RunSummary::add(const Snapshot& snapshot, double work_ms)
{
    ++frames;
    time = snapshot.time;
    particles = snapshot.counts.particles;
    clusters = snapshot.counts.clusters;
    unanswered_force = snapshot.unanswered_force;
    frame_ms.add(work_ms);
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        phase_ms[phase].add(snapshot.profile.milliseconds[phase]);

    add_events(events, snapshot.counts);
    drained += snapshot.drained;
    killed += snapshot.killed;
    quarantined += snapshot.quarantined;
}

Drift drift(const ConservedQuantities& start, const ConservedQuantities& end)
{
    return {.mass = ratio(end.mass - start.mass, start.mass),
            .momentum = ratio((end.momentum - start.momentum).norm(),
                              std::sqrt(2 * start.mass * start.kinetic_energy)),
            .angular_momentum =
                ratio((end.angular_momentum - start.angular_momentum).norm(), start.angular_momentum.norm()),
            .kinetic_energy = ratio(end.kinetic_energy - start.kinetic_energy, start.kinetic_energy)};
}

} // namespace slod
