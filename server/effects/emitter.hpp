#pragma once

#include <cstdint>
#include <vector>

#include "cluster/particles.hpp"
#include "effects/air.hpp"
#include "effects/colliders.hpp"
#include "effects/emitter_settings.hpp"
#include "effects/emitter_shape.hpp"
#include "effects/start_times.hpp"
#include "effects/uniform_fields.hpp"

namespace slod {

/// A particle on its way into the simulation, and how long before the frame's end it was born.
struct Newborn {
    Particle particle; ///< as it is at the end of the frame
    double age = 0;
    Vector3d from{
        0, 0, 0}; ///< where it came from on a straight way, to first order: its birth, unless it hit anything
};

/// One emitter. When particle k starts does not depend on the frames; everything about it depends on the
/// seed, the emitter and k alone.
class Emitter {
public:
    /// `index` is the emitter's place in the scene, `kind` that of its particles' kind.
    Emitter(const EmitterSettings& settings, std::uint32_t index, std::uint8_t kind, std::uint64_t seed);

    /// Particles started before `time`, which is the scene's.
    std::uint64_t count_before(double time) const;

    /// Appends the particles that start in frame `frame` (of length `step`, ending at frame * step), moved
    /// to the frame's end in `fields`, or in what of the `air` they feel, among `colliders` if there are any.
    /// Those whose lifetime ends within the frame are left out, and so are all after the first `room`;
    /// returns how many these are.
    std::uint64_t emit(std::uint64_t frame, double step, const UniformFields& fields, std::uint64_t room,
                       std::vector<Newborn>& newborns, const Colliders* colliders = nullptr,
                       const Air* air = nullptr) const;

    const EmitterSettings& settings() const { return settings_; }

    /// Ids of emitted particles have the emitter's place plus one above this bit, and k below it.
    static constexpr int id_shift = 48;
    static_assert(StartTimes::most == std::uint64_t{1} << id_shift);

private:
    double since_start(double time) const;
    Newborn newborn(std::uint64_t k, double start, double end, double step) const;
    Vector3d velocity_at_birth(Random& random) const;

    EmitterSettings settings_;
    StartTimes starts_;
    std::uint32_t index_;
    std::uint8_t kind_;
    std::uint64_t seed_;
    EmitterAxes axes_;
    EmitterShapeKind::Draw draw_offset_;
    double cone_cosine_;
};

} // namespace slod
