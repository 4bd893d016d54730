#include "effects/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
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

/// The velocity at which all that hold the particle move together across themselves: the first one's, and for
/// the others the least that is needed besides.
Vector3d common_velocity(std::span<const Contact> contacts, std::uint32_t holding)
{
    Vector3d velocity{0, 0, 0}, rest{0, 0, 0};
    Matrix3d normals = Matrix3d::Zero();
    bool found = false;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if ((holding >> i & 1U) == 0)
            continue;
        const Vector3d& normal = contacts[i].normal;
        if (!std::exchange(found, true))
            velocity = contacts[i].velocity;
        rest += normal.dot(contacts[i].velocity - velocity) * normal;
        normals += normal * normal.transpose();
    }
    if (rest.isZero(0))
        return velocity;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(normals);
    for (int axis = 0; axis < 3; ++axis) {
        const double size = axes.eigenvalues()[axis];
        const Vector3d along = axes.eigenvectors().col(axis);
        if (size > 1e-12)
            velocity += along.dot(rest) / size * along;
    }
    return velocity;
}

/// The nearest of the accelerations tried that leads into no contact; of some as near, the first, which takes
/// away the fewest directions.
class NearestAllowed {
public:
    struct Motion {
        Vector3d velocity;
        Vector3d acceleration, frame; ///< of what moves at the velocity `frame`
        double drag;
        double rest_time; ///< a flight that its normal speed ends within twice this is none
    };

    NearestAllowed(std::span<const Contact> contacts, const Motion& wanted)
        : contacts_(contacts), wanted_(wanted)
    {
        for (std::size_t i = 0; i < contacts.size(); ++i)
            slow_ |= std::uint32_t(returns(contacts[i], wanted)) << i;
    }

    bool slow(std::size_t contact) const { return (slow_ >> contact & 1U) != 0; }

    void attempt(const Freedom& freedom, std::uint32_t holding)
    {
        const Vector3d frame = common_velocity(contacts_, holding);
        const Vector3d seen = acceleration_in(frame), left = freedom.keep(seen);
        const double lost = (seen - left).squaredNorm();
        const Motion then{freedom.keep(wanted_.velocity - frame) + frame, left, frame, wanted_.drag,
                          wanted_.rest_time};
        if (lost < (1 - rounding) * least_ && allowed(then, holding)) {
            least_ = lost;
            best_ = freedom;
            holding_ = holding;
        }
    }

    const Freedom& best() const { return best_; }
    std::uint32_t holding() const { return holding_; } ///< a bit for each contact

private:
    static constexpr double rounding = 1e-12; ///< of the square of what is lost

    /// The wanted acceleration of what moves at the velocity `frame`.
    Vector3d acceleration_in(const Vector3d& frame) const
    {
        return wanted_.acceleration + wanted_.drag * (wanted_.frame - frame);
    }

    /// Acceleration away from the contact, as seen by who moves with it.
    static double lift(const Contact& contact, const Motion& motion)
    {
        return contact.normal.dot(motion.acceleration + motion.drag * (motion.frame - contact.velocity));
    }

    /// Whether such a motion is back at once.
    static bool returns(const Contact& contact, const Motion& motion)
    {
        const double pull = std::max(0.0, -lift(contact, motion));
        return contact.normal.dot(motion.velocity - contact.velocity) <= motion.rest_time * pull;
    }

    bool allowed(const Motion& then, std::uint32_t holding) const
    {
        for (std::size_t i = 0; i < contacts_.size(); ++i) {
            const Contact& contact = contacts_[i];
            if (!slow(i) || (holding >> i & 1U) != 0)
                continue;
            const double size = acceleration_in(contact.velocity).norm();
            const bool pulled = lift(contact, then) < -contact.slack * size;
            if ((pulled && returns(contact, then)) || !contact.leaves(then.velocity))
                return false;
        }
        return true;
    }

    std::span<const Contact> contacts_;
    Motion wanted_;
    std::uint32_t slow_ = 0;
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

/// How little two contacts differ: the cosine of the angle between them; less than any where they are of two
/// colliders.
double likeness(const Contact& a, const Contact& b)
{
    return a.piece.collider == b.piece.collider ? a.normal.dot(b.normal) : -2;
}

} // namespace

void Contacts::add(const Contact& contact)
{
    all_[full() ? most_alike(contact) : count_++] = contact;
}

/// The earlier one of the two that differ the least, of all and the next one.
std::size_t Contacts::most_alike(const Contact& next) const
{
    std::size_t found = 0;
    double most_like = -3;
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = i + 1; j <= count_; ++j) {
            const double like = likeness(all_[i], j < count_ ? all_[j] : next);
            if (like > most_like) {
                most_like = like;
                found = i;
            }
        }
    }
    return found;
}

const Contact* Contacts::find(const Piece& piece) const
{
    const auto found = std::find_if(all_.begin(), all_.begin() + std::ptrdiff_t(count_),
                                    [&](const Contact& contact) { return contact.piece == piece; });
    return found == all_.begin() + std::ptrdiff_t(count_) ? nullptr : &*found;
}

const Contact* Contacts::find(OnHit on_hit) const
{
    const auto found = std::find_if(all_.begin(), all_.begin() + std::ptrdiff_t(count_),
                                    [&](const Contact& contact) { return contact.on_hit == on_hit; });
    return found == all_.begin() + std::ptrdiff_t(count_) ? nullptr : &*found;
}

bool bounce(const Contact& contact, double rest_speed, Vector3d& velocity)
{
    const Vector3d seen = velocity - contact.velocity;
    const double approach = -contact.normal.dot(seen);
    if (approach <= 0)
        return false;
    Vector3d along = seen + approach * contact.normal;
    along -= contact.normal.dot(along) * contact.normal; // else what rounding left could be a fall
    double rebound = contact.restitution * approach;
    const bool grazes = contact.leaves(velocity);
    if (rebound <= rest_speed || grazes)
        rebound = 0;
    const double slip = along.norm();
    const double grip = contact.friction * (approach + rebound);
    velocity = rebound * contact.normal;
    if (slip > grip)
        velocity += (1 - grip / slip) * along;
    velocity += contact.velocity;
    return approach > rest_speed && !grazes;
}

Hold hold(std::span<Contact> contacts, double rest_time, const Vector3d& velocity,
          const Vector3d& acceleration, double drag)
{
    NearestAllowed nearest(contacts, {velocity, acceleration, {0, 0, 0}, drag, rest_time});
    attempt_all(contacts, nearest);
    const std::uint32_t holding = nearest.holding();
    Hold held{.frame = common_velocity(contacts, holding), .velocity = {}, .acceleration = {}};
    const Vector3d wanted = acceleration - drag * held.frame;
    held.velocity = nearest.best().keep(velocity - held.frame);
    held.acceleration = nearest.best().keep(wanted);
    held.pressing = (wanted - held.acceleration).norm();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        contacts[i].holds = (holding >> i & 1U) != 0;
        if (contacts[i].holds)
            held.friction = std::max(held.friction, contacts[i].friction);
        else if (nearest.slow(i))
            contacts[i].holds = contacts[i].keeps(
                held.velocity + held.frame, held.acceleration + drag * (held.frame - contacts[i].velocity),
                wanted.norm());
    }
    return held;
}

} // namespace slod
