#include "sim/state_hash.hpp"

#include <memory>
#include <type_traits>

#include <xxhash.h>

#include "core/assert.hpp"

namespace slod {
namespace {

class Hasher {
public:
    Hasher() : state_(XXH3_createState(), &XXH3_freeState)
    {
        SLOD_ASSERT(state_ != nullptr && XXH3_64bits_reset(state_.get()) == XXH_OK);
    }

    /// `count` values of a type without padding.
    template <class T>
    void add(const T* values, std::size_t count)
    {
        if (values != nullptr)
            XXH3_64bits_update(state_.get(), values, count * sizeof(T));
    }

    template <class T>
    void add(const T& value)
    {
        add(&value, 1);
    }

    std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

static_assert(sizeof(Moments) == 28 * sizeof(double), "no padding, hashed as a whole");
static_assert(sizeof(ClusterId) == 2 * sizeof(std::uint32_t), "no padding, hashed as a whole");
static_assert(sizeof(FlowMap) == 36 * sizeof(float), "no padding, hashed as a whole");

void add_cluster(Hasher& hasher, const ClusterStore& store, std::size_t slot)
{
    const ClusterTable& clusters = store.clusters;
    hasher.add(slot);
    hasher.add(clusters.position[slot]);
    hasher.add(clusters.velocity[slot]);
    hasher.add(clusters.moments[slot]);
    hasher.add(clusters.offset_max[slot]);
    hasher.add(clusters.speed_max[slot]);
    hasher.add(clusters.softening_squared[slot]);
    hasher.add(clusters.stored[slot]);
    hasher.add(clusters.count[slot]);
    hasher.add(clusters.formed_frame[slot]);
    hasher.add(clusters.formation[slot]);
    hasher.add(clusters.generation[slot]);
    hasher.add(clusters.region[slot]);
    hasher.add(clusters.pool[slot]);
    hasher.add(clusters.next[slot]);
    hasher.add(clusters.previous[slot]);
    if (clusters.columns.withheld)
        hasher.add(clusters.withheld[slot]);
    if (clusters.columns.map)
        hasher.add(clusters.map[slot]);
    if (clusters.columns.counting_moments)
        hasher.add(clusters.counting[slot]);
    if (clusters.columns.expiry)
        hasher.add(clusters.next_expiry[slot]);
    if (clusters.columns.acceleration)
        hasher.add(clusters.pull[slot]);

    const Slab& slab = clusters.slab[slot];
    const std::uint32_t rows = clusters.stored[slot];
    hasher.add(store.members.offsets(slab), rows);
    hasher.add(store.members.ids(slab), rows);
    hasher.add(store.members.masses(slab), rows);
    hasher.add(store.members.kinds(slab), rows);
    hasher.add(store.members.expiries(slab), rows);
}

void add_subtree(Hasher& hasher, const Subtree& tree)
{
    RegionSettings settings = tree.settings;
    for_each_field(settings, [&](const Field&, auto& value) { hasher.add(value); });
    hasher.add(tree.region);
    hasher.add(tree.cell_side);
    for (std::uint32_t index = 0; index < tree.pools.size(); ++index) {
        const Pool& pool = tree.pools[index];
        if (!pool.node.valid())
            continue;
        hasher.add(index);
        hasher.add(pool.node);
        hasher.add(pool.first);
        hasher.add(pool.clusters);
        hasher.add(pool.members);
        hasher.add(pool.phase);
        hasher.add(pool.turn_frame);
        hasher.add(pool.due_frame);
        hasher.add(tree.nodes[pool.node.index].box);
    }
}

/// Whose view moves a region is no part of the state: nothing here acts on it.
bool acts(const Field& field)
{
    return field.key != "follows" && field.key != "view_share";
}

void add_region(Hasher& hasher, const SlodTree::Region& region)
{
    hasher.add(region.number);
    hasher.add(region.open);
    RegionOfInterest settings = region.settings;
    for_each_field(settings, [&]<class T>(const Field& field, const T& value) {
        if (!acts(field))
            return;
        if constexpr (std::is_same_v<T, std::string>)
            hasher.add(value.data(), value.size());
        else
            hasher.add(value);
    });
}

} // namespace

std::uint64_t hash_state(const ClusterStore& store, const SlodTree& tree, const RunState& run)
{
    Hasher hasher;
    for (std::size_t slot = 0; slot < store.clusters.slot_count(); ++slot)
        if (store.clusters.alive(slot))
            add_cluster(hasher, store, slot);
    for (const Subtree& subtree : tree.subtrees)
        add_subtree(hasher, subtree);
    for (const SlodTree::Region& region : tree.regions)
        add_region(hasher, region);
    Detail detail = tree.detail; // for_each_field takes what it may change
    for_each_field(detail, [&](const Field&, auto& value) { hasher.add(value); });
    hasher.add(tree.merging);
    hasher.add(store.uniform_mass);
    hasher.add(run.frame);
    hasher.add(run.random_counters.data(), run.random_counters.size());
    hasher.add(run.cohorts.data(), run.cohorts.size());
    return hasher.digest();
}

} // namespace slod
