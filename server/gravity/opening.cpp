#include "gravity/opening.hpp"

#include <algorithm>
#include <limits>

namespace slod {
namespace {

constexpr double least_share = 0.05; ///< of the gross pull

/// 0 when there is one that is not known.
double smallest_pull(const ForceView& view, const TargetRun& group, const AlignedVector<double>& pulls)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (std::uint32_t body = group.first; body < group.last; ++body)
        smallest = std::min(smallest, pulls[view.slot[body].index]);
    return smallest;
}

} // namespace

Opening::Opening(const ForceView& view, const TargetRun& group, const GravitySettings& gravity,
                 double gravitational_constant, const AlignedVector<double>& pulls)
    : lower_(view.position(group.first)), upper_(lower_),
      angle_squared_(std::min(gravity.opening_angle, guard) * std::min(gravity.opening_angle, guard)),
      accepted_(gravity.multipoles == Multipoles::Quadrupole ? NodeRole::Extended : NodeRole::Point)
{
    for (std::uint32_t body = group.first; body < group.last; ++body) {
        lower_ = lower_.cwiseMin(view.position(body));
        upper_ = upper_.cwiseMax(view.position(body));
    }
    const double smallest = smallest_pull(view, group, pulls);
    relative_ = gravity.opening == OpeningCriterion::Relative && smallest > 0;
    if (!relative_)
        return;
    allowed_ = gravity.force_tolerance *
               std::max(smallest / gravitational_constant, least_share * gross_pull(view, group));
    allowed_of_points_ = accepted_ == NodeRole::Extended ? 0.5 * allowed_ : allowed_;
}

/// Sum of the sizes of pulls / G, by nodes as coarse as the guard allows; without the nearest bodies.
double Opening::gross_pull(const ForceView& view, const TargetRun& group) const
{
    double sum = 0;
    for (std::size_t source = 0; source < view.regions.size(); ++source) {
        if (!view.acts(source, group.region))
            continue;
        const ForceView::Region& region = view.regions[source];
        for (std::uint32_t index = region.first_node; index < region.last_node;) {
            const ForceView::Node& node = view.nodes[index];
            const double squared = distance_squared(node);
            const double radius = double(node.radius);
            const bool far = squared > 0 && radius * radius <= guard * guard * squared;
            if (far)
                sum += node.mass / (squared + node.q);
            index = far || node.count <= group.last - group.first ? node.next : index + 1;
        }
    }
    return sum;
}

} // namespace slod
