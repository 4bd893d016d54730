#include "effects/air.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "effects/straddling.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 256;

/// d/dk of fall, (h - drift) / k under drag k; the difference would cancel where k h is small.
double fall_slope(double drag, double time, double drift, double fall)
{
    return drag * time < 1e-3 ? -time * time * time / 6 * (1 - drag * time / 2)
                              : (time * drift - 2 * fall) / drag;
}

} // namespace

Air::Air(const UniformFields& fields, const std::optional<QuadraticDragSettings>& quadratic,
         const FieldSettings& settings, const FieldSource& source, double step, Tick tick)
    : quadratic_(quadratic ? quadratic->coefficient : 0),
      winds_(std::make_unique<FieldSet<AirFields>>(settings, source, std::move(tick))), step_(step)
{
    set_uniform(fields);
}

void Air::set_uniform(const UniformFields& fields)
{
    uniform_ = fields;
    frame_ = Damping(fields.drag, step_);
}

bool Air::uniform() const
{
    return quadratic_ == 0 && winds_->uniform();
}

UniformFields Air::at(double time, std::size_t clusters)
{
    UniformFields now = uniform_;
    now.wind += winds_->at(Vector3d(0, 0, 0), time).value;
    winds_->count_for_all(clusters);
    return now;
}

Air::Felt Air::felt_in(const FieldValue& wind, const Vector3d& velocity, double duration) const
{
    Felt felt{.fields = uniform_, .wind = wind};
    felt.fields.wind += wind.value;
    if (quadratic_ > 0) {
        const MeanDrag drag =
            mean_drag(uniform_.drag, quadratic_, velocity - felt.fields.wind, uniform_.gravity, duration);
        felt.fields.drag = drag.rate;
        felt.drag_slope = drag.slope;
    }
    return felt;
}

Air::Felt Air::felt(const Vector3d& position, const Vector3d& velocity, double start, double duration) const
{
    const Vector3d middle = position + (0.5 * duration) * velocity;
    Felt felt = felt_in(winds_->at(middle, start + 0.5 * duration), velocity, duration);
    felt.middle = middle;
    return felt;
}

Air::Felt Air::felt_by_cluster(const ClusterTable& clusters, std::size_t slot) const
{
    const Vector3d& velocity = clusters.velocity[slot];
    Felt felt = felt_in(winds_at_[slot], velocity, step_);
    felt.middle = clusters.position[slot] + (0.5 * step_) * velocity;
    return felt;
}

UniformFields Air::felt_by_member(const Felt& cluster, const Vector3d& position,
                                  const Vector3d& velocity) const
{
    FieldValue wind = cluster.wind;
    wind.value += wind.gradient * (position + (0.5 * step_) * velocity - cluster.middle);
    return felt_in(wind, velocity, step_).fields;
}

/// Drag brings velocities together, so members move apart by no more than their relative velocity and twice
/// that of the air about them.
double Air::spread(const Felt& cluster, double radius, double speed) const
{
    const double gust = cluster.wind.gradient.norm() * (radius + 0.5 * step_ * speed);
    return step_ * (speed + 2 * gust);
}

Propagator Air::propagator_of(const Felt& felt) const
{
    return quadratic_ > 0 ? felt.fields.over(step_) : felt.fields.over(frame_);
}

/// Of x' = x + drift v + (h - drift) u + fall g and v' = e v + (1 - e) u + drift g, where u is the wind at
/// x + h v / 2, and the drag depends on w = v - u.
Tangent Air::tangent_of(const Felt& felt, const Propagator& flow, const Vector3d& velocity) const
{
    const Matrix3d by_place = felt.wind.gradient, by_velocity = (0.5 * step_) * felt.wind.gradient;
    const double carried = step_ - flow.drift, taken = -flow.decay_minus_1;
    Matrix3d xx = carried * by_place, xv = carried * by_velocity;
    Matrix3d vx = taken * by_place, vv = taken * by_velocity;
    if (quadratic_ > 0) {
        const double fall = drag_fall(felt.fields.drag, step_);
        const double drift_slope = fall - step_ * flow.drift;
        const Vector3d relative = velocity - felt.fields.wind;
        const Vector3d of_place = drift_slope * relative +
                                  fall_slope(felt.fields.drag, step_, flow.drift, fall) * felt.fields.gravity;
        const Vector3d of_velocity =
            -step_ * (1 + flow.decay_minus_1) * relative + drift_slope * felt.fields.gravity;
        const auto slope = felt.drag_slope.transpose();
        const Eigen::RowVector3d by_x = -(slope * by_place), by_v = slope - slope * by_velocity;
        xx += of_place * by_x;
        xv += of_place * by_v;
        vx += of_velocity * by_x;
        vv += of_velocity * by_v;
    }
    xv.diagonal().array() += flow.drift;
    vv.diagonal().array() += flow.decay_minus_1;
    return {xx.cast<float>(), xv.cast<float>(), vx.cast<float>(), vv.cast<float>()};
}

Vector3d Air::mean_acceleration(const Vector3d& position, const Vector3d& velocity, double start) const
{
    const Felt there = felt(position, velocity, start, step_);
    const Propagator flow = propagator_of(there);
    return (flow.decay_minus_1 * (velocity - there.fields.wind) + flow.drift * there.fields.gravity) / step_;
}

Vector3d Air::tangent_acceleration(const Vector3d& position, const Vector3d& velocity, double start,
                                   const Vector3d& away, const Vector3d& faster) const
{
    const Felt there = felt(position, velocity, start, step_);
    const Tangent tangent = tangent_of(there, propagator_of(there), velocity);
    return (tangent.vx.cast<double>() * away + tangent.vv.cast<double>() * faster) / step_;
}

/// Where each cluster of [first, last) will be `ahead` of now, flying straight.
void Air::ask_winds(const ClusterTable& clusters, std::size_t first, std::size_t last, double ahead,
                    double time)
{
    std::fill(winds_at_.begin() + std::ptrdiff_t(first), winds_at_.begin() + std::ptrdiff_t(last),
              FieldValue{});
    winds_->add(
        first, last, [&](std::size_t slot) { return clusters.alive(slot); },
        [&](std::size_t slot) -> Vector3d {
            return clusters.position[slot] + ahead * clusters.velocity[slot];
        },
        time, winds_at_.data());
}

void Air::ask(const ClusterStore& store, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const double ahead = 0.5 * step_, time = double(frame) * step_ + ahead;
    const bool cut = winds_->has_boundary();
    winds_at_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        ask_winds(clusters, first, last, ahead, time);
        if (cut)
            count_straddling(*winds_, store, frame, first, last);
    });
}

void Air::propagate(ClusterTable& clusters)
{
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            const Felt felt = felt_in(winds_at_[slot], clusters.velocity[slot], step_);
            const Propagator flow = propagator_of(felt);
            if (clusters.columns.map)
                slod::propagate(clusters.map[slot], tangent_of(felt, flow, clusters.velocity[slot]));
            if (clusters.columns.strain)
                clusters.strain[slot] = strain_of(felt);
            if (clusters.columns.withheld)
                clusters.withheld[slot] += flow.decay_minus_1 * clusters.withheld[slot];
            flow.apply(clusters.position[slot], clusters.velocity[slot]);
        }
    });
}

void Air::measure_strain(ClusterTable& clusters, double time)
{
    winds_at_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        ask_winds(clusters, first, last, 0, time);
        for (std::size_t slot = first; slot < last; ++slot)
            if (clusters.alive(slot))
                clusters.strain[slot] = strain_of(felt_in(winds_at_[slot], clusters.velocity[slot], step_));
    });
    winds_->take_counts();
}

/// Offsets in wind u of gradient g under drag k grow at the rate r with r^2 + k r = k g: sqrt(k g) where the
/// drag is weak, and g where it makes them tracers of the air.
double Air::strain_of(const Felt& felt) const
{
    const double gradient = felt.wind.gradient.norm(), drag = felt.fields.drag;
    if (!(drag > 0))
        return 0;
    const double rate = 2 * gradient / (1 + std::sqrt(1 + 4 * gradient / drag));
    return rate * rate;
}

} // namespace slod
