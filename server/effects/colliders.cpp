#include "effects/colliders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace slod {
namespace {

/// Speed at which a particle comes to rest on a surface, in units of what pulls it there times the frame:
/// flights that take a fifth of a frame. Four or five of them fit into one.
constexpr double rest_of_pull = 0.1;

bool meet(const Box& a, const Box& b, double reach)
{
    return (a.lower.array() - reach <= b.upper.array()).all() &&
           (b.lower.array() <= a.upper.array() + reach).all();
}

/// Lets friction act on what slides: a constant deceleration that is no more than the surfaces' grip, and
/// just enough to end in rest where that suffices. Returns whether it does.
bool brake(const Hold& held, const Elapsed& left, Path& path)
{
    const double grip = held.friction * held.pressing;
    if (grip <= 0 || left.drift <= 0)
        return false;
    const Vector3d final = path.velocity_after(left);
    const double speed = final.norm();
    if (speed > grip * left.drift) {
        path.acceleration -= (grip / speed) * final;
        return false;
    }
    path.acceleration = -(left.decay / left.drift) * path.velocity;
    return true;
}

/// Whether a particle that touches the surface leaves it or moves along it, as far as rounding can tell.
bool leaves(const Contact& contact, const Vector3d& velocity)
{
    return contact.normal.dot(velocity) >= -1e-14 * velocity.norm();
}

} // namespace

Colliders::Colliders(const std::vector<ColliderSettings>& settings, const UniformFields& fields, double step)
    : step_(step)
{
    set_fields(fields);
    for (const ColliderSettings& each : settings) {
        std::unique_ptr<Solid> solid = make_solid(each);
        const Box bounds = solid->bounds();
        all_.push_back({std::move(solid), bounds, each.restitution, each.friction});
    }
}

void Colliders::set_fields(const UniformFields& fields)
{
    fields_ = fields;
    frame_ = Elapsed(fields.drag, step_);
}

bool Colliders::may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                          const UniformFields& fields) const
{
    const Path path{position, velocity, fields.acceleration(), fields.drag};
    const Elapsed whole = elapsed(time, fields.drag);
    const Box way = path.bounds(whole);
    return std::any_of(all_.begin(), all_.end(), [&](const Collider& collider) {
        return meet(way, collider.bounds, reach + contact_tolerance(position)) &&
               first_contact(path, *collider.solid, reach, whole, false) <= time;
    });
}

Colliders::Encounter Colliders::fly(Vector3d& position, Vector3d& velocity, double time,
                                    const Vector3d& acceleration, const UniformFields& fields) const
{
    const Vector3d pull = fields.acceleration() + acceleration;
    Encounter encounter;
    Contacts contacts;
    std::optional<std::uint32_t> met;
    for (std::uint32_t meetings = 0;; ++meetings) {
        touch(position, met, contacts);
        if (meetings == most_meetings) {
            velocity.setZero();
            encounter.cut_off = true;
            return encounter;
        }
        const Elapsed left = elapsed(time, fields.drag);
        const Departure departure = leave({position, velocity, pull, fields.drag}, left, contacts, encounter);
        const std::optional<Impact> impact = next_impact(departure.path, left, contacts);
        encounter.touched = encounter.touched || impact || !contacts.all().empty();
        const Elapsed flown = impact ? elapsed(impact->time, fields.drag) : left;
        position = departure.path.position_after(flown);
        velocity = departure.path.velocity_after(flown);
        if (!impact) {
            if (departure.stops)
                velocity.setZero();
            return encounter;
        }
        time -= flown.time;
        met = impact->collider;
    }
}

/// Finds what the particle touches at its place, the solid that it has just met in any case, and puts it onto
/// the surface where rounding, or the scene, has it inside. Where solids overlap that takes some turns.
void Colliders::touch(Vector3d& position, std::optional<std::uint32_t> met, Contacts& contacts) const
{
    constexpr int turns = 4;
    const double tolerance = contact_tolerance(position);
    bool moved = true;
    for (int turn = 0; moved && turn < turns; ++turn) {
        moved = false;
        contacts.clear();
        for (std::uint32_t i = 0; i < all_.size(); ++i) {
            const Collider& collider = all_[i];
            if (met != i && !meet({position, position}, collider.bounds, tolerance))
                continue;
            const Surface surface = collider.solid->surface(position);
            if (met != i && surface.distance > tolerance)
                continue;
            contacts.add({i, surface.normal, collider.restitution, collider.friction});
            if (std::abs(surface.distance) > tolerance) {
                position -= surface.distance * surface.normal;
                moved = true;
            }
        }
    }
}

/// Bounces off what the particle touches, and starts its flight, or its slide along what holds it.
Colliders::Departure Colliders::leave(Path path, const Elapsed& left, Contacts& contacts,
                                      Encounter& encounter) const
{
    if (contacts.all().empty())
        return {path, false};
    std::array<double, Contacts::most> rest_speed{};
    std::size_t touched = 0;
    for (const Contact& contact : contacts.all()) {
        const double pull = std::max(0.0, -contact.normal.dot(path.acceleration));
        rest_speed[touched] = rest_of_pull * pull * step_;
        encounter.impacts += bounce(contact, rest_speed[touched], path.velocity) ? 1 : 0;
        ++touched;
    }
    const Hold held = hold(contacts.all(), rest_speed, path.velocity, path.acceleration);
    path.velocity = held.velocity;
    path.acceleration = held.acceleration;
    const bool stops = brake(held, left, path);
    return {path, stops};
}

/// The earliest one; of several at once that of the first collider.
std::optional<Colliders::Impact> Colliders::next_impact(const Path& path, const Elapsed& limit,
                                                        const Contacts& contacts) const
{
    std::optional<Impact> next;
    Elapsed latest = limit;
    const Box way = path.bounds(limit);
    const double tolerance = contact_tolerance(path.position);
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        const Contact* const contact = contacts.find(i);
        if ((contact != nullptr && contact->holds) || !meet(way, all_[i].bounds, tolerance))
            continue;
        const bool leaving = contact != nullptr && leaves(*contact, path.velocity);
        const double time = first_contact(path, *all_[i].solid, 0, latest, leaving);
        if (time < (next ? next->time : never)) {
            next = {i, time};
            latest = Elapsed(path.drag, time);
        }
    }
    return next;
}

} // namespace slod
