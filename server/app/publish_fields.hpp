#pragma once

#include <cstdint>

#include "cluster/conserved.hpp"
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

/// A snapshot that was not asked for conserved quantities has zeros.
inline bool is_measured(const ConservedQuantities& quantities)
{
    return quantities.mass != 0 || quantities.kinetic_energy != 0;
}

inline slod_v1_Vector message_of(const Vector3d& value)
{
    return {value.x(), value.y(), value.z()};
}

} // namespace slod
