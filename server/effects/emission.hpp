#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/emitter.hpp"
#include "effects/sinks.hpp"
#include "tree/grouping.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Brings newborn particles into clusters of their own: an emitter's particles fill one open cluster, its
/// cohort, through the inverse flow map until that is full; many at once are divided by where they will be
/// in the middle of their lives. In regions whose rule it is, a cluster moves at its first particle's
/// velocity (O'Brien et al. 2001, section 5.1).
class Emission {
public:
    /// `mid_life` is the time ahead at which particles without a finite lifetime are grouped. `colliders`,
    /// `air` and `sinks` (null: there are none) are the caller's and outlive this.
    Emission(std::vector<Emitter> emitters, const UniformFields& fields, double mid_life,
             const Colliders* colliders = nullptr, const Air* air = nullptr, const Sinks* sinks = nullptr);

    /// Newborns fly through other fields from here on.
    void set_fields(const UniformFields& fields) { surroundings_.fields = fields; }

    /// A cluster formed in this frame, and the mean age of its members at the frame's end.
    struct NewCluster {
        ClusterId id;
        double age;
    };

    struct Births {
        std::uint64_t born = 0;
        std::uint64_t refused = 0; ///< there was no room for
    };

    /// Emits frame `context.frame`, `room` particles at most; the later ones of a frame are refused. Left
    /// out, but counted as long as there is room, are those that end within it or come into a sink. Where a
    /// kick of the length `closing_kick` follows, particles that join a cohort get its acceleration for their
    /// own time only.
    Births update(SlodTree& tree, const UpdateContext& context, double closing_kick, std::uint64_t room);

    const std::vector<NewCluster>& new_clusters() const { return new_clusters_; } ///< of the last update

    /// The open cluster of each emitter; invalid, or of a cluster that has ended, where it has none.
    std::span<const ClusterId> cohorts() const { return cohorts_; }

    /// Particles each emitter has started before `time`: the state of the random numbers.
    std::vector<std::uint64_t> counts_before(double time) const;

private:
    /// What an emitter starts in a frame, and where among the newborns that is.
    struct Brood {
        Emitter::Starts starts;
        std::size_t first = 0, count = 0;
    };

    Births write_newborns(const UpdateContext& context, std::uint64_t room);
    bool write_newborns(std::size_t emitter, std::size_t begin, std::span<Newborn> newborns);
    void leave_out_dead(std::uint64_t frame);
    std::size_t join_cohort(SlodTree& tree, std::size_t emitter, const UpdateContext& context,
                            double closing_kick);
    void gather(const SlodTree& tree, std::size_t emitter, std::size_t joined);
    void found(SlodTree& tree, const UpdateContext& context);
    void note_new_clusters(const SlodTree& tree, const Grouping::Group& group, ClusterTable& clusters);

    std::vector<Emitter> emitters_;
    Surroundings surroundings_;
    double mid_life_;
    const Sinks* sinks_;
    std::vector<ClusterId> cohorts_;    ///< by emitter
    std::vector<Brood> broods_;         ///< by emitter
    Grouping grouping_;                 ///< all newborns; in its order those who found clusters
    std::vector<double> ages_;          ///< by newborn
    std::vector<std::size_t> founders_; ///< the emitter of each group
    std::vector<NewCluster> new_clusters_;
};

} // namespace slod
