#include "gravity/branch_walk.hpp"

#include <algorithm>
#include <cmath>

#include "core/assert.hpp"

namespace slod {
template <class Real>
BranchWalk<Real>::BranchWalk(const ForceTerms<Real>& terms, std::uint32_t region, ClusterTable& clusters,
                             std::size_t room)
    : terms_(terms), view_(terms.view), region_(region), clusters_(clusters),
      sieve_(view_, terms.kernels, terms.units), far_(terms.kernels, terms.units), room_(room)
{
    static_assert(most_in_group <= BlockSum<Real>::most_targets);
    SLOD_ASSERT(view_.regions.size() <= most_roots && room <= most_listed - most_roots);
}

template <class Real>
ForceCounts BranchWalk<Real>::run(std::uint32_t branch)
{
    counts_ = {};
    const std::uint64_t tested_before = sieve_.tested();
    listed_ = 0;
    const bool relative = terms_.gravity.opening == OpeningCriterion::Relative;
    gross_pull_ = relative ? gross_pull(view_, view_.nodes[branch], region_) : 0;
    const Sources answered = roots(true), unanswered = roots(false);
    end_ = listed_ + room_;
    descend(branch, {answered, unanswered});
    counts_.nodes_tested = sieve_.tested() - tested_before;
    return counts_;
}

/// The roots of all regions that act on this one.
template <class Real>
typename BranchWalk<Real>::Sources BranchWalk<Real>::roots(bool answered)
{
    const std::size_t first = listed_;
    for (std::size_t source = 0; source < view_.regions.size(); ++source) {
        if (!view_.acts(source, region_) || view_.acts(region_, source) != answered)
            continue;
        const ForceView::Region& region = view_.regions[source];
        lists_[listed_++] = region.first_node;
    }
    return {.nodes = std::span(lists_).subspan(first, listed_ - first)};
}

template <class Real>
void BranchWalk<Real>::descend(std::uint32_t targets, const AllSources& above)
{
    const ForceView::Node& node = view_.nodes[targets];
    if (node.count <= most_in_group) {
        finish(node, above);
        return;
    }
    const std::size_t listed = listed_;
    const Sources answered = settle(node, above.answered), unanswered = settle(node, above.unanswered);
    for (std::uint32_t child = targets + 1; child < node.next; child = view_.nodes[child].next)
        descend(child, {answered, unanswered});
    listed_ = listed;
}

template <class Real>
typename BranchWalk<Real>::Sources BranchWalk<Real>::settle(const ForceView::Node& targets,
                                                            const Sources& above)
{
    const Allowance allowance = allowance_for(view_, targets, terms_.gravity, terms_.gravitational_constant,
                                              clusters_.pull, gross_pull_);
    const auto far = far_terms(targets, terms_.gravity, allowance);
    if (std::isnan(far.far_guard) || above.nodes.empty())
        return above;
    const std::size_t first = listed_;
    far_.begin(targets);
    for (sieve_.begin(above.nodes, targets, far); sieve_.next();) {
        add_far();
        if (!leave(sieve_.leaves()) || !leave_smaller(sieve_.opened(), targets)) {
            listed_ = first;
            return above;
        }
    }
    return {.nodes = std::span(lists_).subspan(first, listed_ - first),
            .far = moved_here(above, targets),
            .point = targets.centre};
}

/// Lists the nodes for the targets' children; false if there is no room.
template <class Real>
bool BranchWalk<Real>::leave(std::span<const std::uint32_t> nodes)
{
    if (nodes.size() > end_ - listed_)
        return false;
    std::copy(nodes.begin(), nodes.end(), lists_.begin() + std::ptrdiff_t(listed_));
    listed_ += nodes.size();
    return true;
}

/// Opens those that are larger than the targets, and lists the others; false if there is no room.
template <class Real>
bool BranchWalk<Real>::leave_smaller(std::span<const std::uint32_t> nodes, const ForceView::Node& targets)
{
    for (const std::uint32_t index : nodes) {
        const ForceView::Node& node = view_.nodes[index];
        if (holds(node, targets) ? node.count > targets.count : node.radius > targets.radius)
            sieve_.open(index);
        else if (!leave({&index, 1}))
            return false;
    }
    return true;
}

template <class Real>
void BranchWalk<Real>::add_far()
{
    for (const std::uint32_t node : sieve_.far())
        far_.add(view_.nodes[node], view_.second_moments[node]);
    counts_.far_nodes += sieve_.far().size();
}

/// What is in `far_`, if anything, and the expansion from above, about the targets' centre.
template <class Real>
Expansion BranchWalk<Real>::moved_here(const Sources& above, const ForceView::Node& targets)
{
    const Vector3d offset = (targets.centre - above.point) * terms_.units.per_length;
    if (far_.empty())
        return above.far.reach > 0 ? moved(above.far, offset, above.far.reach) : Expansion{};
    const Expansion here = far_.sum();
    return above.far.reach > 0 ? here + moved(above.far, offset, here.reach) : here;
}

template <class Real>
void BranchWalk<Real>::finish(const ForceView::Node& targets, const AllSources& sources)
{
    const double constant = terms_.gravitational_constant;
    const Allowance allowance =
        allowance_for(view_, targets, terms_.gravity, constant, clusters_.pull, gross_pull_);
    const auto opening = opening_terms(view_, targets, terms_.gravity, allowance);
    BlockSum<Real> sum(view_, terms_.kernels, terms_.units, targets.first, targets.first + targets.count,
                       clusters_.columns.tide);
    add(sources.answered, targets, opening, sum);
    if (!sources.unanswered.nodes.empty() || sources.unanswered.far.reach > 0) {
        const Vector3d answered = sum.force();
        add(sources.unanswered, targets, opening, sum);
        counts_.unanswered += constant * (sum.force() - answered);
    }
    sum.store(constant, clusters_);
    counts_.interactions += sum.interactions();
    ++counts_.groups;
}

template <class Real>
void BranchWalk<Real>::add(const Sources& sources, const ForceView::Node& targets,
                           const simd::OpeningTerms<double>& opening, BlockSum<Real>& sum)
{
    far_.begin(targets);
    for (sieve_.begin(sources.nodes, targets, opening); sieve_.next();) {
        add_far();
        for (const std::uint32_t node : sieve_.extended())
            sum.add_node(view_.nodes[node], view_.second_moments[node]);
        for (const std::uint32_t node : sieve_.points())
            sum.add_point(view_.nodes[node].centre, view_.nodes[node].mass, view_.nodes[node].q);
        for (const std::uint32_t node : sieve_.leaves())
            sum.add_bodies(view_.nodes[node].first, view_.nodes[node].first + view_.nodes[node].count);
        for (const std::uint32_t node : sieve_.opened()) {
            if (&view_.nodes[node] == &targets)
                sum.add_bodies(targets.first, targets.first + targets.count);
            else
                sieve_.open(node);
        }
    }
    if (const Expansion far = moved_here(sources, targets); far.reach > 0)
        sum.add_expansion(far, targets.centre);
}

template class BranchWalk<float>;
template class BranchWalk<double>;

} // namespace slod
