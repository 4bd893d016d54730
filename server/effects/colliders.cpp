#include "effects/colliders.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slod {
namespace {

/// Speed at which a particle comes to rest on a surface, in units of what pulls it there times the frame:
/// flights that take a fifth of a frame. Four or five of them fit into one.
constexpr double rest_of_pull = 0.1;

/// What is so near to a collider that holds it for good is on it, by the largest coordinate: members of a
/// cluster are held as floats, some 6e-8 of its size off, and would come loose.
constexpr double clinging = 1e-6;

bool meet(const Box& a, const Box& b)
{
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

/// Whether anything within `near` of the first box may be in the second one.
bool meet(const Box& a, double near, const Box& b)
{
    for (int axis = 0; axis < 3; ++axis)
        if (a.lower[axis] - near > b.upper[axis] || a.upper[axis] + near < b.lower[axis])
            return false;
    return true;
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

} // namespace

Colliders::Colliders(const std::vector<ColliderSettings>& settings, const UniformFields& fields, double step)
    : step_(step), frame_end_(step)
{
    set_fields(fields);
    for (const ColliderSettings& each : settings) {
        std::unique_ptr<Solid> solid = make_solid(each);
        std::unique_ptr<Sheet> sheet = solid ? nullptr : make_sheet(each);
        const Box bounds = solid ? solid->bounds() : sheet->bounds();
        all_.push_back({std::move(solid), std::move(sheet), bounds, each.restitution, each.friction,
                        each.velocity, !each.velocity.isZero(0), each.on_hit});
    }
}

void Colliders::set_fields(const UniformFields& fields)
{
    fields_ = fields;
    frame_ = Elapsed(fields.drag, step_);
}

double Colliders::touching_distance(const Collider& collider, const Vector3d& position)
{
    return collider.on_hit == OnHit::Stick ? clinging * position.cwiseAbs().maxCoeff()
                                           : contact_tolerance(position);
}

/// Whether the flight is over on what it has come to: the particle dies, or is carried along for the time
/// that is left.
bool Colliders::ends(const Contacts& contacts, bool met, double left, Vector3d& position, Vector3d& velocity,
                     Encounter& encounter)
{
    encounter.killed = contacts.find(OnHit::Kill) != nullptr;
    const Contact* const holder = contacts.find(OnHit::Stick);
    if (!encounter.killed && holder == nullptr)
        return false;
    encounter.touched = true;
    encounter.impacts += met || encounter.killed ? 1 : 0;
    if (encounter.killed)
        return true;
    velocity = holder->velocity;
    position += left * velocity;
    return true;
}

/// As it is for who moves with the collider and has its place at time 0, so long before the frame's end.
Path Colliders::seen_from(const Collider& collider, const Path& path, double left) const
{
    return {path.position - shift(collider, left), path.velocity - collider.velocity,
            path.acceleration - path.drag * collider.velocity, path.drag};
}

/// Whether the whole flight of all within `reach` is clear of what bounds the colliders, as most are: the
/// answer costs a fraction of the search for the first impact.
bool Colliders::passes_all(const Path& path, const Elapsed& whole, double reach) const
{
    const Box way = path.bounds(whole);
    return std::none_of(all_.begin(), all_.end(), [&](const Collider& collider) {
        const double near = touching_distance(collider, path.position) + reach;
        return collider.moves
                   ? meet(seen_from(collider, path, whole.time).bounds(whole), near, collider.bounds)
                   : meet(way, near, collider.bounds);
    });
}

/// Calls visit(piece, its solid) for each that the sweep may meet until it returns true; returns whether it
/// did.
template <class Visit>
bool Colliders::any_piece(const Collider& collider, const Sweep& sweep, const Visit& visit) const
{
    if (!meet(sweep.bounds(), collider.bounds))
        return false;
    const auto index = std::uint32_t(&collider - all_.data());
    if (collider.solid)
        return visit(Piece{index}, *collider.solid);
    return collider.sheet->any(sweep, [&](std::uint32_t plate) {
        return visit(Piece{index, plate}, Plate(*collider.sheet, plate));
    });
}

template <class Visit>
void Colliders::visit_piece(const Piece& piece, const Visit& visit) const
{
    const Collider& collider = all_[piece.collider];
    if (collider.solid)
        visit(piece, *collider.solid);
    else
        visit(piece, Plate(*collider.sheet, piece.plate));
}

/// Calls visit(collider, piece's solid, path as seen from there) for each piece that anything within `reach`
/// of the path may touch within `time`, until it returns true; returns whether it did.
template <class Visit>
bool Colliders::any_about_to_touch(const Path& path, double reach, double time, const Visit& visit) const
{
    const Elapsed whole = elapsed(time, path.drag);
    return std::any_of(all_.begin(), all_.end(), [&](const Collider& collider) {
        const Path seen = seen_from(collider, path, time);
        const double near = touching_distance(collider, path.position);
        const double within = collider.on_hit == OnHit::Stick ? reach + near : reach;
        return any_piece(collider, seen.sweep(whole, reach + near), [&](const Piece&, const Solid& solid) {
            return first_contact(seen, solid, within, whole, false) <= time && visit(collider, solid, seen);
        });
    });
}

bool Colliders::may_touch(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                          const UniformFields& fields) const
{
    return any_about_to_touch({position, velocity, fields.acceleration(), fields.drag}, reach, time,
                              [](const Collider&, const Solid&, const Path&) { return true; });
}

bool Colliders::clear_of_all(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                             const UniformFields& fields) const
{
    return passes_all({position, velocity, fields.acceleration(), fields.drag}, elapsed(time, fields.drag),
                      reach);
}

/// The plane across the way to the nearest point of a convex solid has all of it on the far side, also where
/// the place is inside and that is the way out.
Fences Colliders::fences(const Vector3d& position, const Vector3d& velocity, double reach, double time,
                         const UniformFields& fields) const
{
    Fences fences;
    const Vector3d farthest = position.cwiseAbs().array() + reach;
    const auto put_up = [&](const Collider& collider, const Solid& solid, const Path& seen) {
        fences.complete = fences.count < Fences::most;
        if (!fences.complete)
            return true;
        const Surface surface = solid.surface(seen.position);
        fences.all[fences.count++] = {surface.normal, surface.distance, collider.velocity,
                                      touching_distance(collider, farthest)};
        return false;
    };
    any_about_to_touch({position, velocity, fields.acceleration(), fields.drag}, reach, time, put_up);
    return fences;
}

Colliders::Encounter Colliders::fly(Vector3d& position, Vector3d& velocity, double time,
                                    const Vector3d& acceleration, const UniformFields& fields) const
{
    const Vector3d pull = fields.acceleration() + acceleration;
    const Path path{position, velocity, pull, fields.drag};
    if (const Elapsed whole = elapsed(time, fields.drag); passes_all(path, whole)) {
        position = path.position_after(whole);
        velocity = path.velocity_after(whole);
        return {};
    }
    Encounter encounter;
    Contacts contacts;
    std::optional<Piece> met;
    std::uint32_t bounces = 0;
    for (std::uint32_t meetings = 0;; ++meetings) {
        touch(position, time, met, contacts);
        if (ends(contacts, met.has_value(), time, position, velocity, encounter))
            return encounter;
        if (met && (bounces + 1 == most_meetings || meetings == most_slides)) {
            velocity = all_[met->collider].velocity;
            position += time * velocity;
            encounter.cut_off = true;
            return encounter;
        }
        const Elapsed left = elapsed(time, fields.drag);
        const Departure departure = leave({position, velocity, pull, fields.drag}, left, contacts, encounter);
        bounces += met && departure.bounces ? 1 : 0;
        const std::optional<Impact> impact = next_impact(departure, left, contacts);
        encounter.touched = encounter.touched || impact || !contacts.all().empty();
        const Elapsed flown = impact ? elapsed(impact->time, fields.drag) : left;
        position = departure.path.position_after(flown);
        velocity = departure.path.velocity_after(flown);
        if (!impact) {
            if (departure.stops)
                velocity = departure.rest;
            return encounter;
        }
        time -= flown.time;
        met = impact->piece;
    }
}

Contact Colliders::contact_with(const Piece& piece, const Solid& solid, const Vector3d& place) const
{
    const Collider& collider = all_[piece.collider];
    Contact contact{piece, solid.surface(place).normal, collider.restitution, collider.friction};
    contact.slack += solid.slack(place);
    contact.velocity = collider.velocity;
    contact.on_hit = collider.on_hit;
    return contact;
}

/// Finds what the particle touches at its place, the piece that it has just met in any case, and puts it onto
/// the surface where rounding, or the scene, has it inside. Where solids overlap that takes some turns.
void Colliders::touch(Vector3d& position, double left, std::optional<Piece> met, Contacts& contacts) const
{
    constexpr int turns = 4;
    const double tolerance = contact_tolerance(position);
    bool moved = true;
    const auto look_at = [&](const Piece& piece, const Solid& solid) {
        const Collider& collider = all_[piece.collider];
        const Vector3d place = position - shift(collider, left);
        const Surface surface = solid.surface(place);
        if (met != piece &&
            (surface.distance > touching_distance(collider, position) || solid.cover(place).count > 0))
            return false;
        contacts.add(contact_with(piece, solid, place));
        if (std::abs(surface.distance) > tolerance) {
            position -= surface.distance * surface.normal;
            moved = true;
        }
        return false;
    };
    for (int turn = 0; moved && turn < turns; ++turn) {
        moved = false;
        contacts.clear();
        for (const Collider& collider : all_) {
            const Vector3d place = position - shift(collider, left);
            const double near = touching_distance(collider, position);
            any_piece(collider, {place, place, Vector3d::Constant(near)}, look_at);
        }
        if (met && contacts.find(*met) == nullptr)
            visit_piece(*met, look_at);
    }
}

/// Bounces off what the particle touches, and starts its flight, or its slide along what holds it.
Colliders::Departure Colliders::leave(Path path, const Elapsed& left, Contacts& contacts,
                                      Encounter& encounter) const
{
    if (contacts.all().empty())
        return {path, false, false, {0, 0, 0}, 0};
    const double rest_time = rest_of_pull * step_;
    std::uint32_t impacts = 0;
    for (const Contact& contact : contacts.all()) {
        const Vector3d seen = path.acceleration - path.drag * contact.velocity;
        const double rest_speed = rest_time * std::max(0.0, -contact.normal.dot(seen));
        impacts += bounce(contact, rest_speed, path.velocity) ? 1 : 0;
    }
    encounter.impacts += impacts;
    const Hold held = hold(contacts.all(), rest_time, path.velocity, path.acceleration, path.drag);
    path.velocity = held.velocity;
    path.acceleration = held.acceleration;
    const bool stops = brake(held, left, path);
    path.velocity += held.frame;
    path.acceleration += path.drag * held.frame;
    return {path, impacts > 0, stops, held.frame, std::hypot(held.pressing, held.acceleration.norm())};
}

/// Where it may touch more than is listed, what is not is judged by itself, unless it is covered, in which
/// case what covers it is.
Colliders::Stance Colliders::stance(const Piece& piece, const Solid& solid, const Departure& departure,
                                    double left, const Contacts& contacts) const
{
    const Path& path = departure.path;
    if (const Contact* const contact = contacts.find(piece))
        return {contact->holds, contact->leaves(path.velocity)};
    if (!contacts.full())
        return {};
    const Path seen = seen_from(all_[piece.collider], path, left);
    if (solid.surface(seen.position).distance > contact_tolerance(path.position) ||
        solid.cover(seen.position).count > 0)
        return {};
    const Contact contact = contact_with(piece, solid, seen.position);
    return {contact.keeps(path.velocity, seen.acceleration, departure.pull), contact.leaves(path.velocity)};
}

/// The earliest one; of several at once that of the first collider.
std::optional<Colliders::Impact> Colliders::next_impact(const Departure& departure, const Elapsed& limit,
                                                        const Contacts& contacts) const
{
    const Path& path = departure.path;
    std::optional<Impact> next;
    Elapsed latest = limit;
    const double tolerance = contact_tolerance(path.position);
    for (const Collider& collider : all_) {
        const Path seen = seen_from(collider, path, limit.time);
        any_piece(collider, seen.sweep(limit, tolerance), [&](const Piece& piece, const Solid& solid) {
            const Stance stands = stance(piece, solid, departure, limit.time, contacts);
            if (stands.held)
                return false;
            const double time = first_contact(seen, solid, 0, latest, stands.leaving);
            if (time < (next ? next->time : never)) {
                next = {piece, time};
                latest = Elapsed(path.drag, time);
            }
            return false;
        });
    }
    return next;
}

} // namespace slod
