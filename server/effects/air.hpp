#pragma once

#include <memory>
#include <optional>

#include "cluster/forming.hpp"
#include "core/aligned.hpp"
#include "effects/fields/field_set.hpp"
#include "effects/quadratic_drag.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {

/// Air that moves, or resists, differently from place to place or from time to time. All drags and winds are
/// one: they give a cluster one rate and one velocity of the air, both at the middle of its frame, under
/// which it moves exactly; the terminal velocity is exact, the rest right to second order in the step.
class Air {
public:
    /// `fields` are what is the same everywhere; its wind blows besides the others.
    Air(const UniformFields& fields, const std::optional<QuadraticDragSettings>& quadratic,
        const FieldSettings& settings, const FieldSource& source, double step, Tick tick = {});

    /// Takes other uniform fields from here on.
    void set_uniform(const UniformFields& fields);

    /// Whether it is the same at every place, and resists in proportion to the velocity.
    bool uniform() const;

    /// Of uniform() air: the fields at a time, for so many clusters to move in.
    UniformFields at(double time, std::size_t clusters);

    /// What one particle or cluster feels, as if it were everywhere so.
    struct Felt {
        UniformFields fields;
        Vector3d middle{0, 0, 0}; ///< where the wind was asked for: half a straight flight on
        FieldValue wind{};        ///< there, the uniform one left out
        Vector3d drag_slope{0, 0, 0};
    };

    /// For a flight of `duration` from `start` on.
    Felt felt(const Vector3d& position, const Vector3d& velocity, double start, double duration) const;

    /// Asks for the winds that clusters feel through the frame after `frame`, each at the middle of its way,
    /// and counts those that a wind's boundary cuts as it begins.
    void ask(const ClusterStore& store, std::uint64_t frame);

    /// What a cluster that was asked for feels through that frame: as felt(), from the frame's start on.
    Felt felt_by_cluster(const ClusterTable& clusters, std::size_t slot) const;

    /// What a member of a cluster feels through a frame: the wind linearised about its cluster.
    UniformFields felt_by_member(const Felt& cluster, const Vector3d& position,
                                 const Vector3d& velocity) const;

    /// Mean acceleration over a frame from `start` on of what flies by itself from there.
    Vector3d mean_acceleration(const Vector3d& position, const Vector3d& velocity, double start) const;

    /// The difference to that of its cluster, which is there, that a member `away` from it and `faster` than
    /// it gets from the tangent of the cluster's flight.
    Vector3d tangent_acceleration(const Vector3d& position, const Vector3d& velocity, double start,
                                  const Vector3d& away, const Vector3d& faster) const;

    /// How far a member may come from its cluster's way in a frame, at most, from `radius` and `speed` of
    /// all.
    double spread(const Felt& cluster, double radius, double speed) const;

    /// Provides memory for so many clusters.
    void reserve(std::size_t slots) { winds_at_.reserve(slots); }

    /// Moves every cluster through the frame that was asked for, and its map by the tangent of that.
    void propagate(ClusterTable& clusters);

    /// Measures how fast winds deform clusters where they are: columns.strain. It moves nothing, and is not
    /// counted.
    void measure_strain(ClusterTable& clusters, double time);

    using Counts = FieldSet<AirFields>::Counts;
    /// Of the winds that clusters moved in since the last call of this.
    Counts take_counts() { return winds_->take_counts(); }
    auto take_times_ns() { return winds_->take_times_ns(); }

private:
    Felt felt_in(const FieldValue& wind, const Vector3d& velocity, double duration) const;
    Propagator propagator_of(const Felt& felt) const;
    Tangent tangent_of(const Felt& felt, const Propagator& flow, const Vector3d& velocity) const;
    void ask_winds(const ClusterTable& clusters, std::size_t first, std::size_t last, double ahead,
                   double time);
    double strain_of(const Felt& felt) const;

    UniformFields uniform_;
    double quadratic_ = 0; ///< 1 / length
    std::unique_ptr<FieldSet<AirFields>> winds_;
    double step_;
    Damping frame_;                      ///< of the linear drag
    AlignedVector<FieldValue> winds_at_; ///< by slot, as last asked for
};

} // namespace slod
