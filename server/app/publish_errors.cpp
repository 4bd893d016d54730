#include "app/publish_errors.hpp"

#include <utility>

namespace slod {
namespace {

slod_v1_EstimatedQuantile message_of(const ErrorQuantile& quantile)
{
    return {.value = quantile.value, .low = quantile.low, .high = quantile.high};
}

} // namespace

ErrorEncoder::ErrorEncoder(const wire::Uuid& session, std::string_view region)
{
    wire::set(message_.session, session);
    wire::set(message_.region, region);
}

const wire::ErrorEstimate& ErrorEncoder::encode(const ErrorEstimate& error, const FrameStamp& stamp,
                                                double target)
{
    stamp_next(message_, stamp);
    message_.oldest_frame = error.oldest_frame;
    message_.newest_frame = error.newest_frame;
    message_.samples = std::uint32_t(error.samples);
    message_.median = message_of(error.median);
    message_.p90 = message_of(error.p90);
    message_.p99 = message_of(error.p99);
    message_.max = error.max;
    message_.rms = error.rms;
    message_.target = target;
    return message_;
}

PublishedErrors::PublishedErrors(const wire::Participant& participant, const wire::Uuid& session,
                                 Outlet& outlet)
    : session_(session), outlet_(outlet), writer_(participant)
{}

void PublishedErrors::update(const std::shared_ptr<const ErrorReport>& report, const FrameStamp& stamp)
{
    if (std::exchange(last_, report) == report)
        return;
    std::set<std::string> told;
    if (report && report->all.samples > 0) {
        write({}, report->all, stamp, report->target);
        told.insert(std::string());
        for (const auto& [name, error] : report->regions) {
            write(name, error, stamp, 0);
            told.insert(name);
        }
    }
    forget_all_but(told);
}

void PublishedErrors::write(const std::string& region, const ErrorEstimate& error, const FrameStamp& stamp,
                            double target)
{
    ErrorEncoder& encoder = encoders_.try_emplace(region, session_, region).first->second;
    outlet_.send(writer_, encoder.encode(error, stamp, target));
}

void PublishedErrors::forget_all_but(const std::set<std::string>& told)
{
    std::erase_if(encoders_, [&](const auto& entry) {
        if (told.contains(entry.first))
            return false;
        wire::ErrorEstimate gone{};
        wire::set(gone.session, session_);
        wire::set(gone.region, entry.first);
        outlet_.forget(writer_, gone);
        return true;
    });
}

} // namespace slod
