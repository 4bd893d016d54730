#include "effects/collisions.hpp"

#include "core/make_room.hpp"
#include "core/parallel.hpp"
#include "effects/near_members.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 1024;     ///< clusters that one task asks whether they are struck
constexpr std::size_t few_clusters = 4; ///< whose members fly in one task, or are moved

} // namespace

void Collisions::reserve(const ClusterTable& clusters, std::size_t member_count)
{
    const std::size_t slots = clusters.slot_capacity();
    remaking_.reserve(clusters, member_count, member_count); // each may be alone
    near_counts_.reserve(slots);
    struck_.reserve(slots);
    partings_.reserve(slots);
    make_room(flown_, member_count);
    make_room(rows_, member_count);
}

void Collisions::fly_members(const UpdateContext& context)
{
    colliders_.set_frame_end(double(context.frame) * context.step);
    const ClusterTable& clusters = context.store.clusters;
    near_counts_.resize(clusters.slot_count());
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (auto slot = std::uint32_t(first); slot < last; ++slot) {
            std::uint32_t count = 0;
            if (clusters.alive(slot))
                visit_near(context, {slot}, [&](std::uint32_t) { ++count; });
            near_counts_[slot] = count;
        }
    });
    list_struck(clusters);
    for_each_block(struck_.size(), few_clusters, [&](std::size_t first, std::size_t last) {
        for (Struck& struck : std::span(struck_).subspan(first, last - first))
            fly(context, struck);
    });
}

void Collisions::list_struck(const ClusterTable& clusters)
{
    struck_.clear();
    struck_members_ = 0;
    std::uint32_t total = 0;
    for (std::uint32_t slot = 0; slot < near_counts_.size(); ++slot) {
        if (near_counts_[slot] == 0)
            continue;
        struck_.push_back({.slot = {slot}, .first = total, .count = near_counts_[slot]});
        struck_members_ += clusters.count[slot];
        total += near_counts_[slot];
    }
    if (flown_.size() < total) {
        flown_.resize(total);
        rows_.resize(total);
    }
}

/// Radius of a ball about the cluster's centre that no member leaves during the frame, unless it bounces: the
/// bound, and drift times the relative velocities. Under kicks the members' ways are bent, and the centre's
/// is not. `felt`: null where the air is the same everywhere.
double Collisions::reach(const UpdateContext& context, std::size_t slot, const MemberBounds& bounds,
                         const Air::Felt* felt) const
{
    const ClusterTable& clusters = context.store.clusters;
    double relative = bounds.velocity;
    if (clusters.columns.withheld)
        relative += clusters.withheld[slot].norm();
    double reach = bounds.radius + (felt == nullptr ? colliders_.frame().drift * relative
                                                    : air_->spread(*felt, bounds.radius, relative));
    if (clusters.columns.acceleration)
        reach += 0.125 * context.step * context.step * clusters.acceleration[slot].norm();
    return reach * (1 + 1e-5); // the bounds are floats
}

/// Whether all members have to fly, as soon as one may be struck: where they do not move as the map says, and
/// where each feels an air of its own.
bool Collisions::flies_whole(const ClusterTable& clusters, std::size_t slot) const
{
    return air_ != nullptr || !rules_.carries_members || clusters.holds_velocity(slot);
}

/// Calls visit(row) for each member that may be struck. Most clusters are far from all colliders, which their
/// widest bounds say; for the others it is asked member by member.
template <class Visit>
void Collisions::visit_near(const UpdateContext& context, ClusterSlot cluster, const Visit& visit) const
{
    const ClusterStore& store = context.store;
    const ClusterTable& clusters = store.clusters;
    const std::size_t slot = cluster.index;
    const std::uint64_t before = context.frame - 1;
    const Vector3d &position = clusters.position[slot], &velocity = clusters.velocity[slot];
    std::optional<Air::Felt> local;
    if (air_ != nullptr)
        local = air_->felt_by_cluster(clusters, slot);
    const Air::Felt* const felt = local ? &*local : nullptr;
    const UniformFields& fields = felt != nullptr ? felt->fields : colliders_.fields();
    if (colliders_.clear_of_all(position, velocity,
                                reach(context, slot, generous_bounds(store, slot, before), felt),
                                context.step, fields))
        return;
    const MemberBounds bounds = member_bounds(store, slot, before);
    const Fences fences =
        colliders_.fences(position, velocity, reach(context, slot, bounds, felt), context.step, fields);
    if (fences.count == 0)
        return;
    const bool whole = !fences.complete || flies_whole(clusters, slot);
    const Kick kick = kick_of(context, slot);
    const NearMembers near(store, cluster, before, fences,
                           {.elapsed = colliders_.frame(),
                            .acceleration = fields.acceleration() + kick.acceleration,
                            .drag = fields.drag,
                            .change = -kick.half},
                           bounds.velocity * (1 + 1e-5));
    const Slab& slab = clusters.slab[slot];
    const FormedOffset* const offsets = store.members.offsets(slab);
    const std::uint32_t* const expiries = store.members.expiries(slab);
    for (std::uint32_t row = 0; row < clusters.stored[slot]; ++row)
        if ((expiries == nullptr || expiries[row] > before) && (whole || near(offsets[row])))
            visit(row);
}

/// What the kicks give at the ends of the frame acts all through it where something may be hit meanwhile:
/// half of it is taken back, and the other half is yet to come. Without drag free flight is the same either
/// way, up to rounding; with it they differ in third order of the step.
Collisions::Kick Collisions::kick_of(const UpdateContext& context, std::size_t slot) const
{
    const ClusterTable& clusters = context.store.clusters;
    if (!clusters.columns.acceleration)
        return {};
    return {clusters.acceleration[slot], (0.5 * context.step) * clusters.acceleration[slot]};
}

void Collisions::fly(const UpdateContext& context, Struck& struck)
{
    const ClusterTable& clusters = context.store.clusters;
    const std::size_t slot = struck.slot.index;
    const Kick kick = kick_of(context, slot);
    std::optional<Air::Felt> local;
    if (air_ != nullptr)
        local = air_->felt_by_cluster(clusters, slot);
    const MemberReader member(context.store, struck.slot, context.frame - 1);
    struck.position = clusters.position[slot];
    struck.velocity = clusters.velocity[slot];
    auto flown = flown_.begin() + struck.first;
    visit_near(context, struck.slot, [&](std::uint32_t row) {
        Particle& particle = flown->particle = member(row);
        const Vector3d position = particle.position, velocity = particle.velocity;
        const UniformFields fields =
            local ? air_->felt_by_member(*local, position, velocity) : colliders_.fields();
        particle.velocity -= kick.half;
        const auto met =
            colliders_.fly(particle.position, particle.velocity, context.step, kick.acceleration, fields);
        if (met.killed)
            struck.killed.add(double(particle.mass), particle.velocity);
        particle.velocity -= kick.half;
        flown->fate = met.killed ? Fate::Killed : met.touched ? Fate::Touching : Fate::Free;
        if (flown->fate != Fate::Free)
            rows_[struck.first + struck.touching++] = row;
        if (!met.killed && particle.expiry_frame > context.frame)
            ++struck.outliving[std::size_t(flown->fate)];
        struck.moved += particle.position != position || particle.velocity != velocity ? 1 : 0;
        struck.impacts += met.impacts;
        struck.cut_off += met.cut_off ? 1 : 0;
        ++flown;
    });
}

std::uint64_t Collisions::put_back(SlodTree& tree, const UpdateContext& context, CollisionCounts& counts,
                                   Losses& killed)
{
    left_out_ = 0;
    killed = {};
    partings_.clear();
    remaking_.begin();
    for (const Struck& struck : struck_) {
        counts.impacts += struck.impacts;
        counts.impacts_cut_off += struck.cut_off;
        killed += struck.killed;
        if (keep(context.store.clusters, struck))
            continue;
        ++counts.taken_apart;
        part(tree, context, struck);
    }
    counts.struck += struck_.size();
    counts.killed += killed.particles;
    for_each_block(partings_.size(), few_clusters, [&](std::size_t first, std::size_t last) {
        for (const Parting& parting : std::span(partings_).subspan(first, last - first))
            move_members(context, parting);
    });
    remaking_.form(tree, context);
    return left_out_;
}

/// Whether the cluster goes on, which it does where its map carries the members to where they are, where they
/// rest, and where it is a single particle, which is given its outcome if it touched anything.
bool Collisions::keep(ClusterTable& clusters, const Struck& struck) const
{
    const std::size_t slot = struck.slot.index;
    const bool withheld = clusters.holds_velocity(slot), single = clusters.count[slot] == 1;
    if (struck.killed.particles > 0)
        return false;
    if ((rules_.carries_members || single) && struck.touching == 0 && !withheld)
        return true;
    if (single) {
        const Particle& particle = flown_[struck.first].particle;
        clusters.position[slot] = particle.position;
        clusters.velocity[slot] = particle.velocity;
        if (withheld)
            clusters.withheld[slot].setZero();
        return true;
    }
    if (withheld)
        return false;
    const bool rests = struck.moved == 0 && struck.count == clusters.count[slot] && !rules_.full_map &&
                       clusters.speed_max[slot] == 0;
    if (rests) {
        clusters.position[slot] = struck.position;
        clusters.velocity[slot] = struck.velocity;
    }
    return rests;
}

/// Groups members of the cluster that are to be formed anew. Where the map carries members those that touched
/// nothing stay in it, if there are any; else it ends, and those stay together only if it does. The others do
/// where the map is exact wherever they go, and else each is alone.
void Collisions::part(SlodTree& tree, const UpdateContext& context, const Struck& struck)
{
    ClusterTable& clusters = context.store.clusters;
    const std::size_t slot = struck.slot.index;
    const bool stay = rules_.carries_members && !clusters.holds_velocity(slot);
    Parting parting{&struck, remaking_.grouped(), {}};
    const auto [free, touching] = struck.outliving;
    if (!stay)
        group(clusters, struck, free, rules_.carries_members);
    group(clusters, struck, touching, rules_.exact);
    const std::uint32_t leaving = stay ? struck.touching : clusters.count[slot];
    left_out_ += leaving - (remaking_.grouped() - parting.first);
    if (leaving < clusters.count[slot]) {
        const Slab& whole = clusters.slab[slot];
        const std::uint32_t spare = whole.capacity - clusters.stored[slot];
        parting.rest = context.store.members.allocate(clusters.count[slot] - leaving + spare);
        context.store.members.retire(whole, context.frame);
        tree.pool({clusters.region[slot], clusters.pool[slot]}).members -= leaving;
    } else {
        remaking_.end(struck.slot);
    }
    partings_.push_back(parting);
}

void Collisions::group(const ClusterTable& clusters, const Struck& struck, std::uint32_t count, bool together)
{
    const std::uint32_t each = together ? count : 1;
    for (std::uint32_t grouped = 0; grouped < count; grouped += each)
        remaking_.add_group(clusters, struck.slot, each);
}

/// Writes the members that have been grouped, and lets those that stay have their own slab.
void Collisions::move_members(const UpdateContext& context, const Parting& parting)
{
    const Struck& struck = *parting.struck;
    const bool stay = parting.rest.capacity > 0;
    auto to = remaking_.particles().begin() + parting.first;
    const auto write = [&](Fate fate) {
        for (const Flown& flown : flown_by(struck))
            if (flown.fate == fate && flown.particle.expiry_frame > context.frame)
                *to++ = flown.particle;
    };
    if (!stay)
        write(Fate::Free);
    write(Fate::Touching);
    if (stay)
        release_members(context.store, struck.slot, parting.rest,
                        std::span(rows_).subspan(struck.first, struck.touching), context.frame);
}

} // namespace slod
