#include "effects/field_forces.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/parallel.hpp"
#include "effects/straddling.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 512;

/// The vector w of the antisymmetric part of a matrix: that part takes d to w x d.
Vector3d turning(const Matrix3d& m)
{
    return 0.5 * Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

Symmetric3 symmetric_part(const Matrix3d& m)
{
    return Symmetric3::of(0.5 * (m + m.transpose()));
}

} // namespace

FieldForces::FieldForces(const FieldSettings& settings, const FieldSource& source, bool gravity, Tick tick)
    : fields_(settings, source, std::move(tick)), gravity_(gravity)
{}

void FieldForces::reserve(std::size_t slots)
{
    values_.reserve(slots);
}

void FieldForces::evaluate(const ClusterStore& store, std::uint64_t frame, double time)
{
    const ClusterTable& clusters = store.clusters;
    const bool cut = fields_.has_boundary();
    values_.resize(clusters.slot_count());
    const auto alive = [&](std::size_t slot) { return clusters.alive(slot); };
    const auto place = [&](std::size_t slot) -> const Vector3d& { return clusters.position[slot]; };
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        std::fill(values_.begin() + std::ptrdiff_t(first), values_.begin() + std::ptrdiff_t(last),
                  FieldValue{});
        fields_.add(first, last, alive, place, time, values_.data());
        if (cut)
            count_straddling(fields_, store, frame, first, last);
    });
}

void FieldForces::add_to(ClusterTable& clusters) const
{
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            const FieldValue& field = values_[slot];
            if (!gravity_) {
                clusters.acceleration[slot].setZero();
                clusters.pull[slot] = field.value.norm();
                if (clusters.columns.tide)
                    clusters.tide[slot] = {};
            }
            clusters.acceleration[slot] += field.value;
            if (clusters.columns.tide)
                clusters.tide[slot] += symmetric_part(field.gradient);
            if (clusters.columns.turning)
                clusters.turning[slot] = turning(field.gradient);
        }
    });
}

double FieldForces::potential_energy(const ClusterStore& store, std::uint64_t frame) const
{
    constexpr std::size_t most_blocks = 64;
    const ClusterTable& clusters = store.clusters;
    const std::size_t slots = clusters.slot_count();
    const std::size_t part = std::max<std::size_t>(1024, block_count(slots, most_blocks));
    std::array<double, most_blocks> sums{};
    for_each_block(slots, part, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            const Symmetric3 extent =
                map_position_moments(clusters.moments[slot], clusters.blocks(slot, store.rule, frame));
            sums[first / part] +=
                fields_.energy(clusters.position[slot], clusters.mass(slot), extent.matrix());
        }
    });
    double total = 0;
    for (const double sum : sums)
        total += sum;
    return total;
}

} // namespace slod
