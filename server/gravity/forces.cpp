#include "gravity/forces.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "core/make_room.hpp"
#include "core/parallel.hpp"
#include "gravity/block_sum.hpp"
#include "gravity/branch_walk.hpp"

namespace slod {
namespace {

constexpr std::size_t direct_block = 128; ///< targets of a direct sum
/// Bodies of a branch that one thread walks, at most and at least, and the share of all where in between.
constexpr std::size_t largest_branch = 4096, smallest_branch = 256, branches = 64;

static_assert(direct_block <= BlockSum<float>::most_targets);

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
    const std::size_t branch = std::clamp(view.body_count() / branches, smallest_branch, largest_branch);
    for (std::size_t region = 0; region < view.regions.size(); ++region) {
        if (acting_on(view, region) < direct_below)
            append_blocks(view, region, direct_block, runs);
        else
            append_groups(view, region, branch, runs);
    }
}

/// All pairs of a block of targets with what acts on them.
template <class Real>
ForceCounts sum_directly(const ForceTerms<Real>& terms, const TargetRun& targets, ClusterTable& clusters)
{
    const ForceView& view = terms.view;
    BlockSum<Real> sum(view, terms.kernels, terms.units, targets.first, targets.last, clusters.columns.tide);
    const auto add_regions = [&](bool answered) {
        bool any = false;
        for (std::size_t source = 0; source < view.regions.size(); ++source) {
            if (!view.acts(source, targets.region) || view.acts(targets.region, source) != answered)
                continue;
            sum.add_bodies(view.regions[source].first_body, view.regions[source].last_body);
            any = true;
        }
        return any;
    };
    ForceCounts counts;
    add_regions(true);
    const Vector3d answered = sum.force();
    if (add_regions(false))
        counts.unanswered = terms.gravitational_constant * (sum.force() - answered);
    sum.store(terms.gravitational_constant, clusters);
    counts.interactions = sum.interactions();
    return counts;
}

template <class Real>
void run_all(const ForceTerms<Real>& terms, ForceLists& lists, ClusterTable& clusters)
{
    for_each_task(lists.runs.size(), [&](std::size_t index) {
        const TargetRun& run = lists.runs[index];
        lists.counts[index] = run.node == TargetRun::no_node
                                  ? sum_directly(terms, run, clusters)
                                  : BranchWalk<Real>(terms, run.region, clusters).run(run.node);
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
        total.far_nodes += counts.far_nodes;
        total.groups += counts.groups;
        total.nodes_tested += counts.nodes_tested;
        total.unanswered += counts.unanswered;
    }
    return total;
}

} // namespace slod
