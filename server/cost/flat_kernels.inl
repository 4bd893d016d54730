// The body of the flat loop's kernels. Each flat_kernels_<isa>.cpp names its instruction set and the size of
// its registers, includes this, and has its own -march. As in simd/gravity_kernels.inl, lanes are targets and
// no inline function of another header is called.

#include "cost/flat_kernels.hpp"

namespace slod::cost::SLOD_ISA {
namespace {

typedef float Lanes __attribute__((vector_size(register_bytes)));
typedef std::uint32_t Bits __attribute__((vector_size(register_bytes)));

constexpr std::size_t lane_count = register_bytes / sizeof(float);
static_assert(flat_lanes % lane_count == 0);

Lanes load(const float* from)
{
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

void store(float* to, const Lanes& lanes)
{
    __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// cos 2 pi t, |t| below 2^22: with u = 1/4 - |t - whole| it is sin 2 pi u, whose series in 2 pi u, at most
/// pi / 2, is cut off at (pi / 2)^11 / 11! = 3.6e-6.
Lanes cosine_of_turns(const Lanes& turns)
{
    constexpr float to_whole = 0x1.8p23F; // adding it rounds to a whole number
    constexpr float s1 = 6.2831853F, s3 = -41.341702F, s5 = 81.605249F, s7 = -76.705860F, s9 = 42.058694F;
    const Lanes apart = turns - ((turns + to_whole) - to_whole);
    const Lanes u = 0.25F - (apart < 0 ? -apart : apart);
    const Lanes q = u * u;
    return u * (s1 + q * (s3 + q * (s5 + q * (s7 + q * s9))));
}

struct Place {
    Lanes x = {}, y = {}, z = {};
};

void bounce(Lanes& z, Lanes& vz, const FlatStep& step)
{
    const Lanes height = z - step.ground;
    const Lanes back = step.ground - step.restitution * height, up = -step.restitution * vz;
    const auto below = height < 0;
    vz = below && vz < 0 ? up : vz;
    z = below ? back : z;
}

/// Moves a register of droplets, in a wind besides the uniform one.
template <bool windy>
void move_lanes(const FlatDroplets& droplets, std::size_t i, const FlatStep& step, const Place& wind)
{
    const float taken = -step.decay_minus_1;
    const auto along = [&](const Lanes& x, const Lanes& v, std::size_t axis, const Lanes& air, Lanes& to_x,
                           Lanes& to_v) {
        to_x = x + (step.drift * v + step.shift[axis]);
        to_v = v + (step.decay_minus_1 * v + step.gain[axis]);
        if constexpr (windy) {
            to_x += step.carried * air;
            to_v += taken * air;
        }
    };
    Lanes x, y, z, vx, vy, vz;
    along(load(droplets.x + i), load(droplets.vx + i), 0, wind.x, x, vx);
    along(load(droplets.y + i), load(droplets.vy + i), 1, wind.y, y, vy);
    along(load(droplets.z + i), load(droplets.vz + i), 2, wind.z, z, vz);
    bounce(z, vz, step);
    store(droplets.x + i, x);
    store(droplets.y + i, y);
    store(droplets.z + i, z);
    store(droplets.vx + i, vx);
    store(droplets.vy + i, vy);
    store(droplets.vz + i, vz);
}

void move(const FlatDroplets& droplets, std::size_t first, std::size_t last, const FlatStep& step)
{
    const FlatStep own = step; // which no store can change
    for (std::size_t i = first; i < last; i += lane_count)
        move_lanes<false>(droplets, i, own, Place());
}

void move_in_waves(const FlatDroplets& droplets, std::size_t first, std::size_t last, const FlatStep& step,
                   const FlatWave* waves, std::size_t wave_count)
{
    const FlatStep own = step;
    for (std::size_t i = first; i < last; i += lane_count) {
        const Lanes x = load(droplets.x + i) + own.half_step * load(droplets.vx + i);
        const Lanes y = load(droplets.y + i) + own.half_step * load(droplets.vy + i);
        const Lanes z = load(droplets.z + i) + own.half_step * load(droplets.vz + i);
        Place wind;
        for (const FlatWave* wave = waves; wave < waves + wave_count; ++wave) {
            const float* k = wave->number;
            const Lanes cosine = cosine_of_turns(k[0] * x + (k[1] * y + (k[2] * z + wave->turns)));
            wind.x += wave->velocity[0] * cosine;
            wind.y += wave->velocity[1] * cosine;
            wind.z += wave->velocity[2] * cosine;
        }
        move_lanes<true>(droplets, i, own, wind);
    }
}

/// Bits that have nothing in common with those of other numbers (the finaliser of MurmurHash3).
Bits mixed(Bits bits)
{
    bits = (bits ^ (bits >> 16)) * 0x85ebca6bU;
    bits = (bits ^ (bits >> 13)) * 0xc2b2ae35U;
    return bits ^ (bits >> 16);
}

/// Numbers in (0, 1).
Lanes uniform(const Bits& bits)
{
    const auto top = __builtin_convertvector(bits >> 9, Lanes);
    return (top + 0.5F) * 0x1p-23F;
}

Lanes square_roots(const Lanes& values)
{
    Lanes roots;
    for (std::size_t lane = 0; lane < lane_count; ++lane)
        roots[lane] = __builtin_sqrtf(values[lane]);
    return roots;
}

void bear(const FlatDroplets& droplets, std::size_t to, std::size_t first, std::size_t last,
          std::size_t count, const FlatStream& stream, std::uint32_t key)
{
    const FlatStream own = stream;
    Bits number;
    for (std::size_t lane = 0; lane < lane_count; ++lane)
        number[lane] = std::uint32_t(first + lane);
    for (std::size_t i = first; i < last; i += lane_count, number += std::uint32_t(lane_count)) {
        const Bits bits = mixed(number ^ key);
        const Lanes cosine = 1 - uniform(mixed(bits + 1U)) * (1 - own.cone_cosine);
        const Lanes sine = square_roots(1 - cosine * cosine);
        const Lanes turns = uniform(mixed(bits + 2U));
        const Lanes speed = own.speed * (1 + own.speed_spread * (2 * uniform(mixed(bits + 3U)) - 1));
        const Lanes sideways = sine * cosine_of_turns(turns), other = sine * cosine_of_turns(turns - 0.25F);
        // Series in drag times age, of which three terms are enough below a tenth.
        const Lanes since = 1 - (__builtin_convertvector(number, Lanes) + 0.5F) / float(count);
        const Lanes age = own.step * since, loss = own.drag * age;
        const Lanes drift = age * (1 - loss * (1.0F / 2 - loss * (1.0F / 6 - loss / 24)));
        const Lanes fall = age * age * (1.0F / 2 - loss * (1.0F / 6 - loss * (1.0F / 24)));
        const Lanes taken = own.drag * drift;
        const auto start = [&](std::size_t axis, float* place, float* velocity) {
            const Lanes v = speed * (cosine * own.forward[axis] + sideways * own.side[axis] +
                                     other * own.other_side[axis]);
            const Lanes fallen = fall * own.gravity[axis] + (age - drift) * own.wind[axis];
            store(place + to + (i - first), own.position[axis] + drift * v + fallen);
            store(velocity + to + (i - first), v - taken * (v - own.wind[axis]) + drift * own.gravity[axis]);
        };
        start(0, droplets.x, droplets.vx);
        start(1, droplets.y, droplets.vy);
        start(2, droplets.z, droplets.vz);
    }
}

void triad(float* a, const float* b, const float* c, std::size_t first, std::size_t last)
{
    for (std::size_t i = first; i < last; i += lane_count)
        store(a + i, load(b + i) + 3 * load(c + i));
}

} // namespace

extern const FlatKernels table;
const FlatKernels table{name, move, move_in_waves, bear, triad};

} // namespace slod::cost::SLOD_ISA
