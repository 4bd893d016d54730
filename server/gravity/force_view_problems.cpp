#include <string>

#include "gravity/force_view.hpp"

namespace slod {

Problems problems(const ForceView& view, const ClusterTable& clusters)
{
    Problems found;
    if (view.body_count() != clusters.alive_count())
        found.push_back("the force view has " + std::to_string(view.body_count()) + " bodies for " +
                        std::to_string(clusters.alive_count()) + " clusters");
    if (!view.second_moments.empty() && view.second_moments.size() != view.nodes.size())
        found.push_back("the force view has " + std::to_string(view.second_moments.size()) +
                        " second moments for " + std::to_string(view.nodes.size()) + " nodes");
    for (std::size_t index = 0; index < view.nodes.size(); ++index) {
        const ForceView::Node& node = view.nodes[index];
        const auto report =
            [&](const char* what) { // no text without a problem: validated frames take no memory
                found.push_back("force view node " + std::to_string(index) + what);
            };
        if (node.count == 0 || node.next <= index || node.next > view.nodes.size())
            report(" is empty or goes on at a node before it");
        std::uint32_t covered = node.first;
        for (std::uint32_t child = std::uint32_t(index) + 1; child < node.next;
             child = view.nodes[child].next) {
            if (view.nodes[child].first != covered)
                report(" has a child that does not begin where the last one ended");
            covered += view.nodes[child].count;
        }
        if (node.next > index + 1 && covered != node.first + node.count)
            report(" is not covered by its children");
    }
    return found;
}

} // namespace slod
