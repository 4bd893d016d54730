#include "tree/pool_turns.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "tree/gathering.hpp"

namespace slod {

void PoolTurns::reserve(const SlodTree& tree)
{
    turns_.resize(std::max(turns_.size(), tree.subtrees.size()));
    for (const Subtree& subtree : tree.subtrees)
        turns_[subtree.region].reserve(subtree.pools.capacity());
}

void PoolTurns::give(const SlodTree& tree, std::uint64_t frame, bool needed)
{
    constexpr std::size_t block = 1024;
    const bool binned = tree.subtrees[background_row].settings.bin_by != BinBy::None;
    const bool closing = std::any_of(tree.subtrees.begin() + 1, tree.subtrees.end(),
                                     [](const Subtree& closed) { return closed.pool_count() > 0; });
    all_at_once_ = needed || binned || closing || !tree.index.empty();
    turns_.resize(std::max(turns_.size(), tree.subtrees.size()));
    for (const Subtree& subtree : tree.subtrees) {
        std::vector<std::uint8_t>& turns = turns_[subtree.region];
        turns.resize(subtree.pools.size());
        for_each_block(turns.size(), block, [&](std::size_t first, std::size_t last) {
            for (auto pool = std::uint32_t(first); pool < last; ++pool)
                turns[pool] =
                    all_at_once_ || (pool + 1 - frame) % Gathering::period == 0 || flooded(subtree, pool);
        });
    }
}

bool flooded(const Subtree& subtree, std::uint32_t pool)
{
    constexpr double flood = 4; // pools at their limit
    return subtree.pools[pool].members > flood * subtree.pool_limit();
}

} // namespace slod
