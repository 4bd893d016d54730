#pragma once

#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "tree/region_index.hpp"

namespace slod::test {

/// What random_region() may draw from.
struct RegionDraw {
    double extent = 10;     ///< centres lie within so far of the origin along each axis
    double size = 3;        ///< largest half extent, radius and depth
    bool everywhere = true; ///< some regions are everywhere
    bool by_mass = false;   ///< some ask for a range of masses
    bool by_motion = false; ///< some ask for ranges of speed or acceleration
};

/// A sound region of any shape, also of no size, with precedence -2 to 2.
RegionOfInterest random_region(Random& random, const RegionDraw& draw);

/// A point within `extent` of the origin along each axis.
Vector3d random_point(Random& random, double extent);

/// Row of the region that takes the subject, by asking each in turn.
RegionRow region_by_turns(const std::vector<RegionIndex::Entry>& in_order, const Subject& subject);

} // namespace slod::test
