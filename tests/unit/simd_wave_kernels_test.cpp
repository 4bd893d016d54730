#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "simd/kernels.hpp"
#include "support/case_rows.hpp"

// Sums of waves beside sums in long double, and with the same bits on every processor.
namespace slod::simd {
namespace {

constexpr std::size_t waves = 36, places = 10 * wave_width;

std::vector<double> numbers(std::uint64_t item, std::size_t count, double reach)
{
    Random random(3, 0, item);
    std::vector<double> all(count);
    for (double& number : all)
        number = reach * (2 * random.uniform() - 1);
    return all;
}

/// Waves and places, and what a kernel says of them: 3 values and 9 derivatives a place.
struct Sea {
    std::vector<double> number[3], velocity[3], shift = numbers(6, waves, 9), phase = numbers(7, waves, 1),
                                                x[3];
    std::vector<double> sums[12];

    Sea()
    {
        for (std::size_t i = 0; i < 3; ++i) {
            number[i] = numbers(i, waves, 2);
            velocity[i] = numbers(3 + i, waves, 1);
            x[i] = numbers(8 + i, places, 50);
        }
        for (std::vector<double>& sum : sums)
            sum.assign(places + 1, -1);
    }

    Waves all() const
    {
        Waves all{.count = waves, .number = {}, .velocity = {}, .shift = shift.data(), .phase = phase.data()};
        for (std::size_t i = 0; i < 3; ++i) {
            all.number[i] = number[i].data();
            all.velocity[i] = velocity[i].data();
        }
        return all;
    }

    void sum_up(const WaveKernels& kernels)
    {
        WavePlaces there{.padded_count = places, .x = {}, .value = {}, .gradient = {}};
        for (std::size_t i = 0; i < 3; ++i) {
            there.x[i] = x[i].data();
            there.value[i] = sums[i].data();
            for (std::size_t j = 0; j < 3; ++j)
                there.gradient[i][j] = sums[3 + 3 * i + j].data();
        }
        kernels.sum_up(all(), there);
    }

    void sum_up_at(const WaveKernels& kernels, std::size_t place)
    {
        double value[3], gradient[3][3];
        kernels.sum_up_at(all(), {x[0][place], x[1][place], x[2][place]}, value, gradient);
        for (std::size_t i = 0; i < 3; ++i) {
            sums[i][place] = value[i];
            for (std::size_t j = 0; j < 3; ++j)
                sums[3 + 3 * i + j][place] = gradient[i][j];
        }
    }

    /// One of the sums at one place, by the C library.
    double expected(std::size_t sum, std::size_t place) const
    {
        constexpr long double two_pi = 2 * std::numbers::pi_v<long double>;
        const std::size_t i = sum < 3 ? sum : (sum - 3) / 3, j = sum % 3;
        long double all = 0;
        for (std::size_t w = 0; w < waves; ++w) {
            long double turns = shift[w] + phase[w];
            for (std::size_t axis = 0; axis < 3; ++axis)
                turns += static_cast<long double>(number[axis][w]) * x[axis][place];
            all += sum < 3 ? velocity[i][w] * std::cos(two_pi * turns)
                           : -two_pi * velocity[i][w] * number[j][w] * std::sin(two_pi * turns);
        }
        return double(all);
    }
};

std::size_t other_sums(const Sea& one, const Sea& other)
{
    std::size_t others = 0;
    for (std::size_t sum = 0; sum < 12; ++sum)
        for (std::size_t place = 0; place < places; ++place)
            others += one.sums[sum][place] == other.sums[sum][place] ? 0 : 1;
    return others;
}

// A wave is right to 1e-10, and 36 of speeds up to 1 and numbers up to 2 come to no more than this.
TEST(WaveKernels, SumUpWavesAndTheirDerivatives)
{
    for (const KernelTable* table : runnable_kernels()) {
        Sea sea;
        sea.sum_up(table->waves);
        double worst = 0;
        for (std::size_t sum = 0; sum < 12; ++sum) {
            for (std::size_t place = 0; place < places; ++place)
                worst = std::max(worst, std::abs(sea.sums[sum][place] - sea.expected(sum, place)));
            EXPECT_EQ(sea.sums[sum][places], -1) << "written beyond the last place";
        }
        test::expect_at_most(std::string(table->name) + ", error of a sum", worst,
                             waves * 2 * std::numbers::pi * 2 * 1e-10);
    }
}

TEST(WaveKernels, GiveTheSameBitsOnEveryProcessor)
{
    Sea baseline;
    baseline.sum_up(runnable_kernels().front()->waves);
    for (const KernelTable* table : runnable_kernels()) {
        Sea sea;
        sea.sum_up(table->waves);
        test::expect_at_most(std::string(table->name) + ", other sums", double(other_sums(sea, baseline)), 0);
    }
}

TEST(WaveKernels, GiveTheSameBitsAtEachPlaceByItself)
{
    Sea baseline;
    baseline.sum_up(runnable_kernels().front()->waves);
    for (const KernelTable* table : runnable_kernels()) {
        Sea sea;
        for (std::size_t place = 0; place < places; ++place)
            sea.sum_up_at(table->waves, place);
        test::expect_at_most(std::string(table->name) + ", other sums", double(other_sums(sea, baseline)), 0);
    }
}

} // namespace
} // namespace slod::simd
