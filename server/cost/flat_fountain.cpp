#include "cost/flat_fountain.hpp"

#include <numbers>

#include <Eigen/Geometry>

#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "core/portable_math.hpp"
#include "effects/solid.hpp"

namespace slod::cost {

namespace baseline {
extern const FlatKernels table;
}
namespace v3 {
extern const FlatKernels table;
}
namespace v4 {
extern const FlatKernels table;
}

namespace {

constexpr float nowhere = -1e30F;   ///< the height of no ground
constexpr std::size_t block = 8192; ///< droplets of one task, which fit the second level cache

void copy(const Vector3d& from, float (&to)[3])
{
    for (int axis = 0; axis < 3; ++axis)
        to[axis] = float(from[axis]);
}

FlatStep step_of(const SimulationSettings& scene, const UniformFields& fields)
{
    const Propagator exact = fields.over(scene.time.step);
    FlatStep step{};
    step.drift = float(exact.drift);
    step.decay_minus_1 = float(exact.decay_minus_1);
    copy(exact.shift, step.shift);
    copy(exact.gain, step.gain);
    step.half_step = float(0.5 * scene.time.step);
    step.carried = float(scene.time.step - exact.drift);
    step.ground = nowhere;
    for (const ColliderSettings& ground : scene.colliders) {
        SLOD_ASSERT(ground.shape == ColliderShape::Plane && ground.normal == Vector3d(0, 0, 1));
        step.ground = float(ground.position.z());
        step.restitution = float(ground.restitution);
    }
    return step;
}

FlatStream stream_of(const EmitterSettings& emitter, const UniformFields& fields, double step)
{
    FlatStream stream{};
    const Vector3d forward = emitter.direction.normalized(), side = across(forward);
    copy(emitter.position, stream.position);
    copy(forward, stream.forward);
    copy(side, stream.side);
    copy(forward.cross(side), stream.other_side);
    stream.speed = float(emitter.speed);
    stream.speed_spread = float(emitter.speed_spread);
    stream.cone_cosine = float(portable_sincos(emitter.cone_angle_deg * std::numbers::pi / 180).cosine);
    stream.step = float(step);
    stream.drag = float(fields.drag);
    copy(fields.gravity, stream.gravity);
    copy(fields.wind, stream.wind);
    return stream;
}

} // namespace

const FlatKernels& flat_kernels(std::string_view isa)
{
    for (const FlatKernels* kernels : {&baseline::table, &v3::table, &v4::table})
        if (kernels->name == isa)
            return *kernels;
    SLOD_ASSERT(false);
    return baseline::table;
}

FlatFountain::FlatFountain(const SimulationSettings& scene, std::size_t per_frame, std::size_t lifetime,
                           std::string_view isa)
    : kernels_(&flat_kernels(isa)), duration_(scene.time.step), per_frame_(per_frame), lifetime_(lifetime)
{
    SLOD_ASSERT(per_frame % flat_lanes == 0);
    const UniformFields fields(scene.uniform_gravity, scene.linear_drag, scene.uniform_wind);
    step_ = step_of(scene, fields);
    for (const EmitterSettings& emitter : scene.emitters)
        streams_.push_back(stream_of(emitter, fields, duration_));
    if (const auto& eddies = scene.fields.of<Turbulence>())
        waves_ = Turbulence(*eddies, {scene.seed}).waves();
    for (AlignedVector<float>& array : arrays_)
        array.resize(streams_.size() * per_frame_ * lifetime_);
}

FlatDroplets FlatFountain::droplets()
{
    return {arrays_[0].data(), arrays_[1].data(), arrays_[2].data(),
            arrays_[3].data(), arrays_[4].data(), arrays_[5].data()};
}

/// Half a frame after the last step.
std::vector<FlatWave> FlatFountain::waves_now() const
{
    std::vector<FlatWave> waves(waves_.size());
    for (std::size_t i = 0; i < waves.size(); ++i) {
        copy(waves_[i].number, waves[i].number);
        copy(waves_[i].velocity, waves[i].velocity);
        const double turns = waves_[i].rate * (double(frame_) + 0.5) * duration_ + waves_[i].phase;
        waves[i].turns = float(turns);
    }
    return waves;
}

void FlatFountain::move(std::size_t first, std::size_t last, const std::vector<FlatWave>& waves)
{
    for_each_block(last - first, block, [&](std::size_t from, std::size_t to) {
        if (waves.empty())
            kernels_->move(droplets(), first + from, first + to, step_);
        else
            kernels_->move_in_waves(droplets(), first + from, first + to, step_, waves.data(), waves.size());
    });
}

void FlatFountain::step()
{
    const std::vector<FlatWave> waves = waves_now();
    const std::size_t living = alive();
    ++frame_;
    const std::size_t born = newborn(0), batch = streams_.size() * per_frame_;
    move(0, std::min(born, living), waves);
    move(std::min(born + batch, living), living, waves);
    for (std::size_t stream = 0; stream < streams_.size(); ++stream)
        for_each_block(per_frame_, block, [&](std::size_t first, std::size_t last) {
            const auto key = std::uint32_t(frame_ * streams_.size() + stream) * 0x9e3779b9U;
            kernels_->bear(droplets(), newborn(stream) + first, first, last, per_frame_, streams_[stream],
                           key);
        });
}

std::size_t FlatFountain::alive() const
{
    return std::size_t(std::min<std::uint64_t>(frame_, lifetime_)) * streams_.size() * per_frame_;
}

std::size_t FlatFountain::newborn(std::size_t stream) const
{
    return ((frame_ - 1) % lifetime_ * streams_.size() + stream) * per_frame_;
}

Vector3d FlatFountain::position(std::size_t droplet) const
{
    return {arrays_[0][droplet], arrays_[1][droplet], arrays_[2][droplet]};
}

Vector3d FlatFountain::velocity(std::size_t droplet) const
{
    return {arrays_[3][droplet], arrays_[4][droplet], arrays_[5][droplet]};
}

} // namespace slod::cost
