#pragma once

#include "core/settings.hpp"
#include "tree/settings.hpp"

namespace slod {

/// What a controller turns to hold a frame rate (O'Brien et al. 2001, section 5.2): factors of what the scene
/// asks for, the same for every region. The default leaves the scene as it is.
struct Detail {
    double cluster_size = 1; ///< of max_cluster_size
    double breadth = 1;      ///< of max_breadth, and so of the grid cells' side
    double opening = 1;      ///< of gravity's force_tolerance; its root is one of opening_angle
    double life = 1;         ///< of motion.clock
    double least_size = 1;   ///< max_cluster_size is not made smaller than this, particles,
    double most_size = 1e6;  ///< nor larger than this; one that is beyond them already stays
    bool dithered = false;   ///< clusters split at sizes of their own: Subtree::split_size()

    friend bool operator==(const Detail&, const Detail&) = default;
};

/// The region's parameters at this detail. Its control_share is the exponent of the factors.
RegionSettings at_detail(const RegionSettings& region, const Detail& detail);

template <class Visitor>
void for_each_field(Detail& detail, Visitor&& visit)
{
    constexpr double least = 1e-6, most = 1e6;
    visit(Field{"cluster_size", "", "Factor of max_cluster_size.", least, most}, detail.cluster_size);
    visit(Field{"breadth", "", "Factor of max_breadth.", least, most}, detail.breadth);
    visit(Field{"opening", "", "Factor of gravity.force_tolerance.", least, most}, detail.opening);
    visit(Field{"life", "", "Factor of motion.clock.", least, most}, detail.life);
    visit(Field{"least_size", "particles", "max_cluster_size is not made smaller than this.", 1, most},
          detail.least_size);
    visit(Field{"most_size", "particles", "max_cluster_size is not made larger than this.", 1, most},
          detail.most_size);
    visit(Field{"dithered", "", "Clusters split at sizes of their own."}, detail.dithered);
}

} // namespace slod
