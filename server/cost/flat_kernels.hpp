#pragma once

#include <cstddef>
#include <cstdint>

namespace slod::cost {

/// Droplets as a loop without clusters keeps them: an array per coordinate. Lengths in m, times in s.
struct FlatDroplets {
    float *x, *y, *z, *vx, *vy, *vz;
};

/// Ranges of droplets are multiples of this: floats in the widest register.
inline constexpr std::size_t flat_lanes = 16;

/// One frame in gravity, linear drag and uniform wind, exactly, above a level ground:
/// x += drift v + shift, v += decay_minus_1 v + gain.
struct FlatStep {
    float drift, decay_minus_1;
    float shift[3], gain[3];
    float half_step, carried; ///< how far wind of unit velocity carries besides
    float ground;             ///< its z, far below where there is none
    float restitution;        ///< of the ground
};

/// A wave of the air at one time: velocity cos 2 pi (number . x + turns).
struct FlatWave {
    float number[3], velocity[3], turns;
};

/// Where droplets start from, and how: as EmitterSettings, the direction with two across it.
struct FlatStream {
    float position[3], forward[3], side[3], other_side[3];
    float speed, speed_spread, cone_cosine;
    float step, drag;
    float gravity[3], wind[3];
};

/// The loops for one instruction set.
struct FlatKernels {
    const char* name;

    /// Moves droplets [first, last) by a frame; one that would end below the ground has bounced meanwhile:
    /// height and vertical velocity are mirrored and shrink by the restitution, to first order in the step.
    void (*move)(const FlatDroplets& droplets, std::size_t first, std::size_t last, const FlatStep& step);

    /// Likewise, with the waves' wind at the middle of each droplet's frame.
    void (*move_in_waves)(const FlatDroplets& droplets, std::size_t first, std::size_t last,
                          const FlatStep& step, const FlatWave* waves, std::size_t wave_count);

    /// Starts `count` droplets, evenly spaced over a frame, and moves them to its end: those of [first, last)
    /// become the droplets from `to` on. Direction and speed are hashed of `key` and the droplet's number.
    void (*bear)(const FlatDroplets& droplets, std::size_t to, std::size_t first, std::size_t last,
                 std::size_t count, const FlatStream& stream, std::uint32_t key);

    /// a[i] = b[i] + 3 c[i] in [first, last): STREAM's triad (McCalpin 1995), the measure of memory.
    void (*triad)(float* a, const float* b, const float* c, std::size_t first, std::size_t last);
};

} // namespace slod::cost
