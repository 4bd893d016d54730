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

std::size_t count_runnable()
{
    if (!__builtin_cpu_supports("x86-64-v3"))
        return 1;
    return __builtin_cpu_supports("x86-64-v4") ? 3 : 2;
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
