#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace slod::stress {

/// What the server said in one sample of its statistics, and what the kernel said of its process then.
struct ServerSample {
    double when_s = 0; ///< of the observer's clock
    std::uint64_t frame = 0;
    std::uint64_t published_frames = 0;
    std::uint64_t published_bytes = 0; ///< once per sample, whatever the number of readers
    std::uint64_t delayed_frames = 0;  ///< that waited for the publisher
    std::uint64_t refused_samples = 0;
    double encode_ms = 0;                 ///< processor time, of the last published frame
    double work_ms = 0;                   ///< wall time of a frame without the wait for the next
    std::optional<double> processor_s{};  ///< user and system time so far; none: another host's
    std::optional<double> network_s{};    ///< of it, DDS's own threads
    std::optional<double> resident_mib{}; ///< memory
};

/// How the server did over one phase.
struct ServerUse {
    double seconds = 0;
    std::uint64_t frames = 0;
    double frame_rate_hz = 0;
    std::uint64_t published_frames = 0;
    double published_mb_s = 0; ///< 10^6 bytes per second
    std::uint64_t delayed_frames = 0;
    std::uint64_t refused_samples = 0;
    double longest_standstill_s = 0;    ///< without a new frame
    double encode_ms = 0;               ///< processor time per frame, published or not
    std::optional<double> processor_ms; ///< per frame
    std::optional<double> network_ms;   ///< of it, DDS's own threads: acknowledgements, discovery, repair
    double work_ms = 0;                 ///< wall time of a frame without the wait for the next, mean
    std::optional<double> start_mib, middle_mib, end_mib; ///< resident memory
};

/// Over the samples, which are in order; all 0 unless there are two.
ServerUse use_of(std::span<const ServerSample> samples);

/// By how much a frame takes more of the processor under load than at rest plus what the server says
/// encoding takes [percent]; none where either is not known.
std::optional<double> processor_growth_percent(const ServerUse& rest, const ServerUse& load);

/// Memory taken over the second half of the phase [MiB]: in the first one readers get their buffers.
std::optional<double> memory_growth_mib(const ServerUse& load);

} // namespace slod::stress
