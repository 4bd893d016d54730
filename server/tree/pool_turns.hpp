#pragma once

#include <cstdint>
#include <vector>

#include "tree/slod_tree.hpp"

namespace slod {

/// When clusters that have left their pool's leaf move to the pool of the leaf where they are. At once where
/// pools have to be right in every frame: as regions take clusters or give them away, and bins, or as the
/// caller says. Where
/// nobody but merges looks at them, in turns: a frame after the pool looked for merges, as those that came
/// together, whenever that was, are the ones that may merge; and when it is flooded.
class PoolTurns {
public:
    /// Provides memory for the pools there is room for.
    void reserve(const SlodTree& tree);

    /// Gives the pools that are there their turns in `frame`; every pool, if `needed` at once.
    void give(const SlodTree& tree, std::uint64_t frame, bool needed);

    bool all_at_once() const { return all_at_once_; }

    /// Whether the pool's clusters move on now. A pool that has come since turns were given has none.
    bool has(const Subtree& subtree, std::uint32_t pool) const
    {
        const std::vector<std::uint8_t>& turns = turns_[subtree.region];
        return pool < turns.size() && turns[pool] != 0;
    }

private:
    bool all_at_once_ = true;
    std::vector<std::vector<std::uint8_t>> turns_; ///< by region and pool
};

/// Whether a pool holds so many that it does not wait for its turn.
bool flooded(const Subtree& subtree, std::uint32_t pool);

} // namespace slod
