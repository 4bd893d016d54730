#pragma once

#include "cluster/forming.hpp"
#include "core/aligned.hpp"
#include "effects/fields/field_set.hpp"

namespace slod {

/// Accelerations that depend on the place, and their gradients, at the clusters' centres. They are evaluated
/// into arrays of their own, so that gravity may be evaluated at the same time.
class FieldForces {
public:
    /// `gravity`: the clusters attract each other too.
    FieldForces(const FieldSettings& settings, const FieldSource& source, bool gravity, Tick tick = {});

    /// Provides memory for so many clusters.
    void reserve(std::size_t slots);

    /// Of all fields together, at one place.
    FieldValue at(const Vector3d& x, double time) const { return fields_.at(x, time); }

    /// Evaluates all fields for all clusters at `time`, in frame `frame`.
    void evaluate(const ClusterStore& store, std::uint64_t frame, double time);

    /// Adds what was evaluated to the table's accelerations and gradients. Without gravity it is all there
    /// is, and its size is the clusters' pull.
    void add_to(ClusterTable& clusters) const;

    /// Energy of all particles in the fields that have a potential, to second order about their clusters'
    /// centres, as members move by the flow's first.
    double potential_energy(const ClusterStore& store, std::uint64_t frame) const;

    using Counts = FieldSet<ForceFields>::Counts;
    Counts take_counts() { return fields_.take_counts(); }
    auto take_times_ns() { return fields_.take_times_ns(); }

private:
    FieldSet<ForceFields> fields_;
    bool gravity_;
    AlignedVector<FieldValue> values_; ///< by slot
};

} // namespace slod
