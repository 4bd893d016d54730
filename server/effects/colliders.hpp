#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "effects/contact.hpp"
#include "effects/path.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {

/// The solids of a scene, and how a particle fares among them.
class Colliders {
public:
    /// `step` is the time of one frame: impacts too small for it end in rest.
    Colliders(const std::vector<ColliderSettings>& settings, const UniformFields& fields, double step);

    /// Particles fly through other fields from here on.
    void set_fields(const UniformFields& fields);

    const UniformFields& fields() const { return fields_; }

    /// Whether anything within `reach` of a place that moves from `position` at `velocity` through `fields`
    /// may touch a solid within `time`. Never false falsely.
    bool may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                   const UniformFields& fields) const;
    bool may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time) const
    {
        return may_touch(position, velocity, reach, time, fields_);
    }

    /// What a particle met.
    struct Encounter {
        bool touched = false;
        std::uint32_t impacts = 0;
        bool cut_off = false; ///< it met more surfaces than a particle may at once
    };

    /// Moves a particle by `time`, exactly from impact to impact, with `acceleration` besides that of the
    /// fields. Where it meets a surface for the `most_meetings`th time it stays, at rest, until the time is
    /// over. One that starts inside a solid is put on its surface first, and gains no speed by that.
    Encounter fly(Vector3d& position, Vector3d& velocity, double time, const Vector3d& acceleration,
                  const UniformFields& fields) const;
    Encounter fly(Vector3d& position, Vector3d& velocity, double time,
                  const Vector3d& acceleration = {0, 0, 0}) const
    {
        return fly(position, velocity, time, acceleration, fields_);
    }

    static constexpr std::uint32_t most_meetings = 8;

private:
    struct Collider {
        std::unique_ptr<Solid> solid;
        Box bounds;
        double restitution, friction;
    };

    /// Which solid is met, and when.
    struct Impact {
        std::uint32_t collider;
        double time;
    };

    /// How a particle goes on from where it is.
    struct Departure {
        Path path;
        bool stops; ///< at the end of it
    };

    Elapsed elapsed(double time, double drag) const
    {
        return time == step_ && drag == fields_.drag ? frame_ : Elapsed(drag, time);
    }
    void touch(Vector3d& position, std::optional<std::uint32_t> met, Contacts& contacts) const;
    Departure leave(Path path, const Elapsed& left, Contacts& contacts, Encounter& encounter) const;
    std::optional<Impact> next_impact(const Path& path, const Elapsed& limit, const Contacts& contacts) const;

    std::vector<Collider> all_;
    UniformFields fields_;
    double step_;
    Elapsed frame_; ///< of one
};

} // namespace slod
