#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meter/error_window.hpp"
#include "meter/exact_pulls.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// What one region's members are off by.
struct RegionError {
    RegionRow row = background_row;
    ErrorEstimate error;
};

/// Measures what clusters and walks cost in accuracy while the simulation goes on: draws members at random
/// and compares the acceleration that each one's cluster gives it with the exact one: the pull of all
/// particles, each at its own place with its own softening, and all that else accelerates it where it is.
/// Half of the members are drawn among all, half, where there are several regions, among those of one region
/// after another. It changes nothing of the outcome.
class ErrorMeter {
public:
    static constexpr std::size_t window = 1024;       ///< samples that the estimate for all is made of
    static constexpr std::size_t region_window = 512; ///< and that for one region
    static constexpr std::uint32_t most_draws = ExactPulls::most_probes; ///< at once, for one pass
    static constexpr std::uint64_t late_frames = 96;                     ///< after which it is given up
    static constexpr std::size_t regions_at_once = 8;

    explicit ErrorMeter(std::uint64_t seed) : seed_(seed) {}

    /// A member that was drawn.
    struct Drawn {
        ClusterSlot slot;
        RegionRow row = background_row;
        std::uint64_t region = 0; ///< its number, as rows are used again
        Particle member;          ///< as it is
        bool of_all = false;      ///< drawn among all, or among its region's
        Vector3d given{0, 0, 0};  ///< acceleration by its cluster
        Vector3d rest{0, 0, 0};   ///< exact acceleration but for the particles' attraction
    };

    bool idle() const { return pulls_.done(); }

    void reserve(std::size_t clusters, std::size_t regions); ///< Provides memory for drawing among so many.

    /// Draws members. The caller fills in what they are given, and the rest.
    std::vector<Drawn>& draw(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame);

    /// Begins the sums for those that were drawn, of clusters as they are. Where the constant is 0 there is
    /// nothing to sum up.
    void begin(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
               double gravitational_constant);

    /// Goes on by so many pairs; returns how many were summed up.
    std::uint64_t advance(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame,
                          std::uint64_t pairs);

    /// Gives up sums that were begun too many frames before `frame`, as members' rows are kept for them; the
    /// next ones are for fewer members.
    void give_up_late(std::uint64_t frame);

    /// Forgets all samples, and gives up what is under way.
    void forget();

    /// Slabs that were retired before this frame are read no more; `next` where no sums are under way.
    std::uint64_t recyclable_before(std::uint64_t next) const { return idle() ? next : pulls_.frame(); }

    ErrorEstimate error() const { return all_.estimate(); }
    std::vector<RegionError>
    region_errors(const SlodTree& tree) const; ///< of those that there are samples of

    /// The errors of those drawn among all that have come since the last call of this, valid until the next;
    /// the oldest are left out where they are more than a window.
    std::span<const ErrorSample> take_samples();

private:
    struct OfRegion {
        std::uint64_t number = 0; ///< of the region's opening
        ErrorWindow errors{region_window};
    };

    void sort_by_region(const SlodTree& tree, const ClusterTable& clusters);
    void draw_of(const SlodTree& tree, const ClusterStore& store, std::uint64_t frame, std::uint64_t first,
                 std::uint64_t last, bool of_all);
    void finish(const SlodTree& tree);
    void take(const Drawn& drawn, const ErrorSample& sample, const SlodTree& tree);

    std::uint64_t seed_, draws_ = 0;
    std::uint32_t at_once_ = 16; ///< draws for one pass, as many as are done in time
    double constant_ = 0;
    std::size_t next_region_ = 0; ///< whose turn it is
    std::vector<Drawn> drawn_;
    std::vector<std::uint32_t> order_;      ///< slots by region
    std::vector<std::uint64_t> before_;     ///< particles before each in that order, and of all
    std::vector<std::size_t> region_first_; ///< in that order, by row, and the end
    std::vector<std::size_t> next_;         ///< place in it, by row
    std::vector<RegionRow> inhabited_;      ///< rows that hold particles
    std::vector<Probe> probes_;
    std::vector<Attracts> attracts_; ///< by row
    ExactPulls pulls_;
    ErrorWindow all_{window};
    std::vector<OfRegion> of_region_; ///< by row
    std::vector<ErrorSample> fresh_, taken_;
};

} // namespace slod
