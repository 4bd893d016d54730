#pragma once

#include <optional>
#include <vector>

#include "app/publisher.hpp"
#include "idl/messages.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// Turns a frame's counts and times into a message. Keeps its memory.
class StatsEncoder {
public:
    explicit StatsEncoder(const wire::Uuid& session);

    /// Takes over conserved quantities, if they were measured: they hold until the next time. Of a frame that
    /// is not encoded. NaN: the potential energy was not.
    void set_conserved(const ConservedQuantities& now, double potential_energy);

    /// The clusters of `snapshot` are not looked at. The message is valid until the next call.
    const wire::Stats& encode(const Snapshot& snapshot, const LoopStats& loop,
                              const wire::PublisherCounts& published);

private:
    void encode_phases(const StepProfile& profile);
    void encode_control(const ControlReport& regulation, const Detail& detail);
    void encode_counts(const FrameCounts& counts);

    std::vector<slod_v1_PhaseTime> phases_;
    std::vector<slod_v1_NamedCount> counts_;
    std::optional<ConservedQuantities> first_conserved_;
    double first_potential_energy_ = 0; ///< with those; NaN: it was not measured then
    wire::Stats message_{};
};

} // namespace slod
