#include "effects/contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "effects/path.hpp"

namespace slod {
namespace {

/// The directions that are left where some surfaces hold: all, those of a plane, of a line, or none.
struct Freedom {
    int dimensions = 3;
    Vector3d direction{0, 0, 0}; ///< normal of the plane, or along the line

    Vector3d keep(const Vector3d& v) const
    {
        if (dimensions == 3)
            return v;
        if (dimensions == 0)
            return {0, 0, 0};
        const Vector3d along = direction.dot(v) * direction;
        return dimensions == 1 ? along : Vector3d(v - along);
    }
};

/// The nearest of the accelerations tried that leads into no contact.
class NearestAllowed {
public:
    NearestAllowed(std::span<const Contact> contacts, std::uint32_t slow, const Vector3d& wanted)
        : contacts_(contacts), slow_(slow), wanted_(wanted)
    {}

    bool slow(std::size_t contact) const { return (slow_ >> contact & 1U) != 0; }

    void attempt(const Freedom& freedom, std::uint32_t holding)
    {
        const Vector3d left = freedom.keep(wanted_);
        const double lost = (wanted_ - left).squaredNorm();
        if (lost < least_ && allowed(left, holding)) {
            least_ = lost;
            best_ = freedom;
            holding_ = holding;
        }
    }

    const Freedom& best() const { return best_; }
    std::uint32_t holding() const { return holding_; } ///< a bit for each contact

private:
    bool allowed(const Vector3d& acceleration, std::uint32_t holding) const
    {
        const double rounding = 1e-14 * wanted_.norm();
        for (std::size_t i = 0; i < contacts_.size(); ++i)
            if (slow(i) && (holding >> i & 1U) == 0 && contacts_[i].normal.dot(acceleration) < -rounding)
                return false;
        return true;
    }

    std::span<const Contact> contacts_;
    std::uint32_t slow_;
    Vector3d wanted_;
    double least_ = never;
    Freedom best_;
    std::uint32_t holding_ = 0;
};

/// Tries none, each, each two and all of the contacts.
void attempt_all(std::span<const Contact> contacts, NearestAllowed& nearest)
{
    std::uint32_t all = 0;
    nearest.attempt({}, 0);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (!nearest.slow(i))
            continue;
        all |= 1U << i;
        nearest.attempt({2, contacts[i].normal}, 1U << i);
        for (std::size_t j = 0; j < i; ++j) {
            const Vector3d edge = contacts[i].normal.cross(contacts[j].normal);
            const double sine = edge.norm();
            if (nearest.slow(j) && sine > 1e-12) // else they are one surface
                nearest.attempt({1, edge / sine}, 1U << i | 1U << j);
        }
    }
    nearest.attempt({0, {0, 0, 0}}, all);
}

} // namespace

const Contact* Contacts::find(std::uint32_t collider) const
{
    const auto found = std::find_if(all_.begin(), all_.begin() + std::ptrdiff_t(count_),
                                    [&](const Contact& contact) { return contact.collider == collider; });
    return found == all_.begin() + std::ptrdiff_t(count_) ? nullptr : &*found;
}

bool bounce(const Contact& contact, double rest_speed, Vector3d& velocity)
{
    const double approach = -contact.normal.dot(velocity);
    if (approach <= 0)
        return false;
    Vector3d along = velocity + approach * contact.normal;
    along -= contact.normal.dot(along) * contact.normal; // else what rounding left could be a fall
    double rebound = contact.restitution * approach;
    if (rebound <= rest_speed)
        rebound = 0;
    const double slip = along.norm();
    const double grip = contact.friction * (approach + rebound);
    velocity = rebound * contact.normal;
    if (slip > grip)
        velocity += (1 - grip / slip) * along;
    return approach > rest_speed;
}

Hold hold(std::span<Contact> contacts, std::span<const double> rest_speed, const Vector3d& velocity,
          const Vector3d& acceleration)
{
    std::uint32_t slow = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i)
        slow |= std::uint32_t(contacts[i].normal.dot(velocity) <= rest_speed[i]) << i;
    NearestAllowed nearest(contacts, slow, acceleration);
    attempt_all(contacts, nearest);
    Hold held{nearest.best().keep(velocity), nearest.best().keep(acceleration)};
    held.pressing = (acceleration - held.acceleration).norm();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        contacts[i].holds = (nearest.holding() >> i & 1U) != 0;
        if (contacts[i].holds)
            held.friction = std::max(held.friction, contacts[i].friction);
    }
    return held;
}

} // namespace slod
