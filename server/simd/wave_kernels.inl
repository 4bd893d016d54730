// The wave kernels of one instruction set; see kernel_table.inl. Lanes are places, and waves pass by them one
// after another; at a single place they are two waves.

#include "simd/lanes.inl"
#include "simd/wave_kernels.hpp"

namespace slod::simd::SLOD_ISA {
namespace {

static_assert(wave_width % lane_count<double> == 0);

/// Two neighbouring waves.
typedef double Pair __attribute__((vector_size(2 * sizeof(double))));

template <class Numbers>
struct WaveSums {
    Numbers value[3], gradient[3][3];
};

/// Sets sine and cosine of 2 pi `turns`, |turns| below 2^50, lane by lane: Taylor series of a quarter of the
/// angle, doubled twice, so that there are no quadrants to choose among. Error below 1e-10, in both alike,
/// which is nothing to waves that are made up.
template <class Numbers>
void turn_roughly(const Numbers& turns, Numbers& sine, Numbers& cosine)
{
    constexpr double to_whole = 0x1.8p52; // adding it rounds to a whole number
    constexpr double quarter = 1.5707963267948966;
    constexpr double s3 = -1.0 / 6, s5 = 1.0 / 120, s7 = -1.0 / 5040, s9 = 1.0 / 362'880,
                     s11 = -1.0 / 39'916'800, s13 = 1.0 / 6'227'020'800;
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40'320, c10 = -1.0 / 3'628'800,
                     c12 = 1.0 / 479'001'600;
    const Numbers y = quarter * (turns - ((turns + to_whole) - to_whole));
    const Numbers q = y * y;
    const Numbers s = y * (1 + q * (s3 + q * (s5 + q * (s7 + q * (s9 + q * (s11 + q * s13))))));
    const Numbers c = 1 + q * (-0.5 + q * (c4 + q * (c6 + q * (c8 + q * (c10 + q * c12)))));
    const Numbers s2 = 2 * s * c, c2 = 1 - 2 * s * s;
    sine = 2 * s2 * c2;
    cosine = 1 - 2 * s2 * s2;
}

/// Adds one wave, or one in each lane.
template <class Numbers, class Parts>
void add_wave(const Parts (&number)[3], const Parts (&velocity)[3], const Numbers& turns,
              WaveSums<Numbers>& sums)
{
    Numbers sine, cosine;
    turn_roughly(turns, sine, cosine);
    for (int i = 0; i < 3; ++i) {
        sums.value[i] += velocity[i] * cosine;
        const Numbers slope = velocity[i] * sine;
        for (int j = 0; j < 3; ++j)
            sums.gradient[i][j] -= slope * number[j];
    }
}

constexpr double two_pi = 6.283185307179586;

/// Of every second wave from `from` on, at the places from `first` on.
WaveSums<Lanes<double>> sum_of(const Waves& waves, std::size_t from, const WavePlaces& places,
                               std::size_t first)
{
    const Lanes<double> x = load(places.x[0] + first), y = load(places.x[1] + first),
                        z = load(places.x[2] + first);
    WaveSums<Lanes<double>> sums{};
    for (std::size_t w = from; w < waves.count; w += 2) {
        const double number[3] = {waves.number[0][w], waves.number[1][w], waves.number[2][w]};
        const double velocity[3] = {waves.velocity[0][w], waves.velocity[1][w], waves.velocity[2][w]};
        const Lanes<double> turns =
            number[0] * x + number[1] * y + number[2] * z + waves.shift[w] + waves.phase[w];
        add_wave(number, velocity, turns, sums);
    }
    return sums;
}

void sum_up_waves(const Waves& waves, const WavePlaces& places)
{
    for (std::size_t first = 0; first < places.padded_count; first += lane_count<double>) {
        const auto even = sum_of(waves, 0, places, first), odd = sum_of(waves, 1, places, first);
        for (int i = 0; i < 3; ++i) {
            store(places.value[i] + first, even.value[i] + odd.value[i]);
            for (int j = 0; j < 3; ++j)
                store(places.gradient[i][j] + first, two_pi * (even.gradient[i][j] + odd.gradient[i][j]));
        }
    }
}

Pair two(const double* from)
{
    Pair pair;
    __builtin_memcpy(&pair, from, sizeof pair);
    return pair;
}

void sum_up_waves_at(const Waves& waves, const double (&x)[3], double (&value)[3], double (&gradient)[3][3])
{
    WaveSums<Pair> sums{};
    for (std::size_t w = 0; w < waves.count; w += 2) {
        const Pair number[3] = {two(waves.number[0] + w), two(waves.number[1] + w), two(waves.number[2] + w)};
        const Pair velocity[3] = {two(waves.velocity[0] + w), two(waves.velocity[1] + w),
                                  two(waves.velocity[2] + w)};
        const Pair turns = number[0] * x[0] + number[1] * x[1] + number[2] * x[2] + two(waves.shift + w) +
                           two(waves.phase + w);
        add_wave(number, velocity, turns, sums);
    }
    for (int i = 0; i < 3; ++i) {
        value[i] = sums.value[i][0] + sums.value[i][1];
        for (int j = 0; j < 3; ++j)
            gradient[i][j] = two_pi * (sums.gradient[i][j][0] + sums.gradient[i][j][1]);
    }
}

constexpr WaveKernels wave_kernels = {sum_up_waves, sum_up_waves_at};

} // namespace
} // namespace slod::simd::SLOD_ISA
