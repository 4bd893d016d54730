#include "app/status.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "app/scales.hpp"

namespace slod {
namespace {

constexpr int seconds_between_log_lines = 5;

/// The planned phases that take noticeable time, the longest first: the end of the line may be cut off.
std::string longest_phases(const StepProfile& profile, const Plan& plan)
{
    constexpr double noticeable_ms = 0.05;
    std::array<std::size_t, phase_count> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
        return profile.milliseconds[left] > profile.milliseconds[right];
    });
    std::string text;
    for (const std::size_t phase : order)
        if (plan.runs[phase] && profile.milliseconds[phase] >= noticeable_ms)
            fmt::format_to(std::back_inserter(text), " {} {:.1f}", names(Phase{})[phase],
                           profile.milliseconds[phase]);
    return text;
}

/// Every planned phase as ` name=milliseconds`.
std::string phase_records(const StepProfile& profile, const Plan& plan)
{
    std::string text;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (plan.runs[phase])
            fmt::format_to(std::back_inserter(text), " {}={:.2f}", names(Phase{})[phase],
                           profile.milliseconds[phase]);
    return text;
}

/// How fast simulated time goes, from the real-time factor: "x1.00", or "29.3 Myr/s".
std::string speed_text(double real_time_factor)
{
    const bool readable = real_time_factor >= 0.001 && real_time_factor < 10000;
    return readable ? fmt::format("x{:.2f}", real_time_factor) : duration_text(real_time_factor) + "/s";
}

/// Where a controller turns it, and the background's largest cluster: " holding, size 23.5".
std::string size_text(const Snapshot& snapshot, const ControlReport& regulation)
{
    if (regulation.state == ControlState::Off)
        return {};
    return fmt::format(" {}, size {:.3g}", names(regulation.state)[std::size_t(regulation.state)],
                       snapshot.regions.back().max_cluster_size);
}

/// Median and the interval it is in: "  error 0.31 % (0.28 to 0.35)".
std::string error_text(const ErrorEstimate& error)
{
    if (error.samples == 0)
        return {};
    return fmt::format("  error {:.2g} % ({:.2g} to {:.2g})", 100 * error.median.value,
                       100 * error.median.low, 100 * error.median.high);
}

/// Their names: "  ! under_resolved".
std::string alarm_text(std::span<const Alarm> alarms)
{
    std::string text;
    for (const Alarm& alarm : alarms)
        text += (text.empty() ? "  ! " : ", ") + std::string(alarm.name);
    return text;
}

} // namespace

std::string status_line(const RunStatus& status)
{
    const auto& [snapshot, means, plan, regulation, error, alarms] = status;
    return fmt::format("frame {}{}  {:.1f} fps{}{}  {:.1f} ms  {} clusters of {} particles  t {:.4g}  {}:{}",
                       snapshot.frame, alarm_text(alarms), means.frame_rate_hz,
                       size_text(snapshot, regulation), error_text(error), means.work_ms,
                       grouped(snapshot.counts.clusters), grouped(snapshot.counts.particles), snapshot.time,
                       speed_text(means.real_time_factor), longest_phases(means.profile, plan));
}

std::string status_record(const RunStatus& status)
{
    const auto& [snapshot, means, plan, regulation, error, alarms] = status;
    return fmt::format(
        "status frame={} time={:.6g} frame_rate_hz={:.1f} real_time_factor={:.4g} particles={} "
        "clusters={} max_cluster_size={:.4g} control={} error_median={:.3g} error_p99={:.3g} "
        "error_samples={} alarms={} work_ms={:.2f}{}",
        snapshot.frame, snapshot.time, means.frame_rate_hz, means.real_time_factor, snapshot.counts.particles,
        snapshot.counts.clusters, snapshot.regions.back().max_cluster_size,
        names(regulation.state)[std::size_t(regulation.state)], error.median.value, error.p99.value,
        error.samples, alarms.size(), means.work_ms, phase_records(means.profile, plan));
}

void StatusDisplay::update(const RunStatus& status)
{
    ++seconds_;
    if (logging_.on_terminal())
        logging_.show_status(status_line(status));
    else if (seconds_ % seconds_between_log_lines == 0)
        spdlog::info(status_record(status));
}

} // namespace slod
