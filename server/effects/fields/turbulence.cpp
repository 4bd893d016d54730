#include "effects/fields/turbulence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "core/portable_math.hpp"
#include "core/random.hpp"

namespace slod {
namespace {

constexpr std::uint32_t stream = 0xffff'0001; ///< of random numbers: no emitter's

Vector3d random_direction(Random& random)
{
    const double cosine = 2 * random.uniform() - 1;
    const double sine = std::sqrt(1 - cosine * cosine);
    const SineCosine turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    return {sine * turn.cosine, sine * turn.sine, cosine};
}

constexpr std::size_t tile = 64; ///< places that are summed up together
static_assert(tile % simd::wave_width == 0);

} // namespace

Problems Turbulence::problems(const Settings& settings, double)
{
    Problems found;
    if (settings.length <= 0)
        found.push_back("length = 0 leaves eddies without a size; use more than 0.");
    if (settings.time <= 0)
        found.push_back("time = 0 lets eddies change at once; use more than 0, or inf.");
    return found;
}

Turbulence::Turbulence(const Settings& settings, const FieldSource& source)
    : settings_(settings), kernels_(source.waves)
{
    constexpr double slower = 0.7937005259840998; // 2^(-1/3)
    double speed = 1, number = 1 / settings.length, rate = 1 / settings.time, square = 0;
    for (std::uint32_t octave = 0; octave < settings.octaves; ++octave) {
        for (std::size_t wave = 0; wave < waves_of_octave; ++wave) {
            Random random(source.seed, stream, octave * waves_of_octave + wave);
            const Vector3d direction = random_direction(random);
            const Vector3d velocity = speed * direction.cross(random_direction(random)).normalized();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                number_[axis].push_back(number * direction[Eigen::Index(axis)]);
                velocity_[axis].push_back(velocity[Eigen::Index(axis)]);
            }
            rate_.push_back(rate * (2 * random.uniform() - 1));
            phase_.push_back(random.uniform());
            square += 0.5 * speed * speed; // the mean of a squared cosine
        }
        speed *= slower;
        number *= 2;
        rate /= slower * slower;
    }
    const double scale = settings.amplitude / std::sqrt(square);
    for (std::vector<double>& components : velocity_)
        for (double& component : components)
            component *= scale;
}

std::vector<Turbulence::Wave> Turbulence::waves() const
{
    std::vector<Wave> all;
    for (std::size_t wave = 0; wave < rate_.size(); ++wave)
        all.push_back({{number_[0][wave], number_[1][wave], number_[2][wave]},
                       {velocity_[0][wave], velocity_[1][wave], velocity_[2][wave]},
                       rate_[wave],
                       phase_[wave]});
    return all;
}

/// As the kernels take them, with `shifts` of that time.
simd::Waves Turbulence::waves_at(double time, Shifts& shifts) const
{
    for (std::size_t wave = 0; wave < rate_.size(); ++wave)
        shifts[wave] = rate_[wave] * time;
    simd::Waves waves{
        .count = rate_.size(), .number = {}, .velocity = {}, .shift = shifts.data(), .phase = phase_.data()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        waves.number[axis] = number_[axis].data();
        waves.velocity[axis] = velocity_[axis].data();
    }
    return waves;
}

void Turbulence::add(const Vector3d& x, double time, FieldValue& sum) const
{
    Shifts shifts;
    double value[3], gradient[3][3];
    kernels_->sum_up_at(waves_at(time, shifts), {x.x(), x.y(), x.z()}, value, gradient);
    for (int i = 0; i < 3; ++i) {
        sum.value[i] += value[i];
        for (int j = 0; j < 3; ++j)
            sum.gradient(i, j) += gradient[i][j];
    }
}

void Turbulence::add_all(std::span<const Vector3d> places, double time,
                         std::span<FieldValue* const> sums) const
{
    Shifts shifts;
    const simd::Waves waves = waves_at(time, shifts);
    for (std::size_t first = 0; first < places.size(); first += tile) {
        const std::size_t count = std::min(tile, places.size() - first);
        add_some(places.subspan(first, count), waves, sums.subspan(first, count));
    }
}

/// At a tile of places, at most.
void Turbulence::add_some(std::span<const Vector3d> places, const simd::Waves& waves,
                          std::span<FieldValue* const> sums) const
{
    using Column = std::array<double, tile>;
    std::array<Column, 3> x, value;
    std::array<std::array<Column, 3>, 3> gradient;
    const std::size_t padded = block_count(places.size(), simd::wave_width) * simd::wave_width;
    simd::WavePlaces columns{.padded_count = padded, .x = {}, .value = {}, .gradient = {}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t place = 0; place < padded; ++place)
            x[i][place] = place < places.size() ? places[place][Eigen::Index(i)] : 0.0;
        columns.x[i] = x[i].data();
        columns.value[i] = value[i].data();
        for (std::size_t j = 0; j < 3; ++j)
            columns.gradient[i][j] = gradient[i][j].data();
    }
    kernels_->sum_up(waves, columns);
    for (std::size_t place = 0; place < places.size(); ++place)
        for (std::size_t i = 0; i < 3; ++i) {
            sums[place]->value[Eigen::Index(i)] += value[i][place];
            for (std::size_t j = 0; j < 3; ++j)
                sums[place]->gradient(Eigen::Index(i), Eigen::Index(j)) += gradient[i][j][place];
        }
}

} // namespace slod
