#include "app/publish_nodes.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/morton.hpp"

namespace slod {

namespace {

constexpr unsigned digit_bits = 11;
constexpr unsigned code_bits = 3 * morton_bits;

/// Cell of a coordinate on an axis of 2^21 cells; NaN falls into the first one.
std::uint64_t cell(double offset, double cells_per_length)
{
    constexpr double last = (1U << morton_bits) - 1;
    const double place = offset * cells_per_length;
    if (!(place > 0))
        return 0;
    return static_cast<std::uint64_t>(std::min(place, last));
}

/// What a cluster weighs in means: its mass, or its particles where all masses are 0.
double weight(const ClusterStates& states, std::uint32_t row, bool by_mass)
{
    return by_mass ? states.mass[row] : double(states.count[row]);
}

Symmetric3 covariance_of(const ClusterStates& states, std::uint32_t row)
{
    const auto [xx, xy, xz, yy, yz, zz] = states.covariance[row];
    return {xx, xy, xz, yy, yz, zz};
}

PublishedNode single(const ClusterStates& states, std::uint32_t row)
{
    return {.position = states.position[row],
            .velocity = states.velocity[row],
            .mass = states.mass[row],
            .particles = states.count[row],
            .covariance = covariance_of(states, row),
            .id = states.id[row],
            .formation = states.formation[row]};
}

} // namespace

PublishedNode sum_of(const ClusterStates& states, std::span<const std::uint32_t> rows)
{
    PublishedNode node = single(states, rows.front());
    if (rows.size() == 1)
        return node;
    node.mass = 0;
    node.particles = 0;
    for (const std::uint32_t row : rows) {
        node.mass += states.mass[row];
        node.particles += states.count[row];
    }
    const bool by_mass = node.mass > 0;
    const double total = by_mass ? node.mass : std::max(1.0, double(node.particles));

    node.position.setZero();
    node.velocity.setZero();
    for (const std::uint32_t row : rows) {
        const double share = weight(states, row, by_mass) / total;
        node.position += share * states.position[row];
        node.velocity += share * states.velocity[row];
    }
    Matrix3d second_moment = Matrix3d::Zero();
    for (const std::uint32_t row : rows) {
        const double share = weight(states, row, by_mass) / total;
        const Vector3d offset = states.position[row] - node.position;
        second_moment += share * (covariance_of(states, row).matrix() + offset * offset.transpose());
    }
    node.covariance = Symmetric3::of(second_moment);
    return node;
}

void NodeGroups::form(const ClusterStates& states, std::span<const std::uint32_t> rows, std::size_t limit)
{
    rows_.assign(rows.begin(), rows.end());
    divide(states, limit);
}

void NodeGroups::form(const ClusterStates& states, std::size_t limit)
{
    rows_.resize(states.size());
    std::iota(rows_.begin(), rows_.end(), 0U);
    divide(states, limit);
}

void NodeGroups::divide(const ClusterStates& states, std::size_t limit)
{
    find_box(states);
    group_count_ = std::min(rows_.size(), std::max<std::size_t>(limit, 1));
    if (group_count_ < rows_.size())
        sort_by_place(states);
}

std::uint32_t NodeGroups::clusters_per_group() const
{
    if (group_count_ == 0)
        return 1;
    return static_cast<std::uint32_t>((rows_.size() + group_count_ - 1) / group_count_);
}

std::span<const std::uint32_t> NodeGroups::operator[](std::size_t index) const
{
    const std::size_t first = index * rows_.size() / group_count_;
    const std::size_t last = (index + 1) * rows_.size() / group_count_;
    return std::span(rows_).subspan(first, last - first);
}

void NodeGroups::find_box(const ClusterStates& states)
{
    lower_.setZero();
    upper_.setZero();
    if (rows_.empty())
        return;
    lower_ = upper_ = states.position[rows_.front()];
    for (const std::uint32_t row : rows_) {
        lower_ = lower_.cwiseMin(states.position[row]);
        upper_ = upper_.cwiseMax(states.position[row]);
    }
}

void NodeGroups::sort_by_place(const ClusterStates& states)
{
    const double extent = (upper_ - lower_).maxCoeff();
    const double cells_per_length = extent > 0 ? (1U << morton_bits) / extent : 0;
    keys_.clear();
    for (const std::uint32_t row : rows_) {
        const Vector3d offset = states.position[row] - lower_;
        const std::uint64_t code = spread_bits(cell(offset.x(), cells_per_length)) << 2 |
                                   spread_bits(cell(offset.y(), cells_per_length)) << 1 |
                                   spread_bits(cell(offset.z(), cells_per_length));
        keys_.push_back({code, row});
    }
    for (unsigned shift = 0; shift < code_bits; shift += digit_bits)
        sort_by_digit(shift);
    std::transform(keys_.begin(), keys_.end(), rows_.begin(), [](const Key& key) { return key.row; });
}

/// One pass of a radix sort: stable, so equal codes stay in the order of their rows.
void NodeGroups::sort_by_digit(unsigned shift)
{
    constexpr std::size_t digit_count = std::size_t(1) << digit_bits;
    const auto digit = [shift](const Key& key) { return (key.code >> shift) & (digit_count - 1); };
    std::array<std::uint32_t, digit_count> place{};
    for (const Key& key : keys_)
        ++place[digit(key)];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), 0U);
    sorted_keys_.resize(keys_.size());
    for (const Key& key : keys_)
        sorted_keys_[place[digit(key)]++] = key;
    std::swap(keys_, sorted_keys_);
}

} // namespace slod
