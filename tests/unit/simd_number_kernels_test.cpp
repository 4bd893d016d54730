#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/portable_math.hpp"
#include "core/random.hpp"
#include "simd/kernels.hpp"
#include "support/case_rows.hpp"

// Kernels for many numbers give the bits that the functions for one give, on every processor.
namespace slod::simd {
namespace {

TEST(NumberKernels, N17_DrawTheNumbersOfEachItemsOwnGenerator)
{
    constexpr std::uint64_t seed = 0x1111'2222'3333'4444, first = 0xffff'fff0; // the lower half overflows
    constexpr std::uint32_t stream = 7, pairs = 3;
    for (const KernelTable* table : runnable_kernels())
        for (const std::size_t count : {0U, 1U, 7U, 16U, 129U}) {
            std::vector<std::vector<double>> numbers(2 * pairs, std::vector<double>(count + 1, -1));
            const RandomItems items{{std::uint32_t(seed), std::uint32_t(seed >> 32)}, stream, first, count};
            for (std::uint32_t pair = 0; pair < pairs; ++pair)
                table->numbers.fill_uniforms(items, pair, numbers[2 * pair].data(),
                                             numbers[2 * pair + 1].data());
            std::size_t others = 0;
            for (std::size_t i = 0; i < count; ++i) {
                Random random(seed, stream, first + i);
                for (const std::vector<double>& number : numbers)
                    others += number[i] == random.uniform() ? 0 : 1;
            }
            test::expect_at_most(std::string(table->name) + ", other numbers", double(others), 0);
            for (const std::vector<double>& number : numbers)
                EXPECT_EQ(number[count], -1) << "written beyond the last item";
        }
}

TEST(NumberKernels, N17_TurnAsPortableSincosDoes)
{
    std::vector<double> angles{0, -0.0, 1e5, -1e5, std::numeric_limits<double>::denorm_min()};
    Random random(1, 0, 0);
    for (int quarter = -9; quarter <= 9; ++quarter)
        for (int draw = 0; draw < 100; ++draw)
            angles.push_back(1.5707963267948966 * (quarter + random.uniform()));
    for (const KernelTable* table : runnable_kernels()) {
        std::vector<double> sines(angles.size()), cosines(angles.size());
        table->numbers.sines_and_cosines(angles.data(), angles.size(), sines.data(), cosines.data());
        std::size_t others = 0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const SineCosine turn = portable_sincos(angles[i]);
            const bool same = sines[i] == turn.sine && cosines[i] == turn.cosine &&
                              std::signbit(sines[i]) == std::signbit(turn.sine);
            others += same ? 0 : 1;
        }
        test::expect_at_most(std::string(table->name) + ", other bits", double(others), 0);
    }
}

} // namespace
} // namespace slod::simd
