#pragma once

#include <cstdint>
#include <vector>

#include "effects/emitter.hpp"

namespace slod::test {

/// Appends the particles of an emitter that start in frame `frame` and outlive it.
inline void add_newborns(const Emitter& emitter, std::uint64_t frame, double step,
                         const UniformFields& fields, std::vector<Newborn>& newborns)
{
    const Emitter::Starts starts = emitter.starts_in(frame, step);
    const std::size_t before = newborns.size();
    newborns.resize(before + starts.count);
    emitter.bear(starts, 0, {.fields = fields}, std::span(newborns).subspan(before));
    std::erase_if(newborns, [&](const Newborn& born) { return born.particle.expiry_frame <= frame; });
}

} // namespace slod::test
