#include "stress/server_use.hpp"

#include <algorithm>

namespace slod::stress {

namespace {

double longest_standstill_s(std::span<const ServerSample> samples)
{
    double longest = 0;
    double moved = samples.front().when_s;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].frame != samples[i - 1].frame)
            moved = samples[i - 1].when_s;
        longest = std::max(longest, samples[i].when_s - moved);
    }
    return longest;
}

/// Mean over the samples that speak of a frame not spoken of before.
double mean_encode_ms(std::span<const ServerSample> samples)
{
    double sum = 0;
    std::uint64_t count = 0;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i].published_frames > samples[i - 1].published_frames) {
            sum += samples[i].encode_ms;
            ++count;
        }
    return count > 0 ? sum / double(count) : 0;
}

} // namespace

ServerUse use_of(std::span<const ServerSample> samples)
{
    ServerUse use;
    if (samples.size() < 2)
        return use;
    const ServerSample& first = samples.front();
    const ServerSample& last = samples.back();
    use.seconds = last.when_s - first.when_s;
    use.frames = last.frame - first.frame;
    use.published_frames = last.published_frames - first.published_frames;
    use.delayed_frames = last.delayed_frames - first.delayed_frames;
    use.refused_samples = last.refused_samples - first.refused_samples;
    use.longest_standstill_s = longest_standstill_s(samples);
    if (use.seconds > 0) {
        use.frame_rate_hz = double(use.frames) / use.seconds;
        use.published_mb_s = double(last.published_bytes - first.published_bytes) * 1e-6 / use.seconds;
    }
    if (use.frames > 0) {
        use.encode_ms = mean_encode_ms(samples) * double(use.published_frames) / double(use.frames);
        if (first.network_s && last.network_s)
            use.network_ms = (*last.network_s - *first.network_s) * 1e3 / double(use.frames);
        if (first.processor_s && last.processor_s)
            use.processor_ms = (*last.processor_s - *first.processor_s) * 1e3 / double(use.frames);
    }
    for (const ServerSample& sample : samples)
        use.work_ms += sample.work_ms / double(samples.size());
    use.start_mib = first.resident_mib;
    use.middle_mib = samples[samples.size() / 2].resident_mib;
    use.end_mib = last.resident_mib;
    return use;
}

std::optional<double> processor_growth_percent(const ServerUse& rest, const ServerUse& load)
{
    if (!rest.processor_ms || !load.processor_ms || !(*rest.processor_ms + load.encode_ms > 0))
        return {};
    return 100 * (*load.processor_ms / (*rest.processor_ms + load.encode_ms) - 1);
}

std::optional<double> memory_growth_mib(const ServerUse& load)
{
    if (!load.middle_mib || !load.end_mib)
        return {};
    return *load.end_mib - *load.middle_mib;
}

} // namespace slod::stress
