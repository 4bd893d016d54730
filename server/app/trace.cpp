#include "app/trace.hpp"

#include <spdlog/fmt/fmt.h>

namespace slod {

TraceWriter::TraceWriter(const std::filesystem::path& file) : file_(file)
{
    file_.add("frame,time,wall_s,step_ms,encode_ms,target_ms,state,particles,clusters,max_cluster_size,"
              "max_breadth,opening,life,splits,merges,reformed_members");
}

void TraceWriter::add(const Snapshot& snapshot, const FrameTime& took, const ControlReport& regulation)
{
    const FrameCounts& counts = snapshot.counts;
    const RegionLoad& background = snapshot.regions.back();
    file_.add(fmt::format(
        "{},{:.9g},{:.6f},{:.4f},{:.4f},{:.4f},{},{},{},{:.4f},{:.6g},{:.4f},{:.4f},{},{},{}", snapshot.frame,
        snapshot.time, took.wall_s, took.step_ms, took.encode_ms, regulation.target_ms,
        names(regulation.state)[std::size_t(regulation.state)], counts.particles, counts.clusters,
        background.max_cluster_size, background.max_breadth, snapshot.detail.opening, snapshot.detail.life,
        counts.splits, counts.merges, counts.reformed_members));
}

} // namespace slod
