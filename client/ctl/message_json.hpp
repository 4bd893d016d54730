#pragma once

#include "ctl/output.hpp"
#include "idl/messages.hpp"

namespace slod::ctl {

/// A message's fields, named as in slod.idl; of the server's state and statistics ordered as slodctl status
/// and stats have them, without what was not measured.
Json json_of(const wire::Clusters& message);
Json json_of(const wire::Overview& message);
Json json_of(const wire::FrameManifest& message);
Json json_of(const wire::Members& message);
Json json_of(const wire::Stats& message);
Json json_of(const wire::EffectStats& message);
Json json_of(const wire::ErrorEstimate& message);
Json json_of(const wire::Alarm& message);
Json json_of(const wire::RoiState& message);
Json json_of(const wire::ServerState& message);
Json json_of(const wire::Command& message);
Json json_of(const wire::CommandReply& message);
Json json_of(const wire::View& message);

} // namespace slod::ctl
