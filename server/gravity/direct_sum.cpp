#include "gravity/direct_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t target_block = 128; ///< a multiple of the kernels' tile
constexpr std::size_t source_block = 512;
static_assert(target_block % simd::tile_width == 0);

/// Powers of two amid the system's lengths and near its mass: scaling by them is exact.
struct ScaledUnits {
    double length = 1, mass = 1;
};

double power_of_two_above(double value)
{
    return value > 0 && std::isfinite(value) ? std::ldexp(1.0, std::ilogb(value) + 1) : 1.0;
}

ScaledUnits units_of(const ForceView& view)
{
    double extent = 0;
    for (const AlignedVector<double>* column : {&view.x, &view.y, &view.z}) {
        const auto [lowest, highest] = std::minmax_element(column->begin(), column->end());
        extent = std::max(extent, *highest - *lowest);
    }
    const double coarsest = std::max(extent, std::sqrt(*std::max_element(view.q.begin(), view.q.end())));
    double finest = coarsest;
    for (const double q : view.q)
        finest = q > 0 ? std::min(finest, std::sqrt(q)) : finest;
    // In between, so that neither 1 / r^3 of the nearest nor r^2 of the farthest overflows a float.
    return {power_of_two_above(std::sqrt(coarsest * std::max(finest, 1e-24 * coarsest))),
            power_of_two_above(std::accumulate(view.mass.begin(), view.mass.end(), 0.0))};
}

/// A block of bodies as a kernel takes them.
template <class Real, std::size_t capacity>
struct alignas(64) Bodies {
    std::array<Real, capacity> x, y, z, mass, q;

    void load(const ForceView& view, std::size_t first, std::size_t last, const Vector3d& origin,
              const ScaledUnits& units)
    {
        const double per_length = 1 / units.length;
        const double per_mass = 1 / units.mass;
        for (std::size_t body = first; body < last; ++body) {
            x[body - first] = Real((view.x[body] - origin.x()) * per_length);
            y[body - first] = Real((view.y[body] - origin.y()) * per_length);
            z[body - first] = Real((view.z[body] - origin.z()) * per_length);
            mass[body - first] = Real(view.mass[body] * per_mass);
            q[body - first] = Real(view.q[body] * per_length * per_length);
        }
    }

    void pad(std::size_t from)
    {
        for (auto* column : {&x, &y, &z, &mass, &q})
            std::fill(column->begin() + std::ptrdiff_t(from), column->end(), Real(0));
    }
};

constexpr std::size_t sum_count = 9; ///< three of acceleration, six of tide

/// The kernel's sums over one block of sources, and all blocks' in double.
template <class Real>
struct alignas(64) Sums {
    std::array<std::array<Real, target_block>, sum_count> partial;
    std::array<std::array<double, target_block>, sum_count> total{};

    void start() { partial = {}; }
    void add(std::size_t used)
    {
        for (std::size_t sum = 0; sum < used; ++sum)
            for (std::size_t target = 0; target < target_block; ++target)
                total[sum][target] += double(partial[sum][target]);
    }
};

/// The median of each coordinate: an outlier in the block must not draw the origin away from the others.
Vector3d middle_of_block(const ForceView& view, std::size_t first, std::size_t last)
{
    const auto median = [&](const AlignedVector<double>& column) {
        std::array<double, target_block> values;
        const auto end = std::copy(column.begin() + std::ptrdiff_t(first),
                                   column.begin() + std::ptrdiff_t(last), values.begin());
        const auto middle = values.begin() + (last - first) / 2;
        std::nth_element(values.begin(), middle, end);
        return *middle;
    };
    return {median(view.x), median(view.y), median(view.z)};
}

template <class Real>
void sum_block(const ForceView& view, const simd::GravityKernels<Real>& kernels, const ScaledUnits& units,
               double gravitational_constant, std::size_t first, std::size_t last, ClusterTable& clusters)
{
    const bool tide = clusters.columns.tide;
    const Vector3d origin = middle_of_block(view, first, last);
    Bodies<Real, target_block> targets;
    Bodies<Real, source_block> sources;
    Sums<Real> sums;
    targets.load(view, first, last, origin, units);
    targets.pad(last - first);
    auto& out = sums.partial;
    const auto unless_absent = [tide](auto& column) { return tide ? column.data() : nullptr; };
    const simd::GravityTargets<Real> asked{
        target_block,          targets.x.data(),      targets.y.data(),      targets.z.data(),
        targets.q.data(),      out[0].data(),         out[1].data(),         out[2].data(),
        unless_absent(out[3]), unless_absent(out[4]), unless_absent(out[5]), unless_absent(out[6]),
        unless_absent(out[7]), unless_absent(out[8])};
    const auto kernel = tide ? kernels.add_acceleration_and_tide : kernels.add_acceleration;
    for (std::size_t source = 0; source < view.body_count(); source += source_block) {
        const std::size_t end = std::min(view.body_count(), source + source_block);
        sources.load(view, source, end, origin, units);
        sums.start();
        const bool overlap = source < last && first < end;
        kernel(asked,
               {end - source, sources.x.data(), sources.y.data(), sources.z.data(), sources.mass.data(),
                sources.q.data()},
               overlap ? std::ptrdiff_t(first) - std::ptrdiff_t(source) : simd::no_self);
        sums.add(tide ? sum_count : 3);
    }
    const double pull = gravitational_constant * units.mass / (units.length * units.length);
    const double gradient = pull / units.length;
    for (std::size_t body = first; body < last; ++body) {
        const std::size_t slot = view.slot[body].index;
        const std::size_t i = body - first;
        const auto& sum = sums.total;
        clusters.acceleration[slot] = pull * Vector3d(sum[0][i], sum[1][i], sum[2][i]);
        if (tide)
            clusters.tide[slot] = {gradient * sum[3][i], gradient * sum[4][i], gradient * sum[5][i],
                                   gradient * sum[6][i], gradient * sum[7][i], gradient * sum[8][i]};
    }
}

template <class Real>
void sum_all(const ForceView& view, const simd::KernelTable& table, double gravitational_constant,
             ClusterTable& clusters)
{
    const ScaledUnits units = units_of(view);
    for_each_block(view.body_count(), target_block, [&](std::size_t first, std::size_t last) {
        sum_block<Real>(view, simd::gravity_kernels<Real>(table), units, gravitational_constant, first, last,
                        clusters);
    });
}

} // namespace

void sum_directly(const ForceView& view, const simd::KernelTable& kernels, Precision precision,
                  double gravitational_constant, ClusterTable& clusters)
{
    if (view.body_count() == 0)
        return;
    if (precision == Precision::Double)
        sum_all<double>(view, kernels, gravitational_constant, clusters);
    else
        sum_all<float>(view, kernels, gravitational_constant, clusters);
}

double potential_energy(const ForceView& view, const simd::KernelTable& table, double gravitational_constant)
{
    const std::size_t count = view.body_count();
    std::vector<double> energies(block_count(count, target_block));
    for_each_block(count, target_block, [&](std::size_t first, std::size_t last) {
        const Vector3d origin = middle_of_block(view, first, last);
        Bodies<double, target_block> targets;
        Bodies<double, source_block> sources;
        targets.load(view, first, last, origin, {});
        targets.pad(last - first);
        alignas(64) std::array<double, target_block> potential{};
        for (std::size_t source = 0; source < count; source += source_block) {
            const std::size_t end = std::min(count, source + source_block);
            sources.load(view, source, end, origin, {});
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
