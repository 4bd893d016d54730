#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "core/settings.hpp"

namespace slod {

/// A physical quantity by which a grid is divided before it is by place.
enum class BinBy : std::uint8_t { None, Mass, Speed, Acceleration };

constexpr std::array<std::string_view, 4> names(BinBy)
{
    return {"none", "mass", "speed", "acceleration"};
}

/// What velocities are relative to when they are compared before a merge.
enum class VelocityReference : std::uint8_t {
    Surroundings, ///< the mean of the region's clusters, so that a boost of the scene changes no merge
    Rest,         ///< the scene's axes, as in the paper
};

constexpr std::array<std::string_view, 2> names(VelocityReference)
{
    return {"surroundings", "rest"};
}

/// The velocity of a cluster that newborns join in an emitter's region (section 5.1).
enum class ClusterVelocity : std::uint8_t {
    Mean,  ///< of its particles, by mass
    First, ///< of its first particle: means of many would leave a stream too narrow
};

constexpr std::array<std::string_view, 2> names(ClusterVelocity)
{
    return {"mean", "first"};
}

/// Whom a region's bodies attract by gravity: light regions can be left out as sources.
enum class Attracts : std::uint8_t {
    Everything,
    OwnRegion, ///< the bodies of the region itself alone
    Nothing,
};

constexpr std::array<std::string_view, 3> names(Attracts)
{
    return {"everything", "own_region", "nothing"};
}

/// Bins of a quantity above the one below the floor: the last has no end.
inline constexpr std::int32_t most_bins = 64;

/// The partitioning parameters of one region of interest (O'Brien et al. 2001, section 4.1).
struct RegionSettings {
    double max_cluster_size = 64; ///< particles per cluster; real-valued, floored when used
    double max_breadth = std::numeric_limits<double>::infinity(); ///< diameter of a cluster, scene length
    double pool_factor = 4; ///< particles re-formed together, in cluster sizes
    /// How far a controller may change the size and breadth: the exponent of its factors. 0: not at all.
    double control_share = 1;
    double speed_ratio = 2; ///< largest ratio of speeds that may merge (lambda)
    double angle_deg = 30;  ///< largest angle between velocities that may merge (theta)
    double speed_floor = 0; ///< below it speeds and directions are not compared, scene length / time
    VelocityReference velocity_reference = VelocityReference::Surroundings;
    /// How far members of a cluster in rigid motion may have gone their own ways before it is split: the
    /// largest relative velocity times the age, scene length.
    double drift_limit = std::numeric_limits<double>::infinity();
    Attracts attracts = Attracts::Everything; ///< by gravity
    ClusterVelocity cluster_velocity = ClusterVelocity::Mean;
    BinBy bin_by = BinBy::None; ///< what a cluster's particles are alike in (section 3.3)
    double bin_floor = 1;       ///< of that quantity: all below it share one bin
    double bin_ratio = 2;       ///< largest to smallest in each of the others but the last, most_bins

    friend bool operator==(const RegionSettings&, const RegionSettings&) = default;
};

template <class Visitor>
void for_each_field(RegionSettings& region, Visitor&& visit)
{
    visit(Field{"max_cluster_size", "particles", "Largest number of particles that share a cluster.", 1, 1e6},
          region.max_cluster_size);
    visit(Field{"max_breadth", "length", "Largest diameter of a cluster, and of a grid cell.", 1e-30,
                no_maximum, true},
          region.max_breadth);
    visit(Field{"pool_factor", "", "Particles that are re-formed together, in units of max_cluster_size.", 1,
                64},
          region.pool_factor);
    visit(Field{"control_share", "",
                "How far the frame rate controller may change the two sizes: 0 not at all, 1 in full.", 0, 1},
          region.control_share);
    visit(Field{"speed_ratio", "", "Clusters merge only below this ratio of speeds.", 1, 1e6},
          region.speed_ratio);
    visit(Field{"angle", "deg", "Clusters merge only below this angle between velocities.", 0, 180},
          region.angle_deg);
    visit(Field{"speed_floor", "length/time", "Clusters slower than this merge whatever their directions.", 0,
                no_maximum},
          region.speed_floor);
    visit(Field{"velocity_reference", "", "What velocities are relative to when they are compared."},
          region.velocity_reference);
    visit(Field{"drift_limit", "length",
                "Members of a cluster in rigid motion may have drifted so far by their own velocities.", 0,
                no_maximum, true},
          region.drift_limit);
    visit(Field{"cluster_velocity", "", "Of clusters that newborns join; those that leave take the mean."},
          region.cluster_velocity);
    visit(Field{"attracts", "", "Whom the region's particles attract by gravity."}, region.attracts);
    visit(Field{"bin_by", "", "A quantity in which the particles of a cluster are alike: it divides first."},
          region.bin_by);
    visit(Field{"bin_floor", "", "All below it, in the unit of the quantity, share one bin.", 1e-30, 1e30},
          region.bin_floor);
    visit(Field{"bin_ratio", "",
                "Largest to smallest value within a bin; the 64th above the floor has no end.", 1.01, 1e6},
          region.bin_ratio);
}

} // namespace slod
