#include "tree/region_grid.hpp"

#include <cmath>

namespace slod {
namespace {

constexpr double most_cells = 64; ///< of its size; with those that its faces cut it reaches into 125 at most
constexpr std::int32_t cell_limit = 1 << 30;

} // namespace

bool RegionGrid::fits(const Box& box) const
{
    const Vector3d cells = box.size() / side_ + Vector3d::Ones();
    const double farthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    return cells.prod() <= most_cells && farthest / side_ < double(cell_limit);
}

void RegionGrid::add(const Box& box, std::uint32_t rank)
{
    all_.push_back(rank);
    const Cell first = cell_of(box.lower), last = cell_of(box.upper);
    for (std::int32_t x = first.x; x <= last.x; ++x)
        for (std::int32_t y = first.y; y <= last.y; ++y)
            for (std::int32_t z = first.z; z <= last.z; ++z)
                reaches_.push_back({{x, y, z}, rank});
}

void RegionGrid::finish()
{
    std::sort(reaches_.begin(), reaches_.end());
    for (std::size_t i = 0; i < reaches_.size(); ++i) {
        if (i == 0 || reaches_[i].cell != reaches_[i - 1].cell) {
            runs_.insert(reaches_[i].cell, {std::uint32_t(run_begin_.size())});
            run_begin_.push_back(std::uint32_t(i));
        }
        ranks_.push_back(reaches_[i].rank);
    }
    run_begin_.push_back(std::uint32_t(ranks_.size()));
    reaches_ = {};
}

/// Rounds alike for a box's corners and for the places between them, so that none is missed.
Cell RegionGrid::cell_of(const Vector3d& x) const
{
    const auto coordinate = [&](double value) {
        const double cell = std::floor(value / side_);
        return cell > -cell_limit ? std::int32_t(std::min(cell, double(cell_limit))) : -cell_limit;
    };
    return {coordinate(x.x()), coordinate(x.y()), coordinate(x.z())};
}

std::span<const std::uint32_t> RegionGrid::in(const Cell& cell) const
{
    const RunId run = runs_.find(cell);
    if (!run.valid())
        return {};
    return std::span(ranks_).subspan(run_begin_[run.index],
                                     run_begin_[run.index + 1] - run_begin_[run.index]);
}

} // namespace slod
