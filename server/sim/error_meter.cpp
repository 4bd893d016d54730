#include "sim/error_meter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/random.hpp"

namespace slod {
namespace {

constexpr std::uint32_t stream = 0x6d657472; ///< of the draws' random numbers

} // namespace

void ErrorMeter::reserve(std::size_t clusters, std::size_t regions)
{
    drawn_.reserve(most_draws);
    order_.reserve(clusters);
    before_.reserve(clusters + 1);
    region_first_.reserve(regions + 1);
    next_.reserve(regions);
    inhabited_.reserve(regions);
    probes_.reserve(most_draws);
    attracts_.reserve(regions);
    fresh_.reserve(window + most_draws);
    taken_.reserve(window + most_draws);
    if (of_region_.size() < regions)
        of_region_.resize(regions);
    pulls_.reserve(clusters);
}

/// Lists the clusters by region, with the particles before each.
void ErrorMeter::sort_by_region(const SlodTree& tree, const ClusterTable& clusters)
{
    region_first_.assign(tree.subtrees.size() + 1, 0);
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        region_first_[clusters.region[slot] + 1U] += clusters.alive(slot) ? 1 : 0;
    std::partial_sum(region_first_.begin(), region_first_.end(), region_first_.begin());
    order_.resize(region_first_.back());
    next_.assign(region_first_.begin(), region_first_.end() - 1);
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot)
        if (clusters.alive(slot))
            order_[next_[clusters.region[slot]]++] = slot;
    before_.assign(order_.size() + 1, 0);
    for (std::size_t i = 0; i < order_.size(); ++i)
        before_[i + 1] = before_[i] + clusters.count[order_[i]];
}

std::vector<ErrorMeter::Drawn>& ErrorMeter::draw(const SlodTree& tree, const ClusterStore& store,
                                                 std::uint64_t frame)
{
    drawn_.clear();
    sort_by_region(tree, store.clusters);
    if (order_.empty())
        return drawn_;
    inhabited_.clear();
    for (std::size_t row = 0; row + 1 < region_first_.size(); ++row)
        if (region_first_[row] < region_first_[row + 1])
            inhabited_.push_back(RegionRow(row));
    const std::uint32_t of_regions = inhabited_.size() > 1 ? at_once_ / 2 : 0;
    for (std::uint32_t i = of_regions; i < at_once_; ++i)
        draw_of(tree, store, frame, 0, before_.back(), true);
    const std::size_t at_once = std::min(inhabited_.size(), regions_at_once);
    for (std::uint32_t i = 0; i < of_regions; ++i) {
        const RegionRow row = inhabited_[(next_region_ + i % at_once) % inhabited_.size()];
        draw_of(tree, store, frame, before_[region_first_[row]], before_[region_first_[row + 1]], false);
    }
    next_region_ += at_once;
    return drawn_;
}

/// One of the particles [first, last), every one as likely.
void ErrorMeter::draw_of(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                         std::uint64_t first, std::uint64_t last, bool of_all)
{
    Random random(seed_, stream, draws_++);
    const auto drawn = std::min(first + std::uint64_t(random.uniform() * double(last - first)), last - 1);
    const auto above = std::upper_bound(before_.begin(), before_.end(), drawn);
    const auto place = std::size_t(above - before_.begin()) - 1;
    const ClusterSlot slot{order_[place]};
    const RegionRow row = store.clusters.region[slot.index];
    drawn_.push_back({.slot = slot,
                      .row = row,
                      .region = tree.regions[row].number,
                      .member = member_at(store, slot, frame, std::uint32_t(drawn - before_[place])),
                      .of_all = of_all});
}

void ErrorMeter::begin(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                       double gravitational_constant)
{
    constant_ = gravitational_constant;
    probes_.clear();
    for (const Drawn& drawn : drawn_)
        probes_.push_back({.place = drawn.member.position,
                           .q = 0.5 * store.kind_softening_squared[drawn.member.kind],
                           .region = drawn.row});
    attracts_.clear();
    for (const Subtree& subtree : tree.subtrees)
        attracts_.push_back(constant_ > 0 ? subtree.settings.attracts : Attracts::Nothing);
    pulls_.begin(store, frame, probes_, attracts_);
    if (pulls_.done())
        finish(tree);
}

std::uint64_t ErrorMeter::advance(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                                  std::uint64_t pairs)
{
    if (idle())
        return 0;
    const std::uint64_t spent = pulls_.advance(store, pairs);
    if (!pulls_.done())
        return spent;
    finish(tree);
    if (frame < pulls_.frame() + late_frames / 2)
        at_once_ = std::min(2 * at_once_, most_draws); // the more at once, the less it costs to begin
    return spent;
}

void ErrorMeter::give_up_late(std::uint64_t frame)
{
    if (idle() || frame < pulls_.frame() + late_frames)
        return;
    pulls_.abandon();
    at_once_ = std::max(at_once_ / 4, 2U);
}

void ErrorMeter::forget()
{
    pulls_.abandon();
    all_.clear();
    of_region_.clear();
    fresh_.clear();
}

std::span<const ErrorSample> ErrorMeter::take_samples()
{
    taken_.swap(fresh_);
    fresh_.clear();
    return taken_;
}

void ErrorMeter::finish(const SlodTree& tree)
{
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
        const Vector3d exact = drawn_[i].rest + constant_ * pulls_.probes()[i].pull;
        const double error = (drawn_[i].given - exact).norm() / exact.norm();
        if (std::isfinite(error)) // else there is nothing to compare with
            take(drawn_[i], {pulls_.frame(), error}, tree);
    }
    if (fresh_.size() > window)
        fresh_.erase(fresh_.begin(), fresh_.end() - std::ptrdiff_t(window));
}

void ErrorMeter::take(const Drawn& drawn, const ErrorSample& sample, const SlodTree& tree)
{
    if (drawn.of_all) {
        all_.add(sample);
        fresh_.push_back(sample);
    }
    if (tree.regions[drawn.row].number != drawn.region)
        return; // the row is another region's by now
    OfRegion& region = of_region_[drawn.row];
    if (std::exchange(region.number, drawn.region) != drawn.region)
        region.errors.clear();
    region.errors.add(sample);
}

std::vector<RegionError> ErrorMeter::region_errors(const SlodTree& tree) const
{
    std::vector<RegionError> errors;
    for (std::size_t row = 0; row < of_region_.size(); ++row)
        if (of_region_[row].errors.size() > 0 && of_region_[row].number == tree.regions[row].number)
            errors.push_back({RegionRow(row), of_region_[row].errors.estimate()});
    return errors;
}

} // namespace slod
