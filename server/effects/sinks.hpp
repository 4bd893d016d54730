#pragma once

#include <vector>

#include "effects/sink_settings.hpp"

namespace slod {

/// The sinks of a scene, and who is in them. What is right on a face is in none.
class Sinks {
public:
    explicit Sinks(std::vector<SinkSettings> settings);

    /// Whether a particle there dies.
    bool hold(const Vector3d& position) const;

    /// Whether one dies on its straight way from one place, in no sink, to another.
    bool meet(const Vector3d& from, const Vector3d& to) const;

    /// Whether one may be flown through, from outside to outside.
    bool thin() const { return thin_; }

    /// Whether anything within `radius` of a place may be in one. Never false falsely.
    bool reach(const Vector3d& centre, double radius) const;

    /// How far outside of what a sink takes a place is, exactly; negative in it, by as much.
    using Distance = double (*)(const SinkSettings& settings, const Vector3d& position);

    /// Whether a straight way comes to the inside of its shape.
    using Crosses = bool (*)(const SinkSettings& settings, const Vector3d& from, const Vector3d& to);

private:
    std::vector<SinkSettings> all_; ///< normals of length 1
    bool thin_;
};

} // namespace slod
