#include <algorithm>
#include <compare>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "tree/slod_tree.hpp"

namespace slod {
namespace {

bool meet(const Box& a, const Box& b)
{
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

/// Those of the changes that meet the box, put in front.
std::span<Box> meeting(std::span<Box> changes, const Box& box)
{
    const auto met =
        std::partition(changes.begin(), changes.end(), [&](const Box& change) { return meet(change, box); });
    return {changes.begin(), met};
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

/// A cell of a subtree.
struct CellRoot {
    RegionRow row;
    NodeId node;

    friend constexpr auto operator<=>(const CellRoot&, const CellRoot&) = default;
};

/// Renews what depends on the regions, wherever a place changed hands. The cells of all subtrees are halved,
/// as in a k-d tree, and each half, cell and node is compared with those changes alone that meet the one
/// above: what it costs is what each change meets, by their logarithms, however many regions changed.
class Renewal {
public:
    explicit Renewal(SlodTree& tree) : tree_(tree) {}

    /// Returns how often a box was compared with a change.
    std::uint64_t run(std::vector<Box> changes)
    {
        std::vector<CellRoot> roots;
        for (const Subtree& subtree : tree_.subtrees)
            append_roots(subtree, changes, roots);
        return halve(roots, changes);
    }

private:
    /// Changes that cells are compared with one by one.
    static constexpr std::size_t few = 4;
    /// Cells that are worth a thread.
    static constexpr std::size_t many = 1024;

    /// Adds the cells that the changes may meet: by looking into all where those span more than there are,
    /// and where cells have bins.
    void append_roots(const Subtree& subtree, std::span<const Box> changes,
                      std::vector<CellRoot>& roots) const
    {
        double spanned = 0;
        const auto spans_too_many = [&](const Box& change) {
            const Cell first = first_cell(subtree, change), last = cell_of(subtree, change.upper);
            const auto width = [](std::int32_t from, std::int32_t to) {
                return std::max(double(to) - from + 1, 0.0);
            };
            spanned += width(first.x, last.x) * width(first.y, last.y) * width(first.z, last.z);
            return spanned > double(subtree.cells.size());
        };
        if (subtree.settings.bin_by != BinBy::None ||
            std::any_of(changes.begin(), changes.end(), spans_too_many)) {
            subtree.cells.for_each([&](const Cell&, NodeId root) {
                roots.push_back({subtree.region, root});
            });
            return;
        }
        const auto own = std::ptrdiff_t(roots.size());
        for (const Box& change : changes)
            look_up(subtree, change, roots);
        std::sort(roots.begin() + own, roots.end());
        roots.erase(std::unique(roots.begin() + own, roots.end()), roots.end());
    }

    /// The cell before the one of the lower corner, as it may touch the change.
    static Cell first_cell(const Subtree& subtree, const Box& change)
    {
        const Cell corner = cell_of(subtree, change.lower);
        return {corner.x - 1, corner.y - 1, corner.z - 1};
    }

    static void look_up(const Subtree& subtree, const Box& change, std::vector<CellRoot>& roots)
    {
        const Cell first = first_cell(subtree, change), last = cell_of(subtree, change.upper);
        for (std::int32_t x = first.x; x <= last.x; ++x)
            for (std::int32_t y = first.y; y <= last.y; ++y)
                for (std::int32_t z = first.z; z <= last.z; ++z)
                    if (const NodeId root = subtree.cells.find({x, y, z}); root.valid())
                        roots.push_back({subtree.region, root});
    }

    /// All the changes may meet the cells; re-orders both.
    std::uint64_t halve(std::span<CellRoot> roots, std::span<Box> changes)
    {
        std::uint64_t compared = 0;
        if (changes.size() <= few || roots.size() <= 1) {
            for (const CellRoot& root : roots)
                compared += descend(tree_.subtrees[root.row], root.node, changes);
            return compared;
        }
        const Box box = box_around(roots);
        const std::span<Box> met = meeting(changes, box);
        compared += changes.size();
        if (met.empty())
            return compared;
        const auto middle = roots.begin() + std::ptrdiff_t(roots.size() / 2);
        const int axis = box.longest_side();
        std::nth_element(roots.begin(), middle, roots.end(), [&](const CellRoot& a, const CellRoot& b) {
            const double first = box_of(a).lower[axis], second = box_of(b).lower[axis];
            return first != second ? first < second : a < b;
        });
        const std::span lower(roots.begin(), middle), upper(middle, roots.end());
        if (roots.size() < many)
            return compared + halve(lower, met) + halve(upper, met);
        std::vector<Box> copy(met.begin(), met.end());
        std::uint64_t below = 0, above = 0;
        run_both([&] { below = halve(lower, met); }, [&] { above = halve(upper, copy); });
        return compared + below + above;
    }

    /// Renews the node, and those below it, where the changes meet its box; re-orders the changes.
    std::uint64_t descend(Subtree& subtree, NodeId id, std::span<Box> changes)
    {
        Node& node = subtree.nodes[id.index];
        const std::span<Box> met = meeting(changes, node.box);
        if (met.empty())
            return changes.size();
        node.contested = tree_.index.contested(node.box, subtree.region);
        if (!node.leaf())
            return changes.size() + descend(subtree, node.left, met) + descend(subtree, node.right(), met);
        subtree.pools[node.pool.index].due_frame = 0;
        return changes.size();
    }

    const Box& box_of(const CellRoot& root) const
    {
        return tree_.subtrees[root.row].nodes[root.node.index].box;
    }

    Box box_around(std::span<const CellRoot> roots) const
    {
        Box around = box_of(roots.front());
        for (const CellRoot& root : roots) {
            around.lower = around.lower.cwiseMin(box_of(root).lower);
            around.upper = around.upper.cwiseMax(box_of(root).upper);
        }
        return around;
    }

    SlodTree& tree_;
};

/// Renews all marks of a subtree.
void mark_all(const SlodTree& tree, Subtree& subtree)
{
    for (Node& node : subtree.nodes) // marks of free ones are written when they are taken
        node.contested = tree.index.contested(node.box, subtree.region);
}

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
    for_each_task(tree.subtrees.size(), [&](std::size_t row) {
        if (tree.regions[row].laid_anew)
            mark_all(tree, tree.subtrees[row]);
        if (!tree.regions[row].open)
            end_all_lives(tree.subtrees[row]);
    });
    const std::uint64_t compared = Renewal(tree).run(changed_places(tree));
    for (SlodTree::Region& region : tree.regions)
        region.moved = region.laid_anew = false;
    tree.unsettled = false;
    return compared;
}

} // namespace slod
