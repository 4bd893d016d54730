#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "effects/measured.hpp"
#include "tree/grouping.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Clusters whose members are changed one by one, as no map can: they are mapped out, and those that are
/// remade are formed anew of their members as these have become, each where it was, with what was last
/// measured of it. O(members), some tenths of a microsecond each. Memory is kept from frame to frame.
class Remaking {
public:
    /// A cluster that is mapped out.
    struct Mapped {
        ClusterSlot slot;
        std::uint32_t first, count; ///< of its members
        std::uint32_t changed = 0;  ///< members
    };

    /// Members expected to be mapped out in a frame, of so many particles: twice as many as in the last one,
    /// and so many more.
    std::size_t expected_members(std::size_t particle_count, std::size_t more = 4096) const
    {
        return std::min(particle_count, 2 * member_count_ + more);
    }

    /// Provides memory for so many members, in the clusters there is room for, and for groups of them.
    void reserve(const ClusterTable& clusters, std::size_t member_count, std::size_t group_count);

    /// The same where each cluster that ends leaves one group.
    void reserve(const ClusterTable& clusters, std::size_t member_count)
    {
        reserve(clusters, member_count, clusters.slot_capacity());
    }

    /// Maps out the clusters that `reaches(slot)` says, as they are after `context.frame` frames. It is
    /// called in parallel.
    template <class Reaches>
    void find(const UpdateContext& context, const Reaches& reaches)
    {
        const ClusterTable& clusters = context.store.clusters;
        marks_.resize(clusters.slot_count());
        for_each_block(clusters.slot_count(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t slot = first; slot < last; ++slot)
                marks_[slot] = clusters.alive(slot) && reaches(slot) ? 1 : 0;
        });
        list_marked(clusters);
        change([&](const Mapped& mapped, std::span<Particle> members) {
            map_out(context.store, mapped.slot, context.frame, members);
            return std::uint32_t{0};
        });
    }

    /// Has `body(mapped, members)` change the members of each cluster found; it returns how many it changed.
    /// A member that is to die gets as its expiry the frame that remake() is called for. It is called in
    /// parallel.
    template <class Body>
    void change(const Body& body)
    {
        for_each_block(mapped_.size(), 4, [&](std::size_t first, std::size_t last) {
            for (Mapped& mapped : std::span(mapped_).subspan(first, last - first))
                mapped.changed = body(mapped, members_of(mapped));
        });
    }

    std::span<const Mapped> mapped() const { return mapped_; } ///< in order of slots
    std::span<Particle> members_of(const Mapped& mapped)
    {
        return std::span(members_).subspan(mapped.first, mapped.count);
    }
    std::span<const Particle> members_of(const Mapped& mapped) const
    {
        return std::span(members_).subspan(mapped.first, mapped.count);
    }
    std::size_t member_count() const { return member_count_; } ///< of all that are mapped out

    /// Lets a cluster end, and has it formed anew of those members that do not die by the frame, with the
    /// room that it had for strays.
    void remake(const Mapped& mapped, const UpdateContext& context);

    // The same in parts, for clusters that leave several groups, or none, and need not end.
    void begin(); ///< with none
    void end(ClusterSlot slot) { ending_.push_back(slot); }

    /// Adds a group of so many members of one cluster, for the caller to write into particles() from the
    /// number on that grouped() was before.
    void add_group(const ClusterTable& clusters, ClusterSlot slot, std::uint32_t count,
                   std::uint32_t spare_rows = 0);
    std::uint32_t grouped() const { return std::uint32_t(grouping_.particles.size()); } ///< members so far
    std::span<Particle> particles() { return grouping_.particles; }

    /// Forms what is to be remade, and puts it where it is.
    void form(SlodTree& tree, const UpdateContext& context);

private:
    void list_marked(const ClusterTable& clusters);

    std::vector<std::uint8_t> marks_; ///< by slot
    std::vector<Mapped> mapped_;
    std::vector<Particle> members_; ///< of those mapped out; as long as it ever was
    std::size_t member_count_ = 0;
    std::vector<ClusterSlot> ending_;
    std::vector<Measured> measured_; ///< by group
    Grouping grouping_;
};

} // namespace slod
