#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/alarm.hpp"
#include "app/publish_outlet.hpp"
#include "idl/dds.hpp"

namespace slod {

/// The alarms as clients know them. Belongs to the publisher's thread.
class PublishedAlarms {
public:
    /// `outlet` must outlive it.
    PublishedAlarms(const wire::Participant& participant, const wire::Uuid& session, Outlet& outlet)
        : session_(session), outlet_(outlet), writer_(participant)
    {}

    /// Writes those that are new or say something else, and disposes of those that are not there any more.
    void update(const std::vector<Alarm>& present);

    std::size_t count() const { return told_.size(); }

private:
    wire::Alarm message_of(const Alarm& alarm) const;

    wire::Uuid session_;
    Outlet& outlet_;
    wire::Writer<wire::Alarm> writer_;
    std::map<std::string, Alarm> told_; ///< by name
};

} // namespace slod
