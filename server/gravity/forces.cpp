#include "gravity/forces.hpp"

#include <algorithm>
#include <optional>

#include "core/assert.hpp"
#include "core/make_room.hpp"
#include "core/parallel.hpp"
#include "gravity/block_sum.hpp"
#include "gravity/opening.hpp"

namespace slod {
namespace {

constexpr std::size_t direct_block = 128; ///< targets of a direct sum
/// Targets that walk together, at most. Kernels run longer on more, and the list is that of the box around
/// all. One thread and tolerance 0.001, ms and median error, for 96, 128, 192, 256, 384 and 512: sphere of
/// 50,000 98, 92, 93, 99, 117, 182 and 2.0, 1.8, 1.6, 1.5, 1.2, 1.1e-3; disc of 20,000 26, 26, 25, 26, 30, 48
/// and 2.2, 2.2, 1.8, 1.8, 1.5, 1.5e-3.
constexpr std::size_t most_in_group = 256;

static_assert(std::max(direct_block, most_in_group) <= BlockSum<float>::most_targets);

std::uint64_t acting_on(const ForceView& view, std::size_t target)
{
    std::uint64_t bodies = 0;
    for (std::size_t source = 0; source < view.regions.size(); ++source)
        bodies += view.acts(source, target) ? view.regions[source].body_count() : 0;
    return bodies;
}

void find_runs(const ForceView& view, std::uint64_t direct_below, std::vector<TargetRun>& runs)
{
    runs.clear();
    for (std::size_t region = 0; region < view.regions.size(); ++region) {
        if (acting_on(view, region) < direct_below)
            append_blocks(view, region, direct_block, runs);
        else
            append_groups(view, region, most_in_group, runs);
    }
}

/// One group's walk through one region: depth first, without a stack, as an index that goes on or jumps.
/// Returns the number of nodes tested.
template <class Real>
std::uint64_t walk(const ForceView& view, const ForceView::Region& region, const TargetRun& group,
                   const Opening& opening, BlockSum<Real>& sum)
{
    std::uint64_t tested = 0;
    for (std::uint32_t index = region.first_node; index < region.last_node;) {
        const ForceView::Node& node = view.nodes[index];
        const bool holds_group = group.first - node.first < node.count; // below 0 wraps beyond any count
        const bool leaf = node.next == index + 1;
        if (!holds_group) {
            ++tested;
            const NodeRole role = opening.role_of(node);
            if (role == NodeRole::Point)
                sum.add_point(node.centre, node.mass, node.q);
            else if (role == NodeRole::Extended)
                sum.add_node(node, view.second_moments[index]);
            if (role != NodeRole::Opened) {
                index = node.next;
                continue;
            }
        }
        if (leaf || index == group.node) {
            sum.add_bodies(node.first, node.first + node.count);
            index = node.next;
        } else {
            ++index;
        }
    }
    return tested;
}

/// One evaluation's terms, the same for all runs.
template <class Real>
struct Evaluation {
    const ForceView& view;
    const simd::GravityKernels<Real>& kernels;
    const GravitySettings& gravity;
    double gravitational_constant;
    ScaledUnits units;

    ForceCounts run(const TargetRun& targets, ClusterTable& clusters) const
    {
        std::optional<Opening> opening;
        if (targets.node != TargetRun::no_node)
            opening.emplace(view, targets, gravity, gravitational_constant, clusters.pull);
        ForceCounts counts{.groups = opening.has_value()};
        BlockSum<Real> sum(view, kernels, units, targets.first, targets.last, clusters.columns.tide);
        const auto add_regions = [&](bool answered) {
            bool any = false;
            for (std::size_t source = 0; source < view.regions.size(); ++source) {
                if (!view.acts(source, targets.region) || view.acts(targets.region, source) != answered)
                    continue;
                const ForceView::Region& region = view.regions[source];
                if (opening)
                    counts.nodes_tested += walk(view, region, targets, *opening, sum);
                else
                    sum.add_bodies(region.first_body, region.last_body);
                any = true;
            }
            return any;
        };
        add_regions(true);
        const Vector3d answered = sum.force();
        if (add_regions(false))
            counts.unanswered = gravitational_constant * (sum.force() - answered);
        sum.store(gravitational_constant, clusters);
        counts.interactions = sum.interactions();
        return counts;
    }
};

template <class Real>
void run_all(const Evaluation<Real>& evaluation, ForceLists& lists, ClusterTable& clusters)
{
    for_each_task(lists.runs.size(), [&](std::size_t index) {
        lists.counts[index] = evaluation.run(lists.runs[index], clusters);
    });
}

} // namespace

void reserve(ForceLists& lists, std::size_t bodies)
{
    make_room(lists.runs, bodies);
    make_room(lists.counts, bodies);
}

ForceCounts evaluate_gravity(const ForceView& view, const simd::KernelTable& kernels,
                             const GravitySettings& gravity, double gravitational_constant, ForceLists& lists,
                             ClusterTable& clusters)
{
    ForceCounts total;
    if (view.body_count() == 0)
        return total;
    SLOD_ASSERT(gravity.multipoles == Multipoles::Monopole ||
                view.second_moments.size() == view.nodes.size());
    find_runs(view, gravity.direct_below, lists.runs);
    lists.counts.resize(lists.runs.size());
    const ScaledUnits units = units_of(view);
    if (gravity.precision == Precision::Double)
        run_all<double>({view, kernels.in_double, gravity, gravitational_constant, units}, lists, clusters);
    else
        run_all<float>({view, kernels.in_float, gravity, gravitational_constant, units}, lists, clusters);
    for (const ForceCounts& counts : lists.counts) {
        total.interactions += counts.interactions;
        total.groups += counts.groups;
        total.nodes_tested += counts.nodes_tested;
        total.unanswered += counts.unanswered;
    }
    return total;
}

} // namespace slod
