#pragma once

#include <array>
#include <cmath>
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

    /// Whether a particle of that velocity stays along it under an acceleration that is seen by who moves
    /// with it, as far as rounding of one of that size can tell.
    bool keeps(const Vector3d& v, const Vector3d& acceleration, double size) const
    {
        const Vector3d relative = v - velocity;
        return std::abs(normal.dot(relative)) <= slack * relative.norm() &&
               std::abs(normal.dot(acceleration)) <= slack * size;
    }
};

/// Pieces that one particle touches at a time. Of more than the bound, as at a vertex that many triangles
/// share, those stay that differ the most, and the last one in any case: the others lead nowhere new.
class Contacts {
public:
    static constexpr std::size_t most = 16;

    void clear() { count_ = 0; }
    void add(const Contact& contact);
    bool full() const { return count_ == most; } ///< so that others may be touched besides
    std::span<Contact> all() { return std::span(all_).first(count_); }
    std::span<const Contact> all() const { return std::span(all_).first(count_); }
    const Contact* find(const Piece& piece) const; ///< null when it is not touched
    const Contact* find(OnHit on_hit) const;       ///< the first of a collider that does so; null without

private:
    std::size_t most_alike(const Contact& next) const;

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
