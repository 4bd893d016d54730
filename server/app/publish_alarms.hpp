#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/alarms.hpp"
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

    /// Writes those of a list that are new or say something else, if it is another list than the last, and
    /// disposes of those that it does not have. Null: there are none.
    void update(const std::shared_ptr<const std::vector<Alarm>>& alarms);

    std::size_t count() const { return told_.size(); }

private:
    wire::Alarm message_of(const Alarm& alarm) const;

    wire::Uuid session_;
    Outlet& outlet_;
    wire::Writer<wire::Alarm> writer_;
    std::shared_ptr<const std::vector<Alarm>> last_;
    std::map<std::string, Alarm> told_; ///< by name
};

} // namespace slod
