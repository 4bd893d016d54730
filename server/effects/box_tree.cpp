#include "effects/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace slod {
namespace {

Vector3d twice_centre(const Box& box)
{
    return box.lower + box.upper;
}

} // namespace

BoxTree::BoxTree(std::span<const Box> boxes) : order_(boxes.size())
{
    std::iota(order_.begin(), order_.end(), 0U);
    if (!boxes.empty())
        build(boxes, 0, std::uint32_t(boxes.size()));
}

/// Halves the boxes at the median of their centres along the longest side of what holds these.
void BoxTree::build(std::span<const Box> boxes, std::uint32_t first, std::uint32_t count)
{
    const std::size_t here = nodes_.size();
    const auto begin = order_.begin() + first, end = begin + count;
    Box box = boxes[*begin];
    Box centres{twice_centre(box), twice_centre(box)};
    for (const std::uint32_t index : std::span(begin, end)) {
        box.lower = box.lower.cwiseMin(boxes[index].lower);
        box.upper = box.upper.cwiseMax(boxes[index].upper);
        centres.lower = centres.lower.cwiseMin(twice_centre(boxes[index]));
        centres.upper = centres.upper.cwiseMax(twice_centre(boxes[index]));
    }
    nodes_.push_back({.box = box});
    if (count <= leaf_capacity) {
        std::sort(begin, end);
        nodes_[here].first = first;
        nodes_[here].count = count;
    } else {
        const int axis = centres.longest_side();
        const auto key = [&](std::uint32_t index) {
            return std::tuple(twice_centre(boxes[index])[axis], index);
        };
        const std::uint32_t half = count / 2;
        std::nth_element(begin, begin + half, end,
                         [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        build(boxes, first, half);
        build(boxes, first + half, count - half);
    }
    nodes_[here].after = std::uint32_t(nodes_.size());
}

} // namespace slod
