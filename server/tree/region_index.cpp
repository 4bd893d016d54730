#include "tree/region_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace slod {
namespace {

constexpr std::size_t few = 8; ///< regions that are not worth a grid
/// Quantiles of the regions' widths that are sides of grids, in sixths, and the least ratio of two sides.
constexpr std::array<std::size_t, 3> sixths{1, 3, 5};
constexpr double octave = 2;
constexpr std::uint32_t no_rank = 0xffff'ffff;

using Ranks = std::span<const std::uint32_t>;

std::uint32_t first_of(const Ranks& ranks)
{
    return ranks.empty() ? no_rank : ranks.front();
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
    lay_grids();
}

/// Each region goes to the finest grid in which it reaches into few cells.
void RegionIndex::lay_grids()
{
    wide_.clear();
    grids_.clear();
    std::vector<double> widths;
    for (const Entry& entry : entries_)
        if (const double width = entry.test.bounds().size().maxCoeff(); std::isfinite(width) && width > 0)
            widths.push_back(width);
    std::sort(widths.begin(), widths.end());
    if (widths.size() > few)
        for (const std::size_t sixth : sixths)
            if (const double side = widths[widths.size() * sixth / 6];
                grids_.empty() || side >= octave * grids_.back().side())
                grids_.emplace_back(side);
    for (std::uint32_t rank = 0; rank < entries_.size(); ++rank) {
        const Box& bounds = entries_[rank].test.bounds();
        const auto grid = std::find_if(grids_.begin(), grids_.end(),
                                       [&](const RegionGrid& each) { return each.fits(bounds); });
        if (grid != grids_.end())
            grid->add(bounds, rank);
        else
            wide_.push_back(rank);
    }
    for (RegionGrid& grid : grids_)
        grid.finish();
}

RegionRow RegionIndex::find(const Subject& subject, std::uint64_t* tests) const
{
    std::array<Ranks, sixths.size() + 1> lists{Ranks(wide_)};
    for (std::size_t grid = 0; grid < grids_.size(); ++grid)
        lists[grid + 1] = grids_[grid].at(subject.position);
    const std::span used(lists.data(), grids_.size() + 1);
    for (;;) {
        Ranks& next = *std::min_element(used.begin(), used.end(), [](const Ranks& a, const Ranks& b) {
            return first_of(a) < first_of(b);
        });
        if (next.empty())
            return background_row;
        const Entry& entry = entries_[next.front()];
        if (tests != nullptr)
            ++*tests;
        if (entry.test.contains(subject))
            return entry.row;
        next = next.subspan(1);
    }
}

template <class Condition>
bool RegionIndex::any_near(const Box& box, const Condition& holds) const
{
    return std::any_of(wide_.begin(), wide_.end(), holds) ||
           std::any_of(grids_.begin(), grids_.end(),
                       [&](const RegionGrid& grid) { return grid.any_near(box, holds); });
}

bool RegionIndex::contested(const Box& box, RegionRow row) const
{
    const std::uint32_t own = row < rank_.size() ? rank_[row] : no_rank;
    if (row != background_row && (own == no_rank || !entries_[own].test.covers(box)))
        return true;
    return any_near(box, [&](std::uint32_t rank) { return rank < own && !entries_[rank].test.misses(box); });
}

} // namespace slod
