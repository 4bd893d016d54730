#include "meter/exact_pulls.hpp"

#include <algorithm>
#include <array>

#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "simd/kernels.hpp"

namespace slod {
namespace {

constexpr std::size_t chunk = 256; ///< particles that the kernel gets at a time
constexpr std::size_t most_probes = ExactPulls::most_probes;

/// Particles as the kernel takes them.
struct Sources {
    std::array<double, chunk> x, y, z, mass, q;
    std::size_t count = 0;
};

/// Probes as the kernel takes them, and their sums.
struct Targets {
    std::array<double, most_probes> x{}, y{}, z{}, q{}, ax{}, ay{}, az{};
    std::size_t padded = 0;

    explicit Targets(std::span<const Probe> probes)
        : padded((probes.size() + simd::tile_width - 1) / simd::tile_width * simd::tile_width)
    {
        for (std::size_t i = 0; i < probes.size(); ++i) {
            x[i] = probes[i].place.x();
            y[i] = probes[i].place.y();
            z[i] = probes[i].place.z();
            q[i] = probes[i].q;
        }
    }

    void take(Sources& sources)
    {
        simd::kernels().in_double.add_acceleration({padded, x.data(), y.data(), z.data(), q.data(), ax.data(),
                                                    ay.data(), az.data(), nullptr, nullptr, nullptr, nullptr,
                                                    nullptr, nullptr},
                                                   {sources.count, sources.x.data(), sources.y.data(),
                                                    sources.z.data(), sources.mass.data(), sources.q.data()},
                                                   simd::no_self);
        sources.count = 0;
    }
};

} // namespace

void ExactPulls::reserve(std::size_t clusters)
{
    probes_.reserve(most_probes);
    pictures_.reserve(clusters);
    slots_.reserve(clusters);
    blocks_.reserve(clusters);
    sums_.reserve(most_blocks * most_probes);
}

void ExactPulls::begin(const ClusterStore& store, std::uint64_t frame, std::span<const Probe> probes,
                       std::span<const Attracts> attracts)
{
    SLOD_ASSERT(probes.size() <= most_probes);
    frame_ = frame;
    probes_.assign(probes.begin(), probes.end());
    abandon();
    for (Probe& probe : probes_)
        probe.pull.setZero();
    if (probes_.empty())
        return;
    cut(store, attracts);
    pictures_.resize(slots_.size());
    for_each_block(slots_.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            pictures_[i] = picture_of(store, {slots_[i]}, frame);
    });
}

void ExactPulls::abandon()
{
    next_block_ = 0;
    blocks_.clear();
    slots_.clear();
}

/// Cuts the clusters that attract anything into blocks of whole clusters.
void ExactPulls::cut(const ClusterStore& store, std::span<const Attracts> attracts)
{
    const ClusterTable& clusters = store.clusters;
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot) || attracts[clusters.region[slot]] == Attracts::Nothing)
            continue;
        const RegionRow region = clusters.region[slot];
        const bool own_region = attracts[region] == Attracts::OwnRegion;
        const auto place = std::uint32_t(slots_.size());
        const auto fits = [&](const Block& block) {
            return block.particles * probes_.size() < block_pairs && block.own_region == own_region &&
                   (!own_region || block.region == region);
        };
        if (blocks_.empty() || !fits(blocks_.back()))
            blocks_.push_back({place, place, 0, region, own_region});
        slots_.push_back(slot);
        blocks_.back().last = place + 1;
        blocks_.back().particles += clusters.count[slot];
    }
}

std::uint64_t ExactPulls::advance(const ClusterStore& store, std::uint64_t pairs)
{
    const std::size_t first = next_block_;
    std::uint64_t spent = 0;
    for (; !done() && spent < pairs; ++next_block_)
        spent += blocks_[next_block_].particles * probes_.size();
    for (std::size_t begin = first; begin < next_block_; begin += most_blocks)
        sum_up(store, begin, std::min(begin + most_blocks, next_block_));
    return spent;
}

/// The blocks [first, last), no more than `most_blocks`.
void ExactPulls::sum_up(const ClusterStore& store, std::size_t first, std::size_t last)
{
    sums_.assign((last - first) * probes_.size(), Vector3d::Zero());
    for_each_task(last - first, [&](std::size_t i) {
        sum_up(store, blocks_[first + i], std::span(sums_).subspan(i * probes_.size(), probes_.size()));
    });
    for (std::size_t sum = 0; sum < sums_.size(); ++sum)
        probes_[sum % probes_.size()].pull += sums_[sum];
}

void ExactPulls::sum_up(const ClusterStore& store, const Block& block, std::span<Vector3d> sums) const
{
    Targets targets(probes_);
    Sources sources;
    for (std::uint32_t i = block.first; i < block.last; ++i) {
        visit_members(store, pictures_[i], frame_, [&](const MemberPlace& member) {
            const std::size_t row = sources.count++;
            sources.x[row] = member.place.x();
            sources.y[row] = member.place.y();
            sources.z[row] = member.place.z();
            sources.mass[row] = member.mass;
            sources.q[row] = 0.5 * store.kind_softening_squared[member.kind];
            if (sources.count == chunk)
                targets.take(sources);
        });
    }
    targets.take(sources);
    for (std::size_t probe = 0; probe < sums.size(); ++probe)
        if (!block.own_region || probes_[probe].region == block.region)
            sums[probe] = {targets.ax[probe], targets.ay[probe], targets.az[probe]};
}

} // namespace slod
