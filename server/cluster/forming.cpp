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

void copy_row(const Rows& from, std::uint32_t source, const Rows& to, std::uint32_t row)
{
    to.offset[row] = from.offset[source];
    to.id[row] = from.id[source];
    if (from.mass != nullptr)
        to.mass[row] = from.mass[source];
    if (from.kind != nullptr)
        to.kind[row] = from.kind[source];
    if (from.expiry != nullptr)
        to.expiry[row] = from.expiry[source];
}

/// Widens what bounds the offsets of the cluster's members.
void note_bounds(ClusterTable& clusters, std::size_t slot, const FormedOffset& offset)
{
    clusters.offset_max[slot] = std::max(clusters.offset_max[slot], offset.position.norm());
    clusters.speed_max[slot] = std::max(clusters.speed_max[slot], offset.velocity.norm());
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

/// Adds to the centre what moves the members' mean, so that no member moves: it is at X + M (o - mean).
void follow_mean(ClusterTable& clusters, std::size_t slot, const MapBlocks& map,
                 const MapBlocks::Offset& before)
{
    const MapBlocks::Offset after = map_centre(clusters, slot);
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

} // namespace

MapBlocks::Offset map_centre(const ClusterTable& clusters, std::size_t slot)
{
    const Moments& moments = centring_moments(clusters, slot);
    return {moments.mean_offset(), moments.mean_velocity()};
}

void form_cluster(ClusterStore& store, ClusterSlot cluster, std::span<Particle> particles,
                  std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    SLOD_ASSERT(!particles.empty() && particles.size() <= clusters.slab[slot].capacity);
    const auto sooner = [](const Particle& a, const Particle& b) {
        return std::tie(a.expiry_frame, a.id) < std::tie(b.expiry_frame, b.id);
    };
    if (clusters.columns.expiry && !std::is_sorted(particles.begin(), particles.end(), sooner))
        std::sort(particles.begin(), particles.end(), sooner);
    const Centre centre = centre_of(particles);
    start_columns(store, slot, centre, frame);
    const Rows rows = rows_of(store.members, clusters.slab[slot]);
    std::uint32_t row = 0;
    float farthest = 0, fastest = 0; // squared
    for (const Particle& particle : particles) {
        const FormedOffset offset{(particle.position - centre.position).cast<float>(),
                                  (particle.velocity - centre.velocity).cast<float>()};
        write_row(rows, row++, particle, offset);
        farthest = std::max(farthest, offset.position.squaredNorm());
        fastest = std::max(fastest, offset.velocity.squaredNorm());
    }
    clusters.offset_max[slot] = std::sqrt(farthest);
    clusters.speed_max[slot] = std::sqrt(fastest);
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
    const std::uint32_t* expiries = store.members.expiries(clusters.slab[slot]);
    const MemberReader member(store, cluster, frame);
    auto particle = out.begin();
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row)
        if (expiries == nullptr || expiries[row] > frame)
            *particle++ = member(row);
    SLOD_ASSERT(particle == out.end());
}

MemberReader::MemberReader(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame)
    : store_(store), slab_(store.clusters.slab[slot.index]),
      map_(store.clusters.blocks(slot.index, store.rule, frame)),
      mean_(map_centre(store.clusters, slot.index)), position_(store.clusters.position[slot.index]),
      velocity_(store.clusters.mean_velocity(slot.index))
{}

Particle MemberReader::operator()(std::uint32_t row) const
{
    const MemberPool& members = store_.members;
    const float* masses = members.masses(slab_);
    const std::uint8_t* kinds = members.kinds(slab_);
    const std::uint32_t* expiries = members.expiries(slab_);
    const MapBlocks::Offset now = map_.forward(relative_to(members.offsets(slab_)[row], mean_));
    return {.position = position_ + now.position,
            .velocity = velocity_ + now.velocity,
            .id = members.ids(slab_)[row],
            .mass = masses != nullptr ? masses[row] : store_.uniform_mass,
            .expiry_frame = expiries != nullptr ? expiries[row] : Particle::never,
            .kind = kinds != nullptr ? kinds[row] : std::uint8_t(0)};
}

Particle member_at(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame, std::uint32_t place)
{
    const std::size_t slot = cluster.index;
    const std::uint32_t* expiries = store.members.expiries(store.clusters.slab[slot]);
    std::uint32_t row = 0;
    for (std::uint32_t before = 0;; ++row) {
        SLOD_ASSERT(row < store.clusters.stored[slot]);
        if ((expiries == nullptr || expiries[row] > frame) && before++ == place)
            return MemberReader(store, cluster, frame)(row);
    }
}

ClusterPicture picture_of(const ClusterStore& store, ClusterSlot cluster, std::uint64_t frame)
{
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    const MapBlocks map = clusters.blocks(slot, store.rule, frame);
    return {clusters.slab[slot],
            clusters.stored[slot],
            clusters.position[slot],
            map_centre(clusters, slot),
            map.a,
            map.b};
}

ClusterPast past_of(const ClusterTable& clusters, std::size_t slot)
{
    return {.formation = clusters.formation[slot],
            .position = clusters.position[slot],
            .mean = map_centre(clusters, slot),
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
    const MapBlocks::Offset mean = map_centre(clusters, slot);
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
    note_bounds(clusters, slot, offset);
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
    const MapBlocks::Offset mean = map_centre(clusters, slot);
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

void release_members(ClusterStore& store, ClusterSlot cluster, const Slab& slab,
                     std::span<const std::uint32_t> rows, std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    const MapBlocks::Offset mean = map_centre(clusters, slot);
    const Rows from = rows_of(store.members, clusters.slab[slot]), to = rows_of(store.members, slab);
    std::uint32_t kept = 0;
    auto leaving = rows.begin();
    clusters.offset_max[slot] = clusters.speed_max[slot] = 0;
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row) {
        if (from.expiry != nullptr && from.expiry[row] < frame)
            continue;
        if (leaving != rows.end() && *leaving == row) {
            ++leaving;
            continue;
        }
        copy_row(from, row, to, kept++);
        note_bounds(clusters, slot, from.offset[row]);
    }
    SLOD_ASSERT(kept > 0 && kept + rows.size() == clusters.count[slot]);
    clusters.slab[slot] = slab;
    clusters.stored[slot] = clusters.count[slot] = kept;
    if (clusters.columns.expiry)
        clusters.next_expiry[slot] = *std::min_element(to.expiry, to.expiry + kept);
    sum_up(store, slot, frame - 1);
    follow_mean(clusters, slot, clusters.blocks(slot, store.rule, frame), mean);
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

} // namespace slod
