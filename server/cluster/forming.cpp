#include "cluster/forming.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/assert.hpp"

namespace slod {
namespace {

/// A map that has shrunk further, in the mean over its directions, takes no members: its inverse magnifies
/// the rounding of a stored offset.
constexpr double least_decay = 1.0 / 16;

/// Mean position and velocity of particles, by mass, or by number when all are massless.
struct Centre {
    Vector3d position{0, 0, 0}, velocity{0, 0, 0};
};

Centre centre_of(std::span<const Particle> particles)
{
    // Relative to the first particle, so that a cluster far from the origin loses nothing.
    double mass = 0;
    for (const Particle& particle : particles)
        mass += double(particle.mass);
    const bool massless = !(mass > 0);
    const double total = massless ? double(particles.size()) : mass;
    const Particle& origin = particles.front();
    Centre sum;
    for (const Particle& particle : particles) {
        const double weight = (massless ? 1.0 : double(particle.mass)) / total;
        sum.position += weight * (particle.position - origin.position);
        sum.velocity += weight * (particle.velocity - origin.velocity);
    }
    return {origin.position + sum.position, origin.velocity + sum.velocity};
}

/// Where the stored rows of the slab hold a cluster's member data.
struct Rows {
    FormedOffset* offset;
    std::uint64_t* id;
    float* mass;           ///< null: uniform
    std::uint8_t* kind;    ///< null: all of kind 0
    std::uint32_t* expiry; ///< null: immortal
};

Rows rows_of(MemberPool& members, const Slab& slab)
{
    return {members.offsets(slab), members.ids(slab), members.masses(slab), members.kinds(slab),
            members.expiries(slab)};
}

void write_row(const Rows& rows, std::uint32_t row, const Particle& particle, const FormedOffset& offset)
{
    rows.offset[row] = offset;
    rows.id[row] = particle.id;
    if (rows.mass != nullptr)
        rows.mass[row] = particle.mass;
    if (rows.kind != nullptr)
        rows.kind[row] = particle.kind;
    if (rows.expiry != nullptr)
        rows.expiry[row] = particle.expiry_frame;
}

void add_to_moments(ClusterStore& store, std::size_t slot, double mass, const FormedOffset& offset)
{
    const Vector3d o = offset.position.cast<double>();
    const Vector3d w = offset.velocity.cast<double>();
    store.clusters.moments[slot].add(mass, o, w);
    if (store.clusters.columns.counting_moments)
        store.clusters.counting[slot].add(1, o, w);
}

/// The moments whose means the map is applied about: of mass, or of number for a massless cluster.
const Moments& centring_moments(const ClusterTable& clusters, std::size_t slot)
{
    return clusters.mass(slot) > 0 ? clusters.moments[slot] : clusters.counting_moments(slot);
}

MapBlocks::Offset means(const ClusterTable& clusters, std::size_t slot)
{
    const Moments& moments = centring_moments(clusters, slot);
    return {moments.mean_offset(), moments.mean_velocity()};
}

/// Adds to the centre what moves the members' mean, so that no member moves: it is at X + M (o - mean).
void follow_mean(ClusterTable& clusters, std::size_t slot, const MapBlocks& map,
                 const MapBlocks::Offset& before)
{
    const MapBlocks::Offset after = means(clusters, slot);
    const MapBlocks::Offset shift =
        map.forward({after.position - before.position, after.velocity - before.velocity});
    clusters.position[slot] += shift.position;
    clusters.velocity[slot] += shift.velocity;
}

/// Sums up the live members' moments and softening.
void sum_up(ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const Rows rows = rows_of(store.members, clusters.slab[slot]);
    const auto softening = [&](std::uint32_t row) {
        return store.kind_softening_squared[rows.kind != nullptr ? rows.kind[row] : 0];
    };
    clusters.moments[slot] = {};
    if (clusters.columns.counting_moments)
        clusters.counting[slot] = {};
    double softening_sum = 0;
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row) {
        if (rows.expiry != nullptr && rows.expiry[row] <= frame)
            continue;
        const double mass = double(rows.mass != nullptr ? rows.mass[row] : store.uniform_mass);
        add_to_moments(store, slot, mass, rows.offset[row]);
        softening_sum += mass * softening(row);
    }
    const double mass = clusters.mass(slot);
    clusters.softening_squared[slot] = float(mass > 0 ? softening_sum / mass : softening(0));
}

void start_columns(ClusterStore& store, std::size_t slot, const Centre& centre, std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    clusters.position[slot] = centre.position;
    clusters.velocity[slot] = centre.velocity;
    if (clusters.columns.withheld)
        clusters.withheld[slot].setZero();
    clusters.moments[slot] = {};
    clusters.offset_max[slot] = 0;
    clusters.speed_max[slot] = 0;
    clusters.formed_frame[slot] = frame;
    if (clusters.columns.map) {
        clusters.map[slot] = {};
        clusters.closure[slot] = 0;
    }
    if (clusters.columns.counting_moments)
        clusters.counting[slot] = {};
    if (clusters.columns.acceleration) {
        clusters.acceleration[slot].setZero();
        clusters.pull[slot] = 0;
    }
    if (clusters.columns.variance())
        clusters.variance[slot] = 0;
    if (clusters.columns.tide)
        clusters.tide[slot] = {};
    if (clusters.columns.turning)
        clusters.turning[slot].setZero();
    if (clusters.columns.strain)
        clusters.strain[slot] = 0;
}

/// Bounds the spectral norm from above, and is equal to it for a multiple of the identity.
double norm_bound(const Matrix3d& matrix)
{
    const Matrix3d sizes = matrix.cwiseAbs();
    return std::sqrt(sizes.rowwise().sum().maxCoeff() * sizes.colwise().sum().maxCoeff());
}

/// Largest lengths of o - o_c and w - w_c among the members, from the largest of o and w at forming.
MemberBounds formed_bounds(const ClusterTable& clusters, std::size_t slot)
{
    const MapBlocks::Offset mean = means(clusters, slot);
    return {double(clusters.offset_max[slot]) + mean.position.norm(),
            double(clusters.speed_max[slot]) + mean.velocity.norm()};
}

/// Largest length of `of_offset` o + `of_velocity` w among the members.
double mapped_bound(const MemberBounds& formed, const Matrix3d& of_offset, const Matrix3d& of_velocity)
{
    return norm_bound(of_offset) * formed.radius + norm_bound(of_velocity) * formed.velocity;
}

} // namespace

void form_cluster(ClusterStore& store, ClusterSlot cluster, std::span<Particle> particles,
                  std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    SLOD_ASSERT(!particles.empty() && particles.size() <= clusters.slab[slot].capacity);
    if (clusters.columns.expiry)
        std::sort(particles.begin(), particles.end(), [](const Particle& a, const Particle& b) {
            return std::tie(a.expiry_frame, a.id) < std::tie(b.expiry_frame, b.id);
        });
    const Centre centre = centre_of(particles);
    start_columns(store, slot, centre, frame);
    const Rows rows = rows_of(store.members, clusters.slab[slot]);
    std::uint32_t row = 0;
    for (const Particle& particle : particles) {
        const FormedOffset offset{(particle.position - centre.position).cast<float>(),
                                  (particle.velocity - centre.velocity).cast<float>()};
        write_row(rows, row++, particle, offset);
        clusters.offset_max[slot] = std::max(clusters.offset_max[slot], offset.position.norm());
        clusters.speed_max[slot] = std::max(clusters.speed_max[slot], offset.velocity.norm());
    }
    clusters.stored[slot] = clusters.count[slot] = row;
    sum_up(store, slot, frame);
    if (clusters.columns.expiry)
        clusters.next_expiry[slot] = particles.front().expiry_frame;
}

void map_out(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame, std::span<Particle> out)
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    SLOD_ASSERT(out.size() == clusters.count[slot]);
    const Slab& slab = clusters.slab[slot];
    const MapBlocks map = clusters.blocks(slot, store.rule, frame);
    const MapBlocks::Offset mean = means(clusters, slot);
    const FormedOffset* offsets = store.members.offsets(slab);
    const std::uint64_t* ids = store.members.ids(slab);
    const float* masses = store.members.masses(slab);
    const std::uint8_t* kinds = store.members.kinds(slab);
    const std::uint32_t* expiries = store.members.expiries(slab);
    auto particle = out.begin();
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row) {
        if (expiries != nullptr && expiries[row] <= frame)
            continue;
        const MapBlocks::Offset now = map.forward(relative_to(offsets[row], mean));
        particle->position = clusters.position[slot] + now.position;
        particle->velocity = clusters.mean_velocity(slot) + now.velocity;
        particle->id = ids[row];
        particle->mass = masses != nullptr ? masses[row] : store.uniform_mass;
        particle->kind = kinds != nullptr ? kinds[row] : std::uint8_t(0);
        particle->expiry_frame = expiries != nullptr ? expiries[row] : Particle::never;
        ++particle;
    }
    SLOD_ASSERT(particle == out.end());
}

ClusterPicture picture_of(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    return {clusters.slab[slot], clusters.stored[slot], clusters.position[slot],
            clusters.blocks(slot, store.rule, frame), means(clusters, slot)};
}

ClusterPast past_of(const ClusterTable& clusters, std::size_t slot)
{
    return {.formation = clusters.formation[slot],
            .position = clusters.position[slot],
            .mean = means(clusters, slot),
            .map = clusters.columns.map ? clusters.map[slot] : FlowMap{}};
}

void map_out_past(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame,
                  const ClusterPast& past, std::span<Vector3d> places)
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    SLOD_ASSERT(places.size() == clusters.count[slot] && past.formation == clusters.formation[slot] &&
                frame > clusters.formed_frame[slot]);
    const MapBlocks map = store.rule.blocks(frame - 1 - clusters.formed_frame[slot], &past.map);
    const FormedOffset* offsets = store.members.offsets(clusters.slab[slot]);
    const std::uint32_t* expiries = store.members.expiries(clusters.slab[slot]);
    auto place = places.begin();
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row)
        if (expiries == nullptr || expiries[row] > frame)
            *place++ = past.position + map.forward(relative_to(offsets[row], past.mean)).position;
    SLOD_ASSERT(place == places.end());
}

bool takes_members(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    if (clusters.stored[slot] >= clusters.slab[slot].capacity)
        return false;
    if (store.rule.conformal)
        return store.rule.decay(frame - clusters.formed_frame[slot]) >= least_decay;
    return clusters.blocks(slot, store.rule, frame).volume() >= least_decay * least_decay * least_decay;
}

void insert_member(ClusterStore& store, ClusterSlot cluster, const Particle& particle, std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    SLOD_ASSERT(clusters.count[slot] > 0 && takes_members(store, cluster, frame));
    const MapBlocks map = clusters.blocks(slot, store.rule, frame);
    const MapBlocks::Offset mean = means(clusters, slot);
    const Vector3d away = particle.position - clusters.position[slot];
    const Vector3d rush = particle.velocity - clusters.mean_velocity(slot);
    const MapBlocks::Offset formed = map.inverse({away, rush});
    const FormedOffset offset{(formed.position + mean.position).cast<float>(),
                              (formed.velocity + mean.velocity).cast<float>()};
    write_row(rows_of(store.members, clusters.slab[slot]), clusters.stored[slot]++, particle, offset);

    const double mass = double(particle.mass);
    add_to_moments(store, slot, mass, offset);
    ++clusters.count[slot];
    // Not by follow_mean: the particle's momentum is added as it is, not as its offset rounds it.
    const double all = centring_moments(clusters, slot).weight;
    const double share = all > 0 ? (clusters.mass(slot) > 0 ? mass : 1.0) / all : 0.0;
    clusters.position[slot] += share * away;
    clusters.velocity[slot] += share * rush;
    clusters.offset_max[slot] = std::max(clusters.offset_max[slot], offset.position.norm());
    clusters.speed_max[slot] = std::max(clusters.speed_max[slot], offset.velocity.norm());
    if (clusters.mass(slot) > 0) {
        const double softening = double(clusters.softening_squared[slot]);
        const double step = store.kind_softening_squared[particle.kind] - softening;
        clusters.softening_squared[slot] = float(softening + mass / clusters.mass(slot) * step);
    }
    if (clusters.columns.expiry)
        clusters.next_expiry[slot] = std::min(clusters.next_expiry[slot], particle.expiry_frame);
}

std::uint32_t remove_expired(ClusterStore& store, ClusterSlot cluster, std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    const Rows rows = rows_of(store.members, clusters.slab[slot]);
    const MapBlocks::Offset mean = means(clusters, slot);
    const std::uint32_t due = clusters.next_expiry[slot];
    std::uint32_t died = 0;
    clusters.next_expiry[slot] = Particle::never;
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row) {
        if (rows.expiry[row] > frame)
            clusters.next_expiry[slot] = std::min(clusters.next_expiry[slot], rows.expiry[row]);
        else if (rows.expiry[row] >= due) // else it died in an earlier frame
            ++died;
    }
    clusters.count[slot] -= died;
    if (died > 0 && clusters.count[slot] > 0) {
        sum_up(store, slot, frame);
        follow_mean(clusters, slot, clusters.blocks(slot, store.rule, frame), mean);
    }
    return died;
}

void hold_velocity(ClusterTable& clusters, std::size_t slot, const Vector3d& velocity)
{
    clusters.withheld[slot] += clusters.velocity[slot] - velocity;
    clusters.velocity[slot] = velocity;
}

void release_velocity(ClusterTable& clusters, std::size_t slot)
{
    clusters.velocity[slot] += clusters.withheld[slot];
    clusters.withheld[slot].setZero();
}

double bounding_radius(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                       std::uint64_t frame)
{
    const MapBlocks map = clusters.blocks(slot, rule, frame);
    return mapped_bound(formed_bounds(clusters, slot), map.a, map.b);
}

double velocity_bound(const ClusterTable& clusters, const MapRule& rule, std::size_t slot,
                      std::uint64_t frame)
{
    const MapBlocks map = clusters.blocks(slot, rule, frame);
    return mapped_bound(formed_bounds(clusters, slot), map.c, map.d);
}

MemberBounds member_bounds(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const MemberBounds formed = formed_bounds(store.clusters, slot);
    if (store.rule.kind == MapKind::Full) {
        const MapBlocks map = store.clusters.blocks(slot, store.rule, frame);
        return {mapped_bound(formed, map.a, map.b), mapped_bound(formed, map.c, map.d)};
    }
    if (store.rule.kind == MapKind::Identity)
        return formed;
    const double drift = store.drift(frame - store.clusters.formed_frame[slot]);
    const double decay = 1 - store.rule.drag * drift;
    return {formed.radius + drift * formed.velocity, decay * formed.velocity};
}

} // namespace slod
