// The wave kernels of one instruction set; see kernel_table.inl. Lanes are places; waves pass by them one
// after another.

#include "simd/wave_kernels.hpp"

namespace slod::simd::SLOD_ISA {
namespace {

struct WaveSums {
    Lanes<double> value[3], gradient[3][3];
};

/// Sets sine and cosine of 2 pi `turns`, |turns| below 2^50, lane by lane: Taylor series of a quarter of the
/// angle, doubled twice. Error below 1e-10, in both alike.
void turn(const Lanes<double>& turns, Lanes<double>& sine, Lanes<double>& cosine)
{
    constexpr double to_whole = 0x1.8p52; // adding it rounds to a whole number
    constexpr double quarter = 1.5707963267948966;
    constexpr double s3 = -1.0 / 6, s5 = 1.0 / 120, s7 = -1.0 / 5040, s9 = 1.0 / 362'880,
                     s11 = -1.0 / 39'916'800, s13 = 1.0 / 6'227'020'800;
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40'320, c10 = -1.0 / 3'628'800,
                     c12 = 1.0 / 479'001'600;
    const Lanes<double> y = quarter * (turns - ((turns + to_whole) - to_whole));
    const Lanes<double> q = y * y;
    const Lanes<double> s = y * (1 + q * (s3 + q * (s5 + q * (s7 + q * (s9 + q * (s11 + q * s13))))));
    const Lanes<double> c = 1 + q * (-0.5 + q * (c4 + q * (c6 + q * (c8 + q * (c10 + q * c12)))));
    const Lanes<double> s2 = 2 * s * c, c2 = 1 - 2 * s * s;
    sine = 2 * s2 * c2;
    cosine = 1 - 2 * s2 * s2;
}

/// Of every second wave from `from` on, at the places from `first` on.
WaveSums sum_of(const Waves& waves, std::size_t from, const WavePlaces& places, std::size_t first)
{
    const Lanes<double> x = load(places.x[0] + first), y = load(places.x[1] + first),
                        z = load(places.x[2] + first);
    WaveSums sums{};
    for (std::size_t w = from; w < waves.count; w += 2) {
        const double number[3] = {waves.number[0][w], waves.number[1][w], waves.number[2][w]};
        const Lanes<double> turns =
            number[0] * x + number[1] * y + number[2] * z + waves.shift[w] + waves.phase[w];
        Lanes<double> sine, cosine;
        turn(turns, sine, cosine);
        for (int i = 0; i < 3; ++i) {
            sums.value[i] += waves.velocity[i][w] * cosine;
            const Lanes<double> slope = waves.velocity[i][w] * sine;
            for (int j = 0; j < 3; ++j)
                sums.gradient[i][j] -= slope * number[j];
        }
    }
    return sums;
}

void store(double* to, const Lanes<double>& lanes)
{
    __builtin_memcpy(to, &lanes, sizeof lanes);
}

void sum_up_waves(const Waves& waves, const WavePlaces& places)
{
    constexpr double two_pi = 6.283185307179586;
    for (std::size_t first = 0; first < places.padded_count; first += lane_count<double>) {
        const WaveSums even = sum_of(waves, 0, places, first), odd = sum_of(waves, 1, places, first);
        for (int i = 0; i < 3; ++i) {
            store(places.value[i] + first, even.value[i] + odd.value[i]);
            for (int j = 0; j < 3; ++j)
                store(places.gradient[i][j] + first, two_pi * (even.gradient[i][j] + odd.gradient[i][j]));
        }
    }
}

constexpr WaveKernels wave_kernels = {sum_up_waves};

} // namespace
} // namespace slod::simd::SLOD_ISA
