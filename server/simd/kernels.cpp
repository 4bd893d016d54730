#include "simd/kernels.hpp"

#include <algorithm>
#include <array>

namespace slod::simd {

namespace baseline {
extern const KernelTable table;
}
namespace v3 {
extern const KernelTable table;
}
namespace v4 {
extern const KernelTable table;
}

namespace {

/// Slowest first; a processor that can run one can run all before it.
constexpr std::array all_kernels = {&baseline::table, &v3::table, &v4::table};

/// By what the kernels are built for (cmake/layers.cmake), which is of the levels v3 and v4 of the x86-64
/// psABI.
std::size_t count_runnable()
{
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
    return v4 ? 3 : v3 ? 2 : 1;
}

} // namespace

std::span<const KernelTable* const> runnable_kernels()
{
    static const std::size_t runnable = count_runnable();
    return std::span(all_kernels).first(runnable);
}

const KernelTable& kernels()
{
    return *runnable_kernels().back();
}

const KernelTable* kernels(std::string_view isa)
{
    if (isa.empty() || isa == "auto")
        return &kernels();
    const auto runnable = runnable_kernels();
    const auto found = std::ranges::find(runnable, isa, [](const KernelTable* table) { return table->name; });
    return found == runnable.end() ? nullptr : *found;
}

} // namespace slod::simd
