#include "gravity/second_moments.hpp"

#include "core/parallel.hpp"

namespace slod {
namespace {

Symmetric3 per_mass(const Symmetric3& moments, double mass)
{
    return mass > 0 ? 1 / mass * moments : Symmetric3{};
}

Symmetric3 of_leaf(const ForceView& view, const ForceView::Node& leaf)
{
    Symmetric3 moments;
    for (std::uint32_t body = leaf.first; body < leaf.first + leaf.count; ++body)
        moments += Symmetric3::square(view.mass[body], view.position(body) - leaf.centre);
    return per_mass(moments, leaf.mass);
}

/// From the children's, each about its own centre (Steiner).
Symmetric3 of_inner(const ForceView& view, std::size_t index)
{
    const ForceView::Node& node = view.nodes[index];
    Symmetric3 moments;
    for (std::size_t child = index + 1; child < node.next; child = view.nodes[child].next) {
        moments += view.nodes[child].mass * view.second_moments[child];
        moments += Symmetric3::square(view.nodes[child].mass, view.nodes[child].centre - node.centre);
    }
    return per_mass(moments, node.mass);
}

} // namespace

void sum_up_second_moments(ForceView& view)
{
    view.second_moments.resize(view.nodes.size());
    const auto leaf = [&](std::size_t node) { return view.nodes[node].next == node + 1; };
    for_each_block(view.nodes.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t node = first; node < last; ++node)
            if (leaf(node))
                view.second_moments[node] = of_leaf(view, view.nodes[node]);
    });
    for (std::size_t node = view.nodes.size(); node-- > 0;)
        if (!leaf(node))
            view.second_moments[node] = of_inner(view, node);
}

} // namespace slod
