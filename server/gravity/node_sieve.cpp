#include "gravity/node_sieve.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace slod {
namespace {

/// In a system's units.
template <class Real>
simd::OpeningTerms<Real> scaled(const simd::OpeningTerms<double>& terms, const ScaledUnits& units)
{
    const double length = units.per_length, square = length * length;
    // What everything keeps stays a number, and what nothing does none.
    const auto bound = [&](double error) {
        const double value = error * units.per_mass / square;
        return Real(value > 1e30 ? 1e30 : value);
    };
    simd::OpeningTerms<Real> result{};
    for (int axis = 0; axis < 3; ++axis) {
        result.lower[axis] = Real(terms.lower[axis] * length);
        result.upper[axis] = Real(terms.upper[axis] * length);
    }
    result.reach = Real(terms.reach * length);
    result.q = Real(terms.q * square);
    result.q_spread = Real(terms.q_spread * square);
    result.guard = Real(terms.guard);
    result.far_guard = Real(terms.far_guard);
    result.most_blur = Real(terms.most_blur);
    result.error = bound(terms.error);
    result.point_error = bound(terms.point_error);
    result.extended_error = bound(terms.extended_error);
    result.far_error = bound(terms.far_error);
    return result;
}

} // namespace

template <class Real>
void NodeSieve<Real>::begin(std::span<const std::uint32_t> sources, const ForceView::Node& targets,
                            const simd::OpeningTerms<double>& terms)
{
    sources_ = sources;
    targets_ = &targets;
    terms_ = scaled<Real>(terms, units_);
    pending_count_ = 0;
}

/// Of what is pending, and when that is little of the sources. Near the end of the room a node at a time,
/// which needs the least.
template <class Real>
std::size_t NodeSieve<Real>::take_batch()
{
    if (pending_count_ == 0) {
        const std::size_t count = std::min(sources_.size(), most_nodes);
        std::copy_n(sources_.begin(), count, batch_.begin());
        sources_ = sources_.subspan(count);
        return count;
    }
    const std::size_t used = pending_count_ + kept_for_single;
    const std::size_t room = used < most_pending ? (most_pending - used) / 7 : 0;
    const std::size_t count = std::min({pending_count_, most_nodes, std::max<std::size_t>(room, 1)});
    pending_count_ -= count;
    std::copy_n(pending_.begin() + std::ptrdiff_t(pending_count_), count, batch_.begin());
    return count;
}

template <class Real>
bool NodeSieve<Real>::next()
{
    const std::size_t count = take_batch();
    for (std::size_t i = 0; i < count; ++i) {
        const ForceView::Node& node = view_.nodes[batch_[i]];
        bodies_.put(i, node.centre - targets_->centre, node.mass, node.q, units_);
        radius_[i] = Real(double(node.radius) * units_.per_length);
        blur_[i] = Real(double(node.blur) * units_.per_length);
    }
    const std::size_t padded = (count + simd::tile_width - 1) / simd::tile_width * simd::tile_width;
    kernels_.find_roles(terms_,
                        {padded, bodies_.x.data(), bodies_.y.data(), bodies_.z.data(), bodies_.mass.data(),
                         bodies_.q.data(), radius_.data(), blur_.data()},
                        roles_.data());
    counts_.fill(0);
    for (std::size_t i = 0; i < count; ++i) {
        const ForceView::Node& node = view_.nodes[batch_[i]];
        const unsigned role = holds(node, *targets_) ? 0U : roles_[i];
        const bool without_parts = node.next == batch_[i] + 1;
        const std::size_t outcome = role + unsigned(role == inner && without_parts) * unsigned(leaf);
        lists_[outcome][counts_[outcome]++] = batch_[i];
    }
    tested_ += count;
    return count > 0;
}

template <class Real>
void NodeSieve<Real>::open(std::uint32_t node)
{
    const std::uint32_t end = view_.nodes[node].next;
    for (std::uint32_t part = node + 1; part < end; part = view_.nodes[part].next) {
        SLOD_ASSERT(pending_count_ < most_pending);
        pending_[pending_count_++] = part;
    }
}

template class NodeSieve<float>;
template class NodeSieve<double>;

} // namespace slod
