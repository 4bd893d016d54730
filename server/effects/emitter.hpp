#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cluster/particles.hpp"
#include "effects/air.hpp"
#include "effects/colliders.hpp"
#include "effects/emitter_settings.hpp"
#include "effects/emitter_shape.hpp"
#include "effects/start_times.hpp"
#include "effects/uniform_fields.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// A particle on its way into the simulation, and how long before the frame's end it was born.
struct Newborn {
    Particle particle; ///< as it is at the end of the frame
    double age = 0;
    Vector3d from{
        0, 0, 0}; ///< where it came from on a straight way, to first order: its birth, unless it hit anything
};

/// What newborns fly through up to the end of their first frame. Null: there are none.
struct Surroundings {
    UniformFields fields{};
    const Colliders* colliders = nullptr;
    const Air* air = nullptr; ///< that they feel instead of the fields
};

/// One emitter. When particle k starts does not depend on the frames; everything about it depends on the
/// seed, the emitter and k alone.
class Emitter {
public:
    /// `index` is the emitter's place in the scene, `kind` that of its particles' kind.
    Emitter(const EmitterSettings& settings, std::uint32_t index, std::uint8_t kind, std::uint64_t seed,
            const simd::NumberKernels& numbers = simd::kernels().numbers);

    /// Particles started before `time`, which is the scene's.
    std::uint64_t count_before(double time) const;

    /// The particles that start in a frame.
    struct Starts {
        std::uint64_t frame; ///< ends at frame * step
        double step;
        std::uint64_t first, count; ///< k of the first
        StartTimes::Window window;
    };
    Starts starts_in(std::uint64_t frame, double step) const;

    /// Writes those from first + `from` on, as many as there is room for, moved to the frame's end. Who ends
    /// within the frame, by lifetime or by a collider, has an expiry frame that is not after it.
    void bear(const Starts& starts, std::uint64_t from, const Surroundings& surroundings,
              std::span<Newborn> newborns) const;

    const EmitterSettings& settings() const { return settings_; }

    /// Ids of emitted particles have the emitter's place plus one above this bit, and k below it.
    static constexpr int id_shift = 48;
    static_assert(StartTimes::most == std::uint64_t{1} << id_shift);

private:
    /// Random numbers of some particles in a row: of each the direction's cosine, the sine and cosine of its
    /// turn about the axis, the speed, and what the shape asks for.
    struct Draws {
        static constexpr std::size_t particles = 128; ///< at most
        static constexpr std::size_t of_velocity = 3; ///< numbers, the second for the turn
        static constexpr std::size_t numbers = 8;     ///< at most, in pairs
        std::array<std::array<double, particles>, numbers> uniform;
        std::array<double, particles> sine, cosine;
    };
    static_assert(Draws::of_velocity + EmitterShapeKind::most_numbers <= Draws::numbers);

    double since_start(double time) const;
    void draw(std::uint64_t k, std::size_t count, Draws& draws) const;
    Newborn newborn(std::uint64_t k, double start, const Starts& starts, const Draws& draws,
                    std::size_t place) const;
    Vector3d velocity_at_birth(const Draws& draws, std::size_t place) const;
    static void fly(Newborn& born, const Surroundings& surroundings, std::uint64_t frame, double end);

    EmitterSettings settings_;
    StartTimes starts_;
    std::uint32_t index_;
    std::uint8_t kind_;
    std::uint64_t seed_;
    const simd::NumberKernels& numbers_;
    EmitterAxes axes_;
    const EmitterShapeKind& shape_;
    double cone_cosine_;
};

} // namespace slod
