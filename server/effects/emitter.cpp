#include "effects/emitter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "core/portable_math.hpp"
#include "core/random.hpp"
#include "effects/solid.hpp"

namespace slod {

namespace {

EmitterAxes axes_along(const Vector3d& direction)
{
    EmitterAxes axes;
    axes.forward = direction.stableNormalized();
    axes.side = across(axes.forward);
    axes.other_side = axes.forward.cross(axes.side);
    return axes;
}

} // namespace

Emitter::Emitter(const EmitterSettings& settings, std::uint32_t index, std::uint8_t kind, std::uint64_t seed)
    : settings_(settings), starts_(settings), index_(index), kind_(kind), seed_(seed),
      axes_(axes_along(settings.direction)), draw_offset_(kind_of(settings.shape).draw),
      cone_cosine_(portable_sincos(settings.cone_angle_deg * std::numbers::pi / 180).cosine)
{}

/// Time since the start, until the stop.
double Emitter::since_start(double time) const
{
    return std::max(std::min(time, settings_.stop) - settings_.start, 0.0);
}

std::uint64_t Emitter::count_before(double time) const
{
    return starts_.count_before(since_start(time));
}

std::uint64_t Emitter::emit(std::uint64_t frame, double step, const UniformFields& fields, std::uint64_t room,
                            std::vector<Newborn>& newborns, const Colliders* colliders, const Air* air) const
{
    const double begin = double(frame - 1) * step, end = double(frame) * step;
    const std::uint64_t first = count_before(begin);
    const std::uint64_t started = count_before(end) - first;
    const std::uint64_t count = std::min(started, room);
    const auto window = starts_.window(since_start(begin), since_start(end));
    const std::size_t before = newborns.size();
    newborns.resize(before + count);
    for_each_block(count, 1024, [&](std::size_t from, std::size_t last) {
        for (std::size_t i = from; i < last; ++i) {
            Newborn& born = newborns[before + i];
            const std::uint64_t k = first + i;
            born = newborn(k, settings_.start + starts_.time_of(k, window), end, step);
            Vector3d& position = born.particle.position;
            Vector3d& velocity = born.particle.velocity;
            born.from = position;
            const UniformFields felt =
                air == nullptr ? fields : air->felt(position, velocity, end - born.age, born.age).fields;
            if (colliders == nullptr) {
                felt.over(born.age).apply(position, velocity);
                continue;
            }
            const auto met = colliders->fly(position, velocity, born.age, {0, 0, 0}, felt);
            if (met.touched)
                born.from = position;
            if (met.killed)
                born.particle.expiry_frame = std::uint32_t(frame);
        }
    });
    std::erase_if(newborns, [&](const Newborn& born) { return born.particle.expiry_frame <= frame; });
    return started - count;
}

/// As it is at its birth.
Newborn Emitter::newborn(std::uint64_t k, double start, double end, double step) const
{
    Random random(seed_, index_, k);
    Newborn born;
    born.age = std::max(end - start, 0.0);
    born.particle.velocity = velocity_at_birth(random);
    born.particle.position = settings_.position + start * settings_.velocity;
    born.particle.position += draw_offset_(settings_, axes_, random);
    born.particle.id = (std::uint64_t{index_} + 1) << id_shift | k;
    born.particle.mass = float(settings_.particle_mass);
    born.particle.kind = kind_;
    const double last_frame = std::ceil((start + settings_.lifetime) / step);
    if (last_frame < double(Particle::never))
        born.particle.expiry_frame = std::uint32_t(last_frame);
    return born;
}

Vector3d Emitter::velocity_at_birth(Random& random) const
{
    const double cosine = 1 - random.uniform() * (1 - cone_cosine_);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const auto turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    const double speed = settings_.speed * (1 + settings_.speed_spread * (2 * random.uniform() - 1));
    return speed *
               (cosine * axes_.forward + sine * (turn.cosine * axes_.side + turn.sine * axes_.other_side)) +
           settings_.inherit * settings_.velocity;
}

} // namespace slod
