#pragma once

#include <cstdint>

#include "core/vectors.hpp"
#include "idl/messages.hpp"

namespace slod {

/// Which frame a message speaks of.
struct FrameStamp {
    std::uint64_t frame = 0;
    double time = 0; ///< scene time
};

/// Numbers and stamps the next sample of a topic.
template <class Message>
void stamp_next(Message& message, const FrameStamp& stamp)
{
    ++message.serial;
    message.frame = stamp.frame;
    message.time = stamp.time;
}

inline slod_v1_Vector message_of(const Vector3d& value)
{
    return {value.x(), value.y(), value.z()};
}

} // namespace slod
