#include "gravity/target_runs.hpp"

#include <algorithm>

#include "core/assert.hpp"

namespace slod {

void append_blocks(const ForceView& view, std::size_t region, std::size_t most, std::vector<TargetRun>& runs)
{
    const ForceView::Region& bodies = view.regions[region];
    for (std::uint32_t first = bodies.first_body; first < bodies.last_body; first += std::uint32_t(most))
        runs.push_back({first, std::min(first + std::uint32_t(most), bodies.last_body), TargetRun::no_node,
                        std::uint32_t(region)});
}

void append_groups(const ForceView& view, std::size_t region, std::size_t most, std::vector<TargetRun>& runs)
{
    for (std::uint32_t index = view.regions[region].first_node; index < view.regions[region].last_node;) {
        const ForceView::Node& node = view.nodes[index];
        if (node.count > most) {
            SLOD_ASSERT(node.next > index + 1);
            ++index;
            continue;
        }
        runs.push_back({node.first, node.first + node.count, index, std::uint32_t(region)});
        index = node.next;
    }
}

} // namespace slod
