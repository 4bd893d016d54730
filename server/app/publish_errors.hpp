#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "app/publish_fields.hpp"
#include "app/publish_outlet.hpp"
#include "app/publisher.hpp"
#include "idl/dds.hpp"

namespace slod {

/// Turns what is known of one region's error, or of all, into messages.
class ErrorEncoder {
public:
    /// `region` is empty for all particles.
    ErrorEncoder(const wire::Uuid& session, std::string_view region);

    /// The message is valid until the next call.
    const wire::ErrorEstimate& encode(const ErrorEstimate& error, const FrameStamp& stamp, double target);

private:
    wire::ErrorEstimate message_{};
};

/// The errors as clients know them. Belongs to the publisher's thread.
class PublishedErrors {
public:
    /// `outlet` must outlive it.
    PublishedErrors(const wire::Participant& participant, const wire::Uuid& session, Outlet& outlet);

    /// Whether anybody reads them. Any thread may ask.
    bool read() const { return writer_.matched(); }

    /// Writes a report, if it is another one than the last. What was said of regions that it does not have
    /// is disposed of.
    void update(const std::shared_ptr<const ErrorReport>& report, const FrameStamp& stamp);

private:
    void write(const std::string& region, const ErrorEstimate& error, const FrameStamp& stamp, double target);
    void forget_all_but(const std::set<std::string>& told);

    wire::Uuid session_;
    Outlet& outlet_;
    wire::Writer<wire::ErrorEstimate> writer_;
    std::shared_ptr<const ErrorReport> last_;
    std::map<std::string, ErrorEncoder> encoders_; ///< by region
};

} // namespace slod
