#include <algorithm>
#include <numeric>
#include <utility>

#include "core/parallel.hpp"
#include "tree/slod_tree.hpp"

namespace slod {
namespace {

bool meet(const Box& a, const Box& b)
{
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

/// Places that changed hands.
std::vector<Box> changed_places(const SlodTree& tree)
{
    std::vector<Box> places;
    for (const SlodTree::Region& region : tree.regions) {
        if (!region.moved)
            continue;
        places.push_back(region.before);
        if (region.open)
            places.push_back(RegionTest(region.settings).bounds());
    }
    return places;
}

/// Renews what depends on the regions in one subtree, wherever a place changed hands: from the roots down,
/// each node with those changes alone that meet its box.
class Renewal {
public:
    Renewal(const SlodTree& tree, Subtree& subtree, std::vector<Box> changes)
        : tree_(tree), subtree_(subtree), changes_(std::move(changes)),
          everywhere_(tree.regions[subtree.region].laid_anew)
    {}

    /// Returns how often a box was compared with a change.
    std::uint64_t run()
    {
        for (const NodeId root : roots())
            descend(root, changes_.size());
        return compared_;
    }

private:
    /// Cells to look at: where changes are small those that they may meet, else all.
    std::vector<NodeId> roots() const
    {
        std::vector<NodeId> found;
        const auto looked_up = [&](const Box& change) { return look_up(change, found); };
        if (everywhere_ || !std::all_of(changes_.begin(), changes_.end(), looked_up)) {
            found.clear();
            subtree_.cells.for_each([&](const Cell&, NodeId root) { found.push_back(root); });
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    /// Adds the cells that the change may meet, unless it spans more than there are, or cells have bins.
    bool look_up(const Box& change, std::vector<NodeId>& found) const
    {
        const Cell first = cell_of(subtree_, change.lower), last = cell_of(subtree_, change.upper);
        const auto width = [](std::int32_t from, std::int32_t to) {
            return std::max(double(to) - from + 2, 0.0);
        };
        if (subtree_.settings.bin_by != BinBy::None ||
            width(first.x, last.x) * width(first.y, last.y) * width(first.z, last.z) >
                double(subtree_.cells.size()))
            return false;
        for (std::int32_t x = first.x - 1; x <= last.x; ++x) // the one before may touch it
            for (std::int32_t y = first.y - 1; y <= last.y; ++y)
                for (std::int32_t z = first.z - 1; z <= last.z; ++z)
                    if (const NodeId root = subtree_.cells.find({x, y, z}); root.valid())
                        found.push_back(root);
        return true;
    }

    /// `near`: so many of the changes, the first ones, may meet the node's box.
    void descend(NodeId id, std::size_t near)
    {
        Node& node = subtree_.nodes[id.index];
        const auto begin = changes_.begin(), end = begin + std::ptrdiff_t(near);
        const auto met =
            std::partition(begin, end, [&](const Box& change) { return meet(change, node.box); });
        compared_ += near;
        const auto left = std::size_t(met - begin);
        if (left == 0 && !everywhere_)
            return;
        node.contested = tree_.index.contested(node.box, subtree_.region);
        if (!node.leaf()) {
            descend(node.left, left);
            descend(node.right(), left);
        } else if (left > 0) {
            subtree_.pools[node.pool.index].due_frame = 0;
        }
    }

    const SlodTree& tree_;
    Subtree& subtree_;
    std::vector<Box> changes_;
    bool everywhere_;
    std::uint64_t compared_ = 0;
};

/// All pools of a region that is closed are due at once.
void end_all_lives(Subtree& subtree)
{
    for (Pool& pool : subtree.pools)
        pool.due_frame = 0;
}

/// The open regions, highest precedence first, and of equals the one that was there first; no background.
std::vector<RegionIndex::Entry> by_precedence(const SlodTree& tree)
{
    std::vector<RegionRow> order;
    for (std::size_t row = 1; row < tree.regions.size(); ++row)
        if (tree.regions[row].open)
            order.push_back(RegionRow(row));
    std::sort(order.begin(), order.end(), [&](RegionRow a, RegionRow b) {
        const SlodTree::Region& first = tree.regions[a];
        const SlodTree::Region& second = tree.regions[b];
        return first.settings.precedence != second.settings.precedence
                   ? first.settings.precedence > second.settings.precedence
                   : first.number < second.number;
    });
    std::vector<RegionIndex::Entry> entries;
    for (const RegionRow row : order)
        entries.push_back({row, RegionTest(tree.regions[row].settings)});
    return entries;
}

} // namespace

std::uint64_t settle(SlodTree& tree)
{
    tree.index.assign(by_precedence(tree));
    const std::vector<Box> changes = changed_places(tree);
    std::vector<std::uint64_t> compared(tree.subtrees.size());
    for_each_task(tree.subtrees.size(), [&](std::size_t row) {
        compared[row] = Renewal(tree, tree.subtrees[row], changes).run();
        if (!tree.regions[row].open)
            end_all_lives(tree.subtrees[row]);
    });
    for (SlodTree::Region& region : tree.regions)
        region.moved = region.laid_anew = false;
    tree.unsettled = false;
    return std::accumulate(compared.begin(), compared.end(), std::uint64_t{0});
}

} // namespace slod
