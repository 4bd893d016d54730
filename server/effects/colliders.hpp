#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "effects/contact.hpp"
#include "effects/path.hpp"
#include "effects/sheet.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {

/// A plane between a place and a solid, all of which is on its far side. It moves with the solid.
struct Fence {
    Vector3d normal;   ///< away from the solid
    double height;     ///< of the place above it
    Vector3d velocity; ///< of the solid
    double near;       ///< who is so low above it may touch the solid
};

/// The fences of a place towards all pieces that it may be about to meet.
struct Fences {
    static constexpr std::size_t most = 16;

    std::array<Fence, most> all;
    std::size_t count = 0;
    bool complete = true; ///< there are no more than these
};

/// The solids of a scene, and how a particle fares among them.
class Colliders {
public:
    /// `step` is the time of one frame: impacts too small for it end in rest.
    Colliders(const std::vector<ColliderSettings>& settings, const UniformFields& fields, double step);

    /// Particles fly through other fields from here on.
    void set_fields(const UniformFields& fields);

    const UniformFields& fields() const { return fields_; }

    /// Flights end at this time from here on. Colliders are where the scene has them at 0; before the first
    /// call of this, the first frame's flights are meant.
    void set_frame_end(double time) { frame_end_ = time; }

    /// Whether anything within `reach` of a place that moves from `position` at `velocity` through `fields`
    /// may touch a solid within `time`, which is up to the frame's end. Never false falsely.
    bool may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                   const UniformFields& fields) const;
    bool may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time) const
    {
        return may_touch(position, velocity, reach, time, fields_);
    }

    /// Whether all within `reach` of such a place keeps clear of what bounds the solids: a quick answer that
    /// is never true falsely.
    bool clear_of_all(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                      const UniformFields& fields) const;

    /// Fences, as the flight begins, towards all that may_touch() is true for: what is within `reach` of the
    /// place and stays above each of them touches nothing.
    Fences fences(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                  const UniformFields& fields) const;

    /// The whole frame, under the drag of fields().
    const Elapsed& frame() const { return frame_; }

    /// What a particle met.
    struct Encounter {
        bool touched = false;
        std::uint32_t impacts = 0;
        bool cut_off = false; ///< it met more surfaces than a particle may at once
        bool killed = false;  ///< where it was, the flight has ended
    };

    /// Moves a particle by `time`, up to the frame's end, exactly from impact to impact, with `acceleration`
    /// besides that of the fields. Where it meets a surface for the `most_meetings`th time, or for the
    /// `most_slides`th without an impact, it stays on it until the time is over. One that starts inside a
    /// solid is put on its surface first, and gains no speed by that.
    Encounter fly(Vector3d& position, Vector3d& velocity, double time, const Vector3d& acceleration,
                  const UniformFields& fields) const;
    Encounter fly(Vector3d& position, Vector3d& velocity, double time,
                  const Vector3d& acceleration = {0, 0, 0}) const
    {
        return fly(position, velocity, time, acceleration, fields_);
    }

    static constexpr std::uint32_t most_meetings = 8;
    static constexpr std::uint32_t most_slides = 256;

private:
    struct Collider {
        std::unique_ptr<Solid> solid; ///< or else
        std::unique_ptr<Sheet> sheet;
        Box bounds;
        double restitution, friction;
        Vector3d velocity;
        bool moves; ///< it is not at rest
        OnHit on_hit;
    };

    /// Which piece is met, and when.
    struct Impact {
        Piece piece;
        double time;
    };

    /// How a particle goes on from where it is.
    struct Departure {
        Path path;
        bool bounces;
        bool stops;    ///< at the end of it, on what holds it
        Vector3d rest; ///< the velocity of that
        double pull;   ///< size of the acceleration before anything held it
    };

    /// How a particle that departs stands to a piece.
    struct Stance {
        bool held = false;    ///< it stays on it
        bool leaving = false; ///< it touches it, and goes away or along
    };

    Elapsed elapsed(double time, double drag) const
    {
        return time == step_ && drag == fields_.drag ? frame_ : Elapsed(drag, time);
    }
    Vector3d shift(const Collider& collider, double left) const
    {
        return (frame_end_ - left) * collider.velocity;
    }
    static double touching_distance(const Collider& collider, const Vector3d& position);
    static bool ends(const Contacts& contacts, bool met, double left, Vector3d& position, Vector3d& velocity,
                     Encounter& encounter);
    bool passes_all(const Path& path, const Elapsed& whole, double reach = 0) const;
    template <class Visit>
    bool any_about_to_touch(const Path& path, double reach, double time, const Visit& visit) const;
    Path seen_from(const Collider& collider, const Path& path, double left) const;
    Contact contact_with(const Piece& piece, const Solid& solid, const Vector3d& place) const;
    template <class Visit>
    bool any_piece(const Collider& collider, const Sweep& sweep, const Visit& visit) const;
    template <class Visit>
    void visit_piece(const Piece& piece, const Visit& visit) const;
    void touch(Vector3d& position, double left, std::optional<Piece> met, Contacts& contacts) const;
    Departure leave(Path path, const Elapsed& left, Contacts& contacts, Encounter& encounter) const;
    Stance stance(const Piece& piece, const Solid& solid, const Departure& departure, double left,
                  const Contacts& contacts) const;
    std::optional<Impact> next_impact(const Departure& departure, const Elapsed& limit,
                                      const Contacts& contacts) const;

    std::vector<Collider> all_;
    UniformFields fields_;
    double step_;
    double frame_end_;
    Elapsed frame_; ///< of one
};

} // namespace slod
