#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/vectors.hpp"
#include "effects/collider_settings.hpp"

namespace slod {

/// A collider, or one plate of it.
struct Piece {
    std::uint32_t collider, plate = 0;

    friend bool operator==(const Piece&, const Piece&) = default;
};

/// A piece that a particle touches.
struct Contact {
    Piece piece;
    Vector3d normal; ///< away from the solid
    double restitution, friction;
    double slack = 1e-14;       ///< the angle that the normal may be off by
    Vector3d velocity{0, 0, 0}; ///< of the collider
    OnHit on_hit = OnHit::Bounce;
    bool holds = false; ///< the particle stays on it

    /// Whether a particle leaves it or moves along it, as far as rounding can tell.
    bool leaves(const Vector3d& v) const
    {
        const Vector3d relative = v - velocity;
        return normal.dot(relative) >= -slack * relative.norm();
    }
};

/// Pieces that one particle touches at a time; those beyond the bound are met in the next moment.
class Contacts {
public:
    static constexpr std::size_t most = 16;

    void clear() { count_ = 0; }
    void add(const Contact& contact)
    {
        if (count_ < most)
            all_[count_++] = contact;
    }
    std::span<Contact> all() { return std::span(all_).first(count_); }
    std::span<const Contact> all() const { return std::span(all_).first(count_); }
    const Contact* find(const Piece& piece) const; ///< null when it is not touched
    const Contact* find(OnHit on_hit) const;       ///< the first of a collider that does so; null without

private:
    std::array<Contact, most> all_;
    std::size_t count_ = 0;
};

/// An impact, when the particle approaches, as who moves with the collider sees it: the normal velocity is
/// turned round and shrunk by the restitution, or to 0 when no more than `rest_speed` would be left; the
/// tangential one is slowed by the impulse of Coulomb friction, until it stops. Returns whether it was more
/// than the end of a rest.
bool bounce(const Contact& contact, double rest_speed, Vector3d& velocity);

/// What holds a particle on the surfaces that it touches slower than it could leave them.
struct Hold {
    Vector3d frame;                  ///< velocity of the surfaces together
    Vector3d velocity, acceleration; ///< along the surfaces, as seen at that velocity
    double pressing = 0;             ///< acceleration that they take up
    double friction = 0;             ///< the largest of theirs
};

/// The acceleration nearest to `acceleration`, which is of what is at rest and under `drag`, that leads into
/// none of the contacts, unless it is away from one at a normal speed that is more than the pull back to it
/// gives in `rest_time`. Those that it needs for that hold, as do those that are along them, and the velocity
/// keeps to them.
Hold hold(std::span<Contact> contacts, double rest_time, const Vector3d& velocity,
          const Vector3d& acceleration, double drag);

} // namespace slod
