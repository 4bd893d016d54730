#include "view/colour_scale.hpp"

#include <algorithm>
#include <cmath>

#include "idl/colour_map.hpp"

namespace slod::view {

namespace {

std::uint32_t packed(const Colour& colour)
{
    constexpr std::uint32_t opaque = 0xff000000;
    return opaque | std::uint32_t(colour.blue) << 16 | std::uint32_t(colour.green) << 8 | colour.red;
}

/// The colours of even steps of the share.
constexpr std::size_t steps = 256;

const std::array<std::uint32_t, steps>& table()
{
    static const auto colours = [] {
        std::array<std::uint32_t, steps> made;
        for (std::size_t i = 0; i < steps; ++i)
            made[i] = colour_on_black(double(i) / double(steps - 1));
        return made;
    }();
    return colours;
}

/// A value at a share of the order; reorders them.
double quantile(std::vector<float>& values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace

double share_of(double value, const Range& range, bool logarithmic)
{
    double low = range.low, high = range.high;
    if (logarithmic) {
        if (!(value > 0))
            return 0;
        value = std::log(value);
        low = std::log(low);
        high = std::log(high);
    }
    const double share = (value - low) / (high - low);
    return share > 0 ? std::min(share, 1.0) : 0; // NaN is as 0
}

double value_at(double share, const Range& range, bool logarithmic)
{
    return logarithmic ? range.low * std::pow(range.high / range.low, share)
                       : std::lerp(range.low, range.high, share);
}

Range range_of(std::span<const float> values, bool logarithmic)
{
    constexpr std::size_t enough = 8192; // percentiles of so many are exact to half of a percent
    constexpr double left_out = 0.02;
    const std::size_t stride = 1 + values.size() / enough;
    std::vector<float> sample;
    sample.reserve(values.size() / stride + 1);
    for (std::size_t i = 0; i < values.size(); i += stride)
        if (std::isfinite(values[i]) && (!logarithmic || values[i] > 0))
            sample.push_back(values[i]);
    if (sample.empty())
        return {.low = logarithmic ? 0.1 : 0.0, .high = 1};
    Range range{.low = quantile(sample, left_out), .high = quantile(sample, 1 - left_out)};
    if (range.high > range.low)
        return range;
    const double width = range.low != 0 ? 0.1 * std::abs(range.low) : 1;
    return {.low = range.low - (logarithmic ? 0.5 * width : width), .high = range.high + width};
}

std::uint32_t colour_on_black(double share)
{
    constexpr double darkest = 0.25;
    return packed(colour_of(darkest + (1 - darkest) * share));
}

std::uint32_t region_colour(std::string_view region)
{
    constexpr Colour background{150, 170, 210};
    if (region == "background")
        return packed(background);
    static constexpr std::array<Colour, 7> colours{{{255, 150, 60},
                                                    {90, 210, 120},
                                                    {240, 110, 180},
                                                    {80, 200, 235},
                                                    {235, 215, 80},
                                                    {170, 130, 250},
                                                    {235, 95, 85}}};
    std::uint32_t hash = 2166136261; // FNV-1a
    for (const char letter : region)
        hash = (hash ^ std::uint8_t(letter)) * 16777619;
    return packed(colours[hash % colours.size()]);
}

void FormationAges::append(const client::ClusterFrame& frame, std::vector<float>& ages)
{
    std::swap(since_, previous_);
    since_.clear();
    for (const client::RegionClusters& region : frame.regions)
        for (const std::uint64_t formation : region.formation) {
            const auto known = previous_.find(formation);
            const double since = known != previous_.end() ? known->second : frame.time;
            since_.emplace(formation, since);
            ages.push_back(float(frame.time - since));
        }
}

void Colouring::measure(const client::ClusterFrame& frame, ColourBy by)
{
    values_.clear();
    if (by == ColourBy::Age)
        ages_.append(frame, values_);
    for (const client::RegionClusters& region : frame.regions) {
        if (by == ColourBy::Mass)
            values_.insert(values_.end(), region.mass.begin(), region.mass.end());
        if (by == ColourBy::Count)
            for (const std::uint32_t count : region.particles)
                values_.push_back(float(count));
        if (by == ColourBy::Speed)
            for (std::size_t i = 0; i < region.mass.size(); ++i) {
                const float* const v = &region.velocity[3 * i];
                values_.push_back(std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
            }
    }
}

std::span<const std::uint32_t> Colouring::colours(const client::ClusterFrame& frame, const ColourScale& scale)
{
    colours_.clear();
    if (scale.by == ColourBy::Region) {
        for (const client::RegionClusters& region : frame.regions)
            colours_.insert(colours_.end(), region.mass.size(), region_colour(region.region));
        return colours_;
    }
    measure(frame, scale.by);
    range_ = scale.automatic ? range_of(values_, scale.logarithmic) : Range{scale.low, scale.high};
    const auto& colour = table();
    for (const float value : values_)
        colours_.push_back(
            colour[std::size_t(share_of(value, range_, scale.logarithmic) * double(steps - 1) + 0.5)]);
    return colours_;
}

} // namespace slod::view
