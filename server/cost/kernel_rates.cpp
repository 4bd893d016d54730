#include "cost/kernel_rates.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/aligned.hpp"
#include "core/parallel.hpp"
#include "cost/bare_pairs.hpp"
#include "simd/kernels.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t target_count = 64, source_count = 512;
constexpr int rounds = 5;
constexpr double round_ms = 20;

/// Targets and sources of one task; what they are does not matter, but no pair is degenerate.
struct Arrays {
    std::array<AlignedVector<float>, 4> at;   // x, y, z, q of the targets
    std::array<AlignedVector<float>, 5> from; // x, y, z, mass, q of the sources
    std::array<AlignedVector<float>, 3> sums;

    Arrays()
    {
        const auto fill = [](auto& arrays, std::size_t count, float step) {
            float value = step;
            for (auto& array : arrays)
                for (std::size_t i = 0; i < count; ++i, value += step)
                    array.push_back(value);
        };
        fill(at, target_count, 0.001F);
        fill(from, source_count, -0.0007F);
        for (float& q : from[4])
            q = 1;
        for (auto& sum : sums)
            sum.assign(target_count, 0);
    }

    void run()
    {
        simd::kernels().in_float.add_acceleration(
            {target_count, at[0].data(), at[1].data(), at[2].data(), at[3].data(), sums[0].data(),
             sums[1].data(), sums[2].data(), nullptr, nullptr, nullptr, nullptr, nullptr, nullptr},
            {source_count, from[0].data(), from[1].data(), from[2].data(), from[3].data(), from[4].data()},
            simd::no_self);
    }
};

/// What one task did, and from when to when.
struct Spell {
    double begin_ms = 0, end_ms = 0, pairs = 0;
};

/// Pairs per second of all tasks together, from the first one's begin to the last one's end; `pairs_of`
/// evaluates some and returns how many.
template <class Work>
double rate_of(int threads, const Clock& clock, const Work& pairs_of)
{
    double best = 0;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Spell> spells(static_cast<std::size_t>(threads));
        for_each_task(spells.size(), [&](std::size_t task) {
            Spell spell{clock(), 0, 0};
            do {
                spell.pairs += double(pairs_of(task));
                spell.end_ms = clock();
            } while (spell.end_ms - spell.begin_ms < round_ms);
            spells[task] = spell;
        });
        double begin = spells.front().begin_ms, end = spells.front().end_ms, pairs = 0;
        for (const Spell& spell : spells) {
            begin = std::min(begin, spell.begin_ms);
            end = std::max(end, spell.end_ms);
            pairs += spell.pairs;
        }
        best = std::max(best, 1e3 * pairs / (end - begin));
    }
    return best;
}

} // namespace

KernelRates measure_kernel_rates(int threads, const Clock& clock)
{
    std::vector<Arrays> arrays(static_cast<std::size_t>(threads));
    const double kernel = rate_of(threads, clock, [&](std::size_t task) {
        arrays[task].run();
        return target_count * source_count;
    });
    const double bare = rate_of(threads, clock, [](std::size_t) {
        constexpr std::size_t sources = 2048;
        volatile float kept = sum_of_bare_pairs(sources);
        static_cast<void>(kept);
        return bare_targets * sources;
    });
    return {kernel, bare};
}

} // namespace slod::cost
