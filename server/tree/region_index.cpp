#include "tree/region_index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slod {
namespace {

constexpr std::size_t few = 8;    ///< regions that are not worth a grid
constexpr double most_cells = 64; ///< of the grid that one region or box is looked up in
constexpr std::int32_t cell_limit = 1 << 30;
constexpr std::uint32_t no_rank = 0xffff'ffff;

double longest_side(const Box& bounds)
{
    return bounds.size().maxCoeff();
}

template <class Visitor>
void for_each_cell(const Cell& first, const Cell& last, const Visitor& visit)
{
    for (std::int32_t x = first.x; x <= last.x; ++x)
        for (std::int32_t y = first.y; y <= last.y; ++y)
            for (std::int32_t z = first.z; z <= last.z; ++z)
                visit(Cell{x, y, z});
}

} // namespace

void RegionIndex::assign(std::vector<Entry> in_order)
{
    entries_ = std::move(in_order);
    rank_.clear();
    for (std::uint32_t rank = 0; rank < entries_.size(); ++rank) {
        const RegionRow row = entries_[rank].row;
        if (rank_.size() <= row)
            rank_.resize(row + std::size_t{1}, no_rank);
        rank_[row] = rank;
    }
    lay_grid();
}

/// Cells of the regions' median width: most regions reach into a few, and few into one.
void RegionIndex::lay_grid()
{
    wide_.clear();
    reaches_.clear();
    first_reach_ = {};
    std::vector<double> widths;
    for (const Entry& entry : entries_)
        if (const double width = longest_side(entry.test.bounds()); std::isfinite(width) && width > 0)
            widths.push_back(width);
    const bool gridded = widths.size() > few;
    if (gridded) {
        const auto median = widths.begin() + std::ptrdiff_t(widths.size() / 2);
        std::nth_element(widths.begin(), median, widths.end());
        side_ = *median;
    }
    for (std::uint32_t rank = 0; rank < entries_.size(); ++rank) {
        if (gridded && fits_grid(entries_[rank].test.bounds()))
            spread(rank);
        else
            wide_.push_back(rank);
    }
    std::sort(reaches_.begin(), reaches_.end());
    for (std::uint32_t i = 0; i < reaches_.size(); ++i)
        if (i == 0 || reaches_[i].cell != reaches_[i - 1].cell)
            first_reach_.insert(reaches_[i].cell, {i});
}

bool RegionIndex::fits_grid(const Box& bounds) const
{
    const Vector3d cells = bounds.size() / side_ + Vector3d::Ones();
    const double farthest = std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff());
    return cells.prod() <= most_cells && farthest / side_ < double(cell_limit);
}

void RegionIndex::spread(std::uint32_t rank)
{
    const Box& bounds = entries_[rank].test.bounds();
    for_each_cell(cell_of(bounds.lower), cell_of(bounds.upper), [&](const Cell& cell) {
        reaches_.push_back({cell, rank});
    });
}

/// Rounds alike for a region's corners and for the subjects between them, so that none is missed.
Cell RegionIndex::cell_of(const Vector3d& x) const
{
    const auto coordinate = [&](double value) {
        const double cell = std::floor(value / side_);
        return cell > -cell_limit ? std::int32_t(std::min(cell, double(cell_limit))) : -cell_limit;
    };
    return {coordinate(x.x()), coordinate(x.y()), coordinate(x.z())};
}

RegionRow RegionIndex::find(const Subject& subject, std::uint64_t* tests) const
{
    if (entries_.empty())
        return background_row;
    const auto count = [&] {
        if (tests != nullptr)
            ++*tests;
    };
    auto wide = wide_.begin();
    if (!reaches_.empty()) {
        const Cell cell = cell_of(subject.position);
        const NodeId first = first_reach_.find(cell);
        for (std::size_t i = first.valid() ? first.index : reaches_.size();
             i < reaches_.size() && reaches_[i].cell == cell; ++i) {
            const std::uint32_t rank = reaches_[i].rank;
            for (; wide != wide_.end() && *wide < rank; ++wide) {
                count();
                if (entries_[*wide].test.contains(subject))
                    return entries_[*wide].row;
            }
            count();
            if (entries_[rank].test.contains(subject))
                return entries_[rank].row;
        }
    }
    for (; wide != wide_.end(); ++wide) {
        count();
        if (entries_[*wide].test.contains(subject))
            return entries_[*wide].row;
    }
    return background_row;
}

template <class Condition>
bool RegionIndex::any_near(const Box& box, const Condition& holds) const
{
    if (reaches_.empty() || !fits_grid(box)) {
        for (std::uint32_t rank = 0; rank < entries_.size(); ++rank)
            if (holds(rank))
                return true;
        return false;
    }
    if (std::any_of(wide_.begin(), wide_.end(), holds))
        return true;
    bool found = false;
    for_each_cell(cell_of(box.lower), cell_of(box.upper), [&](const Cell& cell) {
        const NodeId first = first_reach_.find(cell);
        for (std::size_t i = first.valid() ? first.index : reaches_.size();
             !found && i < reaches_.size() && reaches_[i].cell == cell; ++i)
            found = holds(reaches_[i].rank);
    });
    return found;
}

bool RegionIndex::contested(const Box& box, RegionRow row) const
{
    const std::uint32_t own = row < rank_.size() ? rank_[row] : no_rank;
    if (row != background_row && (own == no_rank || !entries_[own].test.covers(box)))
        return true;
    return any_near(box, [&](std::uint32_t rank) { return rank < own && !entries_[rank].test.misses(box); });
}

} // namespace slod
