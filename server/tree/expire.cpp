#include "tree/expire.hpp"

#include "core/parallel.hpp"

namespace slod {

std::uint64_t Expiry::update(SlodTree& tree, const UpdateContext& context)
{
    ClusterTable& clusters = context.store.clusters;
    died_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            const bool due = clusters.alive(slot) && clusters.next_expiry[slot] <= context.frame;
            died_[slot] = due ? remove_expired(context.store, {std::uint32_t(slot)}, context.frame) : 0;
        }
    });
    std::uint64_t total = 0;
    for (std::uint32_t slot = 0; slot < died_.size(); ++slot) {
        if (died_[slot] == 0)
            continue;
        total += died_[slot];
        Subtree& subtree = tree.subtrees[clusters.region[slot]];
        subtree.pools[clusters.pool[slot].index].members -= died_[slot];
        if (!clusters.alive(slot)) {
            unlink(subtree, clusters, {slot});
            context.store.members.retire(clusters.slab[slot], context.frame);
            clusters.free_slot({slot});
        }
    }
    return total;
}

} // namespace slod
