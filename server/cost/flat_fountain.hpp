#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/aligned.hpp"
#include "cost/flat_kernels.hpp"
#include "effects/fields/turbulence.hpp"
#include "effects/uniform_fields.hpp"
#include "sim/settings.hpp"

namespace slod::cost {

/// Those of an instruction set, by the names of simd::KernelTable.
const FlatKernels& flat_kernels(std::string_view isa);

/// The fountain as a good program without clusters has it: single precision, an array per coordinate, loops
/// over whole registers of the fastest instruction set, in parallel on the threads of the caller's team.
/// Droplets of one age are a batch, and all live equally long: a ring of batches needs neither compaction nor
/// ages, as those born take the places of those that die.
class FlatFountain {
public:
    /// Streams, fields, the ground (an upright plane) if there is one, and the air of `scene`. Each stream
    /// has `per_frame` droplets a frame, a multiple of flat_lanes, that live `lifetime` frames.
    FlatFountain(const SimulationSettings& scene, std::size_t per_frame, std::size_t lifetime,
                 std::string_view isa);

    /// Moves all droplets through one frame, of which the newborn see a part. They feel the turbulence from
    /// their second frame on.
    void step();

    std::size_t alive() const; ///< droplets, at the places [0, alive()) of the arrays

    /// Place of the droplets that a stream bore in the last step: per_frame of them, the oldest first.
    std::size_t newborn(std::size_t stream) const;

    Vector3d position(std::size_t droplet) const;
    Vector3d velocity(std::size_t droplet) const;

    /// Bytes that one droplet's move reads and writes.
    static constexpr double bytes_per_move = 2 * 6 * sizeof(float);

private:
    FlatDroplets droplets();
    std::vector<FlatWave> waves_now() const;
    void move(std::size_t first, std::size_t last, const std::vector<FlatWave>& waves);

    const FlatKernels* kernels_;
    FlatStep step_{};
    std::vector<FlatStream> streams_;
    std::vector<Turbulence::Wave> waves_;
    double duration_; ///< of a frame
    std::size_t per_frame_, lifetime_;
    std::uint64_t frame_ = 0;
    std::array<AlignedVector<float>, 6> arrays_; ///< x, y, z, vx, vy, vz; by batch
};

} // namespace slod::cost
