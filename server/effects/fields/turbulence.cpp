#include "effects/fields/turbulence.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

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

/// Sets sine and cosine of 2 pi `turns`, |turns| below 2^50, lane by lane: Taylor series of a quarter of the
/// angle, doubled twice. Error below 1e-10, in both alike.
template <class Lanes>
void turn(const Lanes& turns, Lanes& sine, Lanes& cosine)
{
    constexpr double to_whole = 0x1.8p52; // adding it rounds to a whole number
    constexpr double s3 = -1.0 / 6, s5 = 1.0 / 120, s7 = -1.0 / 5040, s9 = 1.0 / 362'880,
                     s11 = -1.0 / 39'916'800, s13 = 1.0 / 6'227'020'800;
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40'320, c10 = -1.0 / 3'628'800,
                     c12 = 1.0 / 479'001'600;
    const Lanes y = 0.5 * std::numbers::pi * (turns - ((turns + to_whole) - to_whole));
    const Lanes q = y * y;
    const Lanes s = y * (1 + q * (s3 + q * (s5 + q * (s7 + q * (s9 + q * (s11 + q * s13))))));
    const Lanes c = 1 + q * (-0.5 + q * (c4 + q * (c6 + q * (c8 + q * (c10 + q * c12)))));
    const Lanes s2 = 2 * s * c, c2 = 1 - 2 * s * s;
    sine = 2 * s2 * c2;
    cosine = 1 - 2 * s2 * s2;
}

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

Turbulence::Turbulence(const Settings& settings, const FieldSource& source) : settings_(settings)
{
    constexpr double slower = 0.7937005259840998; // 2^(-1/3)
    double speed = 1, number = 1 / settings.length, rate = 1 / settings.time, square = 0;
    for (std::uint32_t octave = 0; octave < settings.octaves; ++octave) {
        for (std::size_t wave = 0; wave < waves_of_octave; ++wave) {
            Random random(source.seed, stream, octave * waves_of_octave + wave);
            const Vector3d direction = random_direction(random);
            const Vector3d velocity = speed * direction.cross(random_direction(random)).normalized();
            const std::size_t lane = wave % lanes;
            if (lane == 0)
                waves_.emplace_back();
            Waves& waves = waves_.back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                waves.number[axis][lane] = number * direction[Eigen::Index(axis)];
                waves.velocity[axis][lane] = velocity[Eigen::Index(axis)];
            }
            waves.rate[lane] = rate * (2 * random.uniform() - 1);
            waves.phase[lane] = random.uniform();
            square += 0.5 * speed * speed; // the mean of a squared cosine
        }
        speed *= slower;
        number *= 2;
        rate /= slower * slower;
    }
    const double scale = settings.amplitude / std::sqrt(square);
    for (Waves& waves : waves_)
        for (Lanes& component : waves.velocity)
            component *= scale;
}

std::vector<Turbulence::Wave> Turbulence::waves() const
{
    std::vector<Wave> all;
    for (const Waves& waves : waves_)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            all.push_back({{waves.number[0][lane], waves.number[1][lane], waves.number[2][lane]},
                           {waves.velocity[0][lane], waves.velocity[1][lane], waves.velocity[2][lane]},
                           waves.rate[lane],
                           waves.phase[lane]});
    return all;
}

void Turbulence::add(const Vector3d& x, double time, FieldValue& sum) const
{
    std::array<Lanes, 3> value{};
    std::array<std::array<Lanes, 3>, 3> gradient{};
    for (const Waves& waves : waves_) {
        const Lanes turns = waves.number[0] * x.x() + waves.number[1] * x.y() + waves.number[2] * x.z() +
                            waves.rate * time + waves.phase;
        Lanes sine, cosine;
        turn(turns, sine, cosine);
        for (std::size_t i = 0; i < 3; ++i) {
            value[i] += waves.velocity[i] * cosine;
            const Lanes slope = waves.velocity[i] * sine;
            for (std::size_t j = 0; j < 3; ++j)
                gradient[i][j] -= slope * waves.number[j];
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        sum.value[Eigen::Index(i)] += value[i][0] + value[i][1];
        for (std::size_t j = 0; j < 3; ++j)
            sum.gradient(Eigen::Index(i), Eigen::Index(j)) +=
                2 * std::numbers::pi * (gradient[i][j][0] + gradient[i][j][1]);
    }
}

} // namespace slod
