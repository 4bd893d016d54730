#include "gravity/branch_walk.hpp"

#include "core/assert.hpp"

namespace slod {
namespace {

/// Whether the node holds the targets; else it holds none of them, or is one of their parts.
bool holds(const ForceView::Node& node, const ForceView::Node& targets)
{
    return targets.first - node.first < node.count; // below 0 wraps beyond any count
}

} // namespace

template <class Real>
BranchWalk<Real>::BranchWalk(const ForceTerms<Real>& terms, std::uint32_t region, ClusterTable& clusters,
                             std::size_t room)
    : terms_(terms), view_(terms.view), region_(region), clusters_(clusters),
      far_(terms.kernels, terms.units), room_(room)
{
    static_assert(most_in_group <= BlockSum<Real>::most_targets);
    SLOD_ASSERT(view_.regions.size() <= most_roots && room <= most_listed - most_roots);
}

template <class Real>
ForceCounts BranchWalk<Real>::run(std::uint32_t branch)
{
    counts_ = {};
    listed_ = 0;
    const bool relative = terms_.gravity.opening == OpeningCriterion::Relative;
    gross_pull_ = relative ? gross_pull(view_, view_.nodes[branch], region_) : 0;
    const Sources answered = roots(true), unanswered = roots(false);
    end_ = listed_ + room_;
    descend(branch, {answered, unanswered});
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
    const bool expanding = terms_.gravity.multipoles == Multipoles::Quadrupole && allowance.relative;
    if (!expanding || above.nodes.empty() || targets.radius == 0)
        return above;
    const std::size_t first = listed_;
    far_.begin(targets);
    for (const std::uint32_t source : above.nodes) {
        if (!sift(source, targets, allowance)) {
            listed_ = first;
            return above;
        }
    }
    return {.nodes = std::span(lists_).subspan(first, listed_ - first),
            .far = moved_here(above, targets),
            .point = targets.centre};
}

/// False if there is no room in the lists.
template <class Real>
bool BranchWalk<Real>::sift(std::uint32_t source, const ForceView::Node& targets, const Allowance& allowance)
{
    const std::uint32_t end = view_.nodes[source].next;
    for (std::uint32_t index = source; index < end;) {
        const ForceView::Node& node = view_.nodes[index];
        const bool holds_targets = holds(node, targets);
        ++counts_.nodes_tested;
        if (!holds_targets && is_far(node, targets, allowance)) {
            far_.add(node, view_.second_moments[index]);
            ++counts_.far_nodes;
            index = node.next;
            continue;
        }
        const bool larger = holds_targets ? node.count > targets.count : node.radius > targets.radius;
        if (larger && node.next > index + 1) {
            ++index;
            continue;
        }
        if (listed_ == end_)
            return false;
        lists_[listed_++] = index;
        index = node.next;
    }
    return true;
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
    const Opening opening(
        view_, targets, terms_.gravity,
        allowance_for(view_, targets, terms_.gravity, constant, clusters_.pull, gross_pull_));
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
void BranchWalk<Real>::add(const Sources& sources, const ForceView::Node& targets, const Opening& opening,
                           BlockSum<Real>& sum)
{
    far_.begin(targets);
    for (const std::uint32_t source : sources.nodes)
        walk(source, targets, opening, sum);
    if (const Expansion far = moved_here(sources, targets); far.reach > 0)
        sum.add_expansion(far, targets.centre);
}

/// Depth first, without a stack, as an index that goes on or jumps.
template <class Real>
void BranchWalk<Real>::walk(std::uint32_t source, const ForceView::Node& targets, const Opening& opening,
                            BlockSum<Real>& sum)
{
    const std::uint32_t end = view_.nodes[source].next;
    for (std::uint32_t index = source; index < end;) {
        const ForceView::Node& node = view_.nodes[index];
        NodeRole role = NodeRole::Opened;
        if (!holds(node, targets)) {
            ++counts_.nodes_tested;
            role = opening.role_of(node);
        }
        if (role == NodeRole::Opened) {
            const bool leaf = node.next == index + 1;
            const bool own = node.first == targets.first && node.count == targets.count;
            if (leaf || own)
                sum.add_bodies(node.first, node.first + node.count);
            index = leaf || own ? node.next : index + 1;
            continue;
        }
        if (role == NodeRole::Far) {
            far_.add(node, view_.second_moments[index]);
            ++counts_.far_nodes;
        } else if (role == NodeRole::Extended) {
            sum.add_node(node, view_.second_moments[index]);
        } else {
            sum.add_point(node.centre, node.mass, node.q);
        }
        index = node.next;
    }
}

template class BranchWalk<float>;
template class BranchWalk<double>;

} // namespace slod
