#include "app/trace.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace slod {

TraceWriter::TraceWriter(std::filesystem::path file)
    : place_(std::move(file)), file_(std::fopen(place_.c_str(), "we"))
{
    check(file_ != nullptr);
    check(
        std::fputs("frame,time,wall_s,step_ms,encode_ms,target_ms,state,particles,clusters,max_cluster_size,"
                   "max_breadth,opening,life,splits,merges,reformed_members\n",
                   file_.get()) >= 0);
}

void TraceWriter::add(const Snapshot& snapshot, const FrameTime& took, const Regulator::Report& regulation)
{
    const FrameCounts& counts = snapshot.counts;
    const RegionLoad& background = snapshot.regions.back();
    const std::string line = fmt::format(
        "{},{:.9g},{:.6f},{:.4f},{:.4f},{:.4f},{},{},{},{:.4f},{:.6g},{:.4f},{:.4f},{},{},{}\n",
        snapshot.frame, snapshot.time, took.wall_s, took.step_ms, took.encode_ms, regulation.target_ms,
        names(regulation.state)[std::size_t(regulation.state)], counts.particles, counts.clusters,
        background.max_cluster_size, background.max_breadth, snapshot.detail.opening, snapshot.detail.life,
        counts.splits, counts.merges, counts.reformed_members);
    check(std::fputs(line.c_str(), file_.get()) >= 0);
}

void TraceWriter::finish()
{
    check(std::fflush(file_.get()) == 0);
}

void TraceWriter::check(bool written) const
{
    if (!written)
        throw std::system_error(errno, std::generic_category(), "cannot write " + place_.string());
}

} // namespace slod
