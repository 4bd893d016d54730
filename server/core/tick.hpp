#pragma once

#include <cstdint>
#include <functional>

namespace slod {

/// Time now in nanoseconds since any fixed moment; used for profiles only. Any thread may call it,
/// several at once. Empty: none are made.
using Tick = std::function<std::int64_t()>;

/// Does the work; returns how long it took, 0 without a tick.
template <class Work>
std::int64_t nanoseconds_of(const Tick& tick, const Work& work)
{
    const std::int64_t start = tick ? tick() : 0;
    work();
    return tick ? tick() - start : 0;
}

} // namespace slod
