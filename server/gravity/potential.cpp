#include "gravity/potential.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/parallel.hpp"
#include "gravity/block_sum.hpp"

namespace slod {
namespace {

constexpr std::size_t target_block = 128; ///< a multiple of the kernels' tile
constexpr std::size_t source_block = 512;

} // namespace

double potential_energy(const ForceView& view, const simd::KernelTable& table, double gravitational_constant)
{
    const std::size_t count = view.body_count();
    std::vector<double> energies(block_count(count, target_block));
    for_each_block(count, target_block, [&](std::size_t first, std::size_t last) {
        const Vector3d origin = middle_of_block(view, first, last);
        KernelBodies<double, target_block> targets;
        KernelBodies<double, source_block> sources;
        targets.load(0, view, first, last, origin, {});
        targets.pad(last - first, target_block);
        alignas(64) std::array<double, target_block> potential{};
        for (std::size_t source = 0; source < count; source += source_block) {
            const std::size_t end = std::min(count, source + source_block);
            sources.load(0, view, source, end, origin, {});
            table.in_double.add_potential({target_block, targets.x.data(), targets.y.data(), targets.z.data(),
                                           targets.q.data(), potential.data()},
                                          {end - source, sources.x.data(), sources.y.data(), sources.z.data(),
                                           sources.mass.data(), sources.q.data()},
                                          std::ptrdiff_t(first) - std::ptrdiff_t(source));
        }
        for (std::size_t body = first; body < last; ++body)
            energies[first / target_block] += view.mass[body] * potential[body - first];
    });
    return 0.5 * gravitational_constant * std::accumulate(energies.begin(), energies.end(), 0.0);
}

} // namespace slod
