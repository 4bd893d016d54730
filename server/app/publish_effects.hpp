#pragma once

#include <memory>

#include "app/publish_fields.hpp"
#include "app/publish_outlet.hpp"
#include "app/publisher.hpp"
#include "idl/dds.hpp"

namespace slod {

/// The effects as clients know them. Belongs to the publisher's thread.
class PublishedEffects {
public:
    /// `outlet` must outlive it.
    PublishedEffects(const wire::Participant& participant, const wire::Uuid& session, Outlet& outlet);

    /// Whether anybody reads them. Any thread may ask.
    bool read() const { return writer_.matched(); }

    /// Writes a report, if it is another one than the last: a sample for each effect.
    void update(const std::shared_ptr<const EffectReport>& report);

private:
    wire::Uuid session_;
    Outlet& outlet_;
    wire::Writer<wire::EffectStats> writer_;
    std::shared_ptr<const EffectReport> last_;
    std::uint64_t serial_ = 0;
};

} // namespace slod
