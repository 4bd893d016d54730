#include "sim/simulation.hpp"
#include "sim/state.hpp"

namespace slod {

void Simulation::State::sample(const Request& request)
{
    if (request.error_pairs == 0)
        return;
    if (meter.idle()) {
        for (ErrorMeter::Drawn& drawn : meter.draw(tree, store, frame))
            compare(drawn);
        meter.begin(tree, store, frame, settings.gravity ? gravitational_constant : 0);
    }
    snapshot.counts.error_pairs = meter.advance(tree, store, frame, request.error_pairs);
}

/// What a member's cluster gives it, and what it should get but for the particles' attraction.
void Simulation::State::compare(ErrorMeter::Drawn& drawn) const
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = drawn.slot.index;
    const Vector3d& x = drawn.member.position;
    const Vector3d away = x - clusters.position[slot];
    if (clusters.columns.acceleration)
        drawn.given = clusters.acceleration[slot];
    if (clusters.columns.acceleration && clusters.columns.map)
        drawn.given += clusters.gradient(slot) * away - clusters.closure[slot] * away;
    if (field_forces)
        drawn.rest = field_forces->at(x, time()).value;
    drawn.given += air_by_cluster(slot, away, drawn.member.velocity);
    drawn.rest += air_at(x, drawn.member.velocity);
}

/// Gravity and air resistance of what is there by itself.
Vector3d Simulation::State::air_at(const Vector3d& x, const Vector3d& v) const
{
    return plan.local_air ? air->mean_acceleration(x, v, time())
                          : Vector3d(fields.gravity - fields.drag * (v - fields.wind));
}

/// The same as a cluster has it for a member that is `away` from its centre at velocity `v`.
Vector3d Simulation::State::air_by_cluster(std::size_t slot, const Vector3d& away, const Vector3d& v) const
{
    const Vector3d& centre = store.clusters.position[slot];
    const Vector3d& velocity = store.clusters.velocity[slot];
    const Vector3d faster = v - velocity, of_centre = air_at(centre, velocity);
    if (plan.map == MapKind::Identity)
        return of_centre;
    if (plan.map == MapKind::Full && plan.local_air)
        return of_centre + air->tangent_acceleration(centre, velocity, time(), away, faster);
    return of_centre - fields.drag * faster;
}

ErrorEstimate Simulation::error() const
{
    return state_->meter.error();
}

std::vector<RegionError> Simulation::region_errors() const
{
    return state_->meter.region_errors(state_->tree);
}

void Simulation::forget_errors()
{
    state_->meter.forget();
}

std::span<const ErrorSample> Simulation::take_error_samples()
{
    return state_->meter.take_samples();
}

} // namespace slod
