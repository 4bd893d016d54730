#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "common/frame_assembler.hpp"

namespace slod::view {

/// What the colour of a cluster says.
enum class ColourBy : std::uint8_t {
    Speed,  ///< scene length / time
    Mass,   ///< scene mass
    Count,  ///< particles
    Region, ///< of interest, each with a colour of its own
    Age,    ///< scene time since the cluster was first seen as it is: until then it was formed anew
};

constexpr std::array<std::string_view, 5> names(ColourBy)
{
    return {"speed", "mass", "count", "region", "age"};
}

/// How values become colours.
struct ColourScale {
    ColourBy by = ColourBy::Speed;
    bool logarithmic = false;
    bool automatic = true;    ///< the range follows the values
    double low = 0, high = 1; ///< the range otherwise
};

/// The values that the two ends of the colours stand for.
struct Range {
    double low = 0;
    double high = 1;
};

/// Where in the range a value is, in [0, 1]. On a logarithmic scale what is not above 0 is at the low end.
double share_of(double value, const Range& range, bool logarithmic);

/// The value of a share: what share_of() turns back.
double value_at(double share, const Range& range, bool logarithmic);

/// From the second to the 98th percentile of the values (of those above 0 on a logarithmic scale), so that
/// single outliers do not take the colours from all others; widened when it would be empty.
Range range_of(std::span<const float> values, bool logarithmic);

/// The colour of a share on black, as bytes red, green, blue, 255: the map of idl/colour_map without its
/// darkest part, which could not be seen.
std::uint32_t colour_on_black(double share);

/// The colour of a region, by its name: the same in every frame and viewer. Few of many may share one.
std::uint32_t region_colour(std::string_view region);

/// Remembers since when each cluster is there unchanged.
class FormationAges {
public:
    /// Appends the age of each cluster of a frame, in order. What is not in the frame is forgotten.
    void append(const client::ClusterFrame& frame, std::vector<float>& ages);

private:
    std::unordered_map<std::uint64_t, double> since_, previous_; ///< scene time by formation
};

/// Colours the clusters of frames. Keeps its memory from frame to frame.
class Colouring {
public:
    /// A colour for each cluster of the frame, in order.
    std::span<const std::uint32_t> colours(const client::ClusterFrame& frame, const ColourScale& scale);

    /// What the last colours' ends stand for.
    const Range& range() const { return range_; }

private:
    void measure(const client::ClusterFrame& frame, ColourBy by);

    FormationAges ages_;
    std::vector<float> values_;
    std::vector<std::uint32_t> colours_;
    Range range_;
};

} // namespace slod::view
