#include "cost/bare_pairs.hpp"

#include <string_view>

#include "simd/kernels.hpp"

namespace slod::cost {
namespace {

/// Sixteen numbers: one register, or as many as the processor needs.
typedef float Lanes __attribute__((vector_size(64)));
constexpr std::size_t lane_count = sizeof(Lanes) / sizeof(float);
constexpr std::size_t run_count = bare_targets / lane_count;

/// Built into each function below for that one's processor.
[[gnu::always_inline]] inline float sum_of_pairs(std::size_t sources)
{
    Lanes x[run_count], ax[run_count] = {}, ay[run_count] = {}, az[run_count] = {};
    for (std::size_t target = 0; target < bare_targets; ++target)
        x[target / lane_count][target % lane_count] = 0.1F * float(target);
    float source = 2;
    for (std::size_t s = 0; s < sources; ++s, source += 0.001F) {
        for (std::size_t run = 0; run < run_count; ++run) {
            const Lanes dx = source - x[run];
            const Lanes dy = dx + 0.5F, dz = dx - 0.5F;
            const Lanes square = dx * dx + dy * dy + dz * dz + 0.01F;
            const Lanes inverse = 1 / square;
            Lanes root;
            for (std::size_t lane = 0; lane < lane_count; ++lane)
                root[lane] = __builtin_sqrtf(inverse[lane]);
            const Lanes pull = inverse * root;
            ax[run] += pull * dx;
            ay[run] += pull * dy;
            az[run] += pull * dz;
        }
    }
    float sum = 0;
    for (std::size_t run = 0; run < run_count; ++run)
        for (std::size_t lane = 0; lane < lane_count; ++lane)
            sum += ax[run][lane] + ay[run][lane] + az[run][lane];
    return sum;
}

[[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] float sum_on_v4(std::size_t sources)
{
    return sum_of_pairs(sources);
}

[[gnu::target("arch=x86-64-v3")]] float sum_on_v3(std::size_t sources)
{
    return sum_of_pairs(sources);
}

float sum_on_baseline(std::size_t sources)
{
    return sum_of_pairs(sources);
}

} // namespace

float sum_of_bare_pairs(std::size_t sources)
{
    const std::string_view isa = simd::kernels().name;
    const auto sum = isa == "v4" ? sum_on_v4 : isa == "v3" ? sum_on_v3 : sum_on_baseline;
    return sum(sources);
}

} // namespace slod::cost
