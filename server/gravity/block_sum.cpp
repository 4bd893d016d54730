#include "gravity/block_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/assert.hpp"
#include "core/powers.hpp"

namespace slod {
ScaledUnits units_of(const ForceView& view)
{
    double extent = 0;
    for (const AlignedVector<double>* column : {&view.x, &view.y, &view.z}) {
        const auto [lowest, highest] = std::minmax_element(column->begin(), column->end());
        extent = std::max(extent, *highest - *lowest);
    }
    const double coarsest = std::max(extent, std::sqrt(*std::max_element(view.q.begin(), view.q.end())));
    double least_q = std::numeric_limits<double>::infinity();
    for (const double q : view.q)
        least_q = q > 0 ? std::min(least_q, q) : least_q;
    // In between, so that neither 1 / r^3 of the nearest nor r^2 of the farthest overflows a float.
    const double finest = std::clamp(std::sqrt(least_q), 1e-24 * coarsest, coarsest);
    return {power_of_two_above(std::sqrt(coarsest * finest)),
            power_of_two_above(std::accumulate(view.mass.begin(), view.mass.end(), 0.0))};
}

Vector3d middle_of_block(const ForceView& view, std::size_t first, std::size_t last)
{
    constexpr std::size_t most_samples = 15;
    const std::size_t count = std::min(last - first, most_samples);
    const auto median = [&](const AlignedVector<double>& column) {
        std::array<double, most_samples> samples{};
        for (std::size_t i = 0; i < count; ++i)
            samples[i] = column[first + i * (last - first) / count];
        const auto middle = samples.begin() + std::ptrdiff_t(count / 2);
        std::nth_element(samples.begin(), middle, samples.begin() + std::ptrdiff_t(count));
        return *middle;
    };
    return {median(view.x), median(view.y), median(view.z)};
}

template <class Real>
BlockSum<Real>::BlockSum(const ForceView& view, const simd::GravityKernels<Real>& kernels,
                         const ScaledUnits& units, std::size_t first, std::size_t last, bool tide)
    : view_(view), kernels_(kernels), units_(units), first_(first), last_(last),
      padded_count_((last - first + simd::tile_width - 1) / simd::tile_width * simd::tile_width), tide_(tide),
      origin_(middle_of_block(view, first, last))
{
    static_assert(most_targets % simd::tile_width == 0);
    SLOD_ASSERT(first < last && last - first <= most_targets);
    targets_.load(0, view, first, last, origin_, units);
    targets_.pad(last - first, padded_count_);
    for (std::size_t sum = 0; sum < used_sums(); ++sum)
        std::fill_n(total_[sum].begin(), padded_count_, 0.0);
}

template <class Real>
void BlockSum<Real>::add_point(const Vector3d& position, double mass, double q)
{
    if (source_count_ == most_sources)
        flush_points();
    sources_.put(source_count_++, position - origin_, mass, q, units_);
}

template <class Real>
void BlockSum<Real>::add_bodies(std::size_t first, std::size_t last)
{
    const bool own = first <= first_ && last_ <= last;
    while (first < last) {
        if (source_count_ == most_sources)
            flush_points();
        // Where the first target is, or would be in another chunk; it names no source that is no target, as
        // the targets are one run in the sources.
        if (own && first < last_)
            self_ = std::ptrdiff_t(source_count_ + first_) - std::ptrdiff_t(first);
        const std::size_t end = std::min(last, first + most_sources - source_count_);
        sources_.load(source_count_, view_, first, end, origin_, units_);
        source_count_ += end - first;
        first = end;
    }
    if (own)
        interactions_ -= last_ - first_;
}

template <class Real>
void BlockSum<Real>::add_node(const ForceView::Node& node, const Symmetric3& second_moments)
{
    if (node_count_ == most_nodes)
        flush_nodes();
    nodes_.put(node_count_, node.centre - origin_, node.mass, node.q, units_);
    nodes_.put_moments(node_count_++, second_moments, units_);
}

template <class Real>
void BlockSum<Real>::add_expansion(const Expansion& expansion, const Vector3d& point)
{
    const Expansion here = moved(expansion, (origin_ - point) * units_.per_length, expansion.reach);
    simd::FarExpansion<Real> terms{};
    terms.reach = Real(here.reach);
    const auto round = [](const auto& from, auto& to) { std::copy(std::begin(from), std::end(from), to); };
    round(here.pull, terms.pull);
    round(here.tide, terms.tide);
    round(here.third, terms.third);
    round(here.fourth, terms.fourth);
    kernels_.add_expansion(cleared_sums(), terms);
    take_sums(0);
}

template <class Real>
simd::GravityTargets<Real> BlockSum<Real>::cleared_sums()
{
    for (std::size_t sum = 0; sum < used_sums(); ++sum)
        std::fill_n(partial_[sum].begin(), padded_count_, Real(0));
    const auto unless_absent = [this](auto& column) { return tide_ ? column.data() : nullptr; };
    return {padded_count_,
            targets_.x.data(),
            targets_.y.data(),
            targets_.z.data(),
            targets_.q.data(),
            partial_[0].data(),
            partial_[1].data(),
            partial_[2].data(),
            unless_absent(partial_[3]),
            unless_absent(partial_[4]),
            unless_absent(partial_[5]),
            unless_absent(partial_[6]),
            unless_absent(partial_[7]),
            unless_absent(partial_[8])};
}

template <class Real>
void BlockSum<Real>::take_sums(std::size_t source_count)
{
    for (std::size_t sum = 0; sum < used_sums(); ++sum)
        for (std::size_t target = 0; target < padded_count_; ++target)
            total_[sum][target] += double(partial_[sum][target]);
    interactions_ += std::uint64_t(source_count) * (last_ - first_);
}

template <class Real>
void BlockSum<Real>::flush_points()
{
    if (source_count_ == 0)
        return;
    const auto kernel = tide_ ? kernels_.add_acceleration_and_tide : kernels_.add_acceleration;
    kernel(cleared_sums(), sources_.list(source_count_), self_);
    take_sums(source_count_);
    source_count_ = 0;
    self_ = simd::no_self;
}

template <class Real>
void BlockSum<Real>::flush_nodes()
{
    if (node_count_ == 0)
        return;
    const auto kernel = tide_ ? kernels_.add_nodes_acceleration_and_tide : kernels_.add_nodes_acceleration;
    kernel(cleared_sums(), nodes_.list(node_count_));
    take_sums(node_count_);
    node_count_ = 0;
}

template <class Real>
void BlockSum<Real>::flush()
{
    flush_points();
    flush_nodes();
}

template <class Real>
Vector3d BlockSum<Real>::force()
{
    flush();
    Vector3d sum_of_all{0, 0, 0};
    for (std::size_t body = first_; body < last_; ++body)
        sum_of_all += view_.mass[body] * sum(body - first_);
    return units_.mass / (units_.length * units_.length) * sum_of_all;
}

template <class Real>
void BlockSum<Real>::store(double gravitational_constant, ClusterTable& clusters)
{
    flush();
    const double strength = gravitational_constant * units_.mass / (units_.length * units_.length);
    const double gradient = strength / units_.length;
    for (std::size_t body = first_; body < last_; ++body) {
        const std::size_t slot = view_.slot[body].index;
        const std::size_t i = body - first_;
        clusters.acceleration[slot] = strength * sum(i);
        clusters.pull[slot] = clusters.acceleration[slot].norm();
        if (tide_)
            clusters.tide[slot] = {gradient * total_[3][i], gradient * total_[4][i], gradient * total_[5][i],
                                   gradient * total_[6][i], gradient * total_[7][i], gradient * total_[8][i]};
    }
}

template class BlockSum<float>;
template class BlockSum<double>;

} // namespace slod
