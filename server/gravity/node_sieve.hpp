#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gravity/force_view.hpp"
#include "gravity/kernel_bodies.hpp"
#include "simd/gravity_kernels.hpp"

namespace slod {

/// Goes from sources down to the nodes that act on some targets, depth first, a batch of nodes at a time:
/// their roles are found all at once, and they are listed by role without a branch, which no processor could
/// foretell.
///
///     for (sieve.begin(sources, targets, terms); sieve.next();) {
///         for (const std::uint32_t node : sieve.opened())
///             sieve.open(node); // or not
///         ...
///     }
template <class Real>
class NodeSieve {
public:
    NodeSieve(const ForceView& view, const simd::GravityKernels<Real>& kernels, const ScaledUnits& units)
        : view_(view), kernels_(kernels), units_(units)
    {}

    /// `terms` are in units of the scene. The sources' memory is the caller's until next() is false.
    void begin(std::span<const std::uint32_t> sources, const ForceView::Node& targets,
               const simd::OpeningTerms<double>& terms);

    /// Takes the next batch; false when there is none.
    bool next();

    // Nodes of the batch.
    std::span<const std::uint32_t> opened() const { return of(inner); } ///< that have parts
    std::span<const std::uint32_t> leaves() const { return of(leaf); }  ///< to be opened, but without parts
    std::span<const std::uint32_t> points() const { return of(point); }
    std::span<const std::uint32_t> extended() const { return of(extent); }
    std::span<const std::uint32_t> far() const { return of(distant); }

    /// Has a node's parts come in one of the next batches.
    void open(std::uint32_t node);

    std::uint64_t tested() const { return tested_; } ///< nodes, since the sieve was made

private:
    static constexpr std::size_t most_nodes = 64; ///< of a batch
    /// A node has at most eight parts. Where there is no room for those of a batch, nodes come one by one,
    /// and a level of the tree takes seven places at most: 21 levels of octants, and one place for each level
    /// of halves.
    static constexpr std::size_t most_pending = 8192, kept_for_single = 1024;
    static_assert(most_nodes % simd::tile_width == 0);

    /// NodeRole's numbers, and one more for what has no parts.
    enum Outcome : std::uint8_t { inner, point, extent, distant, leaf, outcomes };

    std::span<const std::uint32_t> of(Outcome outcome) const
    {
        return std::span(lists_[outcome]).first(counts_[outcome]);
    }
    std::size_t take_batch();

    const ForceView& view_;
    const simd::GravityKernels<Real>& kernels_;
    ScaledUnits units_;
    const ForceView::Node* targets_ = nullptr;
    simd::OpeningTerms<Real> terms_{};
    std::uint64_t tested_ = 0;
    std::span<const std::uint32_t> sources_; ///< still to come
    std::size_t pending_count_ = 0;
    std::array<std::uint32_t, most_pending> pending_; ///< opened nodes' parts, the last to come first
    std::array<std::uint32_t, most_nodes> batch_;
    KernelBodies<Real, most_nodes> bodies_{};
    alignas(64) std::array<Real, most_nodes> radius_{}, blur_{};
    std::array<std::uint8_t, most_nodes> roles_;
    std::array<std::array<std::uint32_t, most_nodes>, outcomes> lists_;
    std::array<std::size_t, outcomes> counts_{};
};

extern template class NodeSieve<float>;
extern template class NodeSieve<double>;

} // namespace slod
