#include "effects/emitter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/portable_math.hpp"
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

Emitter::Emitter(const EmitterSettings& settings, std::uint32_t index, std::uint8_t kind, std::uint64_t seed,
                 const simd::NumberKernels& numbers)
    : settings_(settings), starts_(settings), index_(index), kind_(kind), seed_(seed), numbers_(numbers),
      axes_(axes_along(settings.direction)), shape_(kind_of(settings.shape)),
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

Emitter::Starts Emitter::starts_in(std::uint64_t frame, double step) const
{
    const double begin = double(frame - 1) * step, end = double(frame) * step;
    const std::uint64_t first = count_before(begin);
    return {frame, step, first, count_before(end) - first,
            starts_.window(since_start(begin), since_start(end))};
}

void Emitter::bear(const Starts& starts, std::uint64_t from, const Surroundings& surroundings,
                   std::span<Newborn> newborns) const
{
    const double end = double(starts.frame) * starts.step;
    Draws draws;
    for (std::size_t done = 0; done < newborns.size(); done += Draws::particles) {
        const auto some = newborns.subspan(done, std::min(Draws::particles, newborns.size() - done));
        const std::uint64_t first = starts.first + from + done;
        draw(first, some.size(), draws);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const double start = settings_.start + starts_.time_of(first + i, starts.window);
            some[i] = newborn(first + i, start, starts, draws, i);
            fly(some[i], surroundings, starts.frame, end);
        }
    }
}

/// Of the particles from k on.
void Emitter::draw(std::uint64_t k, std::size_t count, Draws& draws) const
{
    const simd::RandomItems items{{std::uint32_t(seed_), std::uint32_t(seed_ >> 32)}, index_, k, count};
    for (std::size_t number = 0; number < Draws::of_velocity + shape_.numbers; number += 2)
        numbers_.fill_uniforms(items, std::uint32_t(number / 2), draws.uniform[number].data(),
                               draws.uniform[number + 1].data());
    std::array<double, Draws::particles> angle;
    for (std::size_t i = 0; i < count; ++i)
        angle[i] = 2 * std::numbers::pi * draws.uniform[1][i];
    numbers_.sines_and_cosines(angle.data(), count, draws.sine.data(), draws.cosine.data());
}

/// As it is at its birth.
Newborn Emitter::newborn(std::uint64_t k, double start, const Starts& starts, const Draws& draws,
                         std::size_t place) const
{
    Newborn born;
    born.age = std::max(double(starts.frame) * starts.step - start, 0.0);
    born.particle.velocity = velocity_at_birth(draws, place);
    born.particle.position = settings_.position + start * settings_.velocity;
    born.particle.position += shape_.draw(
        settings_, axes_,
        DrawnNumbers(&draws.uniform[Draws::of_velocity][place], Draws::particles, shape_.numbers));
    born.particle.id = (std::uint64_t{index_} + 1) << id_shift | k;
    born.particle.mass = float(settings_.particle_mass);
    born.particle.kind = kind_;
    const double last_frame = std::ceil((start + settings_.lifetime) / starts.step);
    if (last_frame < double(Particle::never))
        born.particle.expiry_frame = std::uint32_t(last_frame);
    return born;
}

Vector3d Emitter::velocity_at_birth(const Draws& draws, std::size_t place) const
{
    const double cosine = 1 - draws.uniform[0][place] * (1 - cone_cosine_);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double speed = settings_.speed * (1 + settings_.speed_spread * (2 * draws.uniform[2][place] - 1));
    return speed * (cosine * axes_.forward +
                    sine * (draws.cosine[place] * axes_.side + draws.sine[place] * axes_.other_side)) +
           settings_.inherit * settings_.velocity;
}

/// From its birth to the frame's end.
void Emitter::fly(Newborn& born, const Surroundings& surroundings, std::uint64_t frame, double end)
{
    Vector3d& position = born.particle.position;
    Vector3d& velocity = born.particle.velocity;
    born.from = position;
    const UniformFields felt =
        surroundings.air == nullptr
            ? surroundings.fields
            : surroundings.air->felt(position, velocity, end - born.age, born.age).fields;
    if (surroundings.colliders == nullptr) {
        felt.over(born.age).apply(position, velocity);
        return;
    }
    const auto met = surroundings.colliders->fly(position, velocity, born.age, {0, 0, 0}, felt);
    if (met.touched)
        born.from = position;
    if (met.killed)
        born.particle.expiry_frame = std::uint32_t(frame);
}

} // namespace slod
