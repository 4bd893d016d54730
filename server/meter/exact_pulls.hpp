#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cluster/forming.hpp"
#include "tree/region_index.hpp"
#include "tree/settings.hpp"

namespace slod {

/// A place at which the pull of all particles is asked for.
struct Probe {
    Vector3d place{0, 0, 0};
    double q = 0;           ///< half the squared softening of what is there
    RegionRow region = 0;   ///< that it is in
    Vector3d pull{0, 0, 0}; ///< acceleration / G, mass / length^2
};

/// What all particles, each mapped out of its cluster and with its own softening, exert on a few places: sums
/// in double over a picture of the clusters, as many at a time as the caller allows, so that the simulation
/// goes on meanwhile. A particle exerts nothing on its own place. All probes share one pass over the members:
/// O(particles times probes). The result does not depend on how the work was cut.
class ExactPulls {
public:
    static constexpr std::size_t most_probes = 64;

    /// Pairs of one block of work, at least, where there are so many.
    static constexpr std::uint64_t block_pairs = 65'536;

    void reserve(std::size_t clusters); ///< Provides memory for passes over so many.

    /// Begins a pass over the clusters as they are after `frame` frames. `attracts`: whom the particles of
    /// each region attract, by row. Members' rows must stay until it is done or abandoned.
    void begin(const ClusterStore& store, std::uint64_t frame, std::span<const Probe> probes,
               std::span<const Attracts> attracts);
    void abandon(); ///< what is under way

    bool done() const { return next_block_ == blocks_.size(); }
    std::uint64_t frame() const { return frame_; } ///< of the clusters

    /// Goes on by so many pairs of a particle and a probe, whole blocks of them; returns how many there were.
    std::uint64_t advance(const ClusterStore& store, std::uint64_t pairs);

    std::span<const Probe> probes() const { return probes_; } ///< once done, with their pulls

private:
    struct Block {
        std::uint32_t first, last; ///< of `pictures_`
        std::uint64_t particles;
        RegionRow region; ///< of all of them, where they attract their own region alone
        bool own_region;  ///< they do
    };

    static constexpr std::size_t most_blocks = 256; ///< summed up at a time

    void cut(const ClusterStore& store, std::span<const Attracts> attracts);
    void sum_up(const ClusterStore& store, std::size_t first, std::size_t last);
    void sum_up(const ClusterStore& store, const Block& block, std::span<Vector3d> sums) const;

    std::uint64_t frame_ = 0;
    std::vector<Probe> probes_;
    std::vector<ClusterPicture> pictures_;
    std::vector<std::uint32_t> slots_; ///< of the pictures
    std::vector<Block> blocks_;
    std::size_t next_block_ = 0;
    std::vector<Vector3d> sums_; ///< by block of those at a time, then probe
};

} // namespace slod
