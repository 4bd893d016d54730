#include "gravity/node_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"

namespace slod {
namespace {

/// Weight of var(q) in a pull's relative error: the second derivative of (d^2 + q)^(-3/2) over twice itself,
/// times (d^2 + q)^2.
constexpr double blur_weight = 15.0 / 8;

/// A float that is no less: rounding to the nearest misses by 2^-24.
float rounded_up(double value)
{
    return value > 0 ? std::max(float(value * (1 + 0x1p-23)), std::numeric_limits<float>::min()) : 0.0F;
}

/// A part of a node: a body or a child.
struct Part {
    double mass;
    double number;
    Vector3d centre;
    double q;
    double radius, q_variance, q_spread;
};

Part body_part(const ForceView& view, std::uint32_t body)
{
    return {view.mass[body], 1, view.position(body), view.q[body], 0, 0, 0};
}

Part child_part(const ForceView::Node& child)
{
    const double blur_squared = double(child.blur) * double(child.blur);
    return {child.mass,
            double(child.count),
            child.centre,
            child.q,
            double(child.radius),
            blur_squared * blur_squared / blur_weight,
            double(child.q_spread)};
}

/// Sums up a node's parts; for_each_part(visit) calls visit(part) for each, twice in the same order.
template <class ForEachPart>
void sum_up(ForceView::Node& node, const Vector3d& origin, const ForEachPart& for_each_part)
{
    double mass = 0, number = 0, q = 0, q_by_number = 0;
    Vector3d by_mass{0, 0, 0}, by_number{0, 0, 0};
    for_each_part([&](const Part& part) {
        mass += part.mass;
        number += part.number;
        by_mass += part.mass * (part.centre - origin);
        by_number += part.number * (part.centre - origin);
        q += part.mass * part.q;
        q_by_number += part.number * part.q;
    });
    node.mass = mass;
    node.centre = origin + (mass > 0 ? Vector3d(by_mass / mass) : Vector3d(by_number / number));
    node.q = mass > 0 ? q / mass : q_by_number / number;
    double radius = 0, variance = 0, spread = 0;
    for_each_part([&](const Part& part) {
        radius = std::max(radius, part.radius + (part.centre - node.centre).norm());
        variance += part.mass * (part.q_variance + (part.q - node.q) * (part.q - node.q));
        spread = std::max(spread, part.q_spread + std::abs(part.q - node.q));
    });
    node.radius = rounded_up(radius);
    node.blur = mass > 0 ? rounded_up(std::sqrt(std::sqrt(blur_weight * variance / mass))) : 0.0F;
    node.q_spread = rounded_up(spread);
}

void sum_up_leaf(const ForceView& view, ForceView::Node& node)
{
    sum_up(node, view.position(node.first), [&](const auto& visit) {
        for (std::uint32_t body = node.first; body < node.first + node.count; ++body)
            visit(body_part(view, body));
    });
}

/// From the children, which come later in the array and are summed up already.
void sum_up_inner(ForceView& view, std::size_t index)
{
    ForceView::Node& node = view.nodes[index];
    sum_up(node, view.nodes[index + 1].centre, [&](const auto& visit) {
        for (std::size_t child = index + 1; child < node.next; child = view.nodes[child].next)
            visit(child_part(view.nodes[child]));
    });
}

} // namespace

void sum_up_nodes(ForceView& view)
{
    const auto leaf = [&](std::size_t node) { return view.nodes[node].next == node + 1; };
    for_each_block(view.nodes.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t node = first; node < last; ++node)
            if (leaf(node))
                sum_up_leaf(view, view.nodes[node]);
    });
    for (std::size_t node = view.nodes.size(); node-- > 0;)
        if (!leaf(node))
            sum_up_inner(view, node);
}

} // namespace slod
