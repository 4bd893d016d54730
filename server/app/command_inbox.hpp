#pragma once

#include <cstddef>
#include <vector>

#include "app/requests.hpp"
#include "idl/dds.hpp"

namespace slod {

/// Where clients' commands and views arrive. Taken from by the loop's thread between frames; never waits.
class CommandInbox {
public:
    /// `participant` must outlive the inbox. Throws wire::DdsError. `session` is this server's: what is meant
    /// for another is left out.
    CommandInbox(const wire::Participant& participant, const wire::Uuid& session)
        : session_(session), commands_(participant), views_(participant)
    {}

    /// At most `limit` commands, in the order in which each client sent its own. The rest stay for the next
    /// call. Valid until then.
    const std::vector<Request>& take_requests(std::size_t limit);

    /// The newest view of each client that has moved.
    const std::vector<ClientView>& take_views();

private:
    wire::Uuid session_;
    wire::Reader<wire::Command> commands_;
    wire::Reader<wire::View> views_;
    std::vector<Request> requests_;
    std::vector<ClientView> client_views_;
};

} // namespace slod
