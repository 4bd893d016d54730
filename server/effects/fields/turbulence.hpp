#pragma once

#include <array>

#include "effects/fields/field.hpp"

namespace slod {

/// Air in eddies of many sizes.
struct TurbulenceSettings {
    double amplitude = 1;      ///< root mean square speed of the air; scene length / time
    double length = 4;         ///< wave length of the largest eddies; scene length
    std::uint32_t octaves = 3; ///< sizes of eddies, each half of the one before
    double time = 8;           ///< in which the largest eddies change; scene time, inf for frozen ones

    friend bool operator==(const TurbulenceSettings&, const TurbulenceSettings&) = default;
};

/// Octaves at most.
inline constexpr std::uint32_t max_octaves = 6;

template <class Visitor>
void for_each_field(TurbulenceSettings& turbulence, Visitor&& visit)
{
    visit(Field{"amplitude", "length/time", "Root mean square speed of the air.", 0, 1e30},
          turbulence.amplitude);
    visit(Field{"length", "length", "Wave length of the largest eddies; more than 0.", 0, 1e30},
          turbulence.length);
    visit(Field{"octaves", "", "Sizes of eddies, each half of the one before.", 1, max_octaves},
          turbulence.octaves);
    visit(Field{"time", "time", "In which the largest eddies change; more than 0.", 0, no_maximum, true},
          turbulence.time);
}

/// Curl noise as a sum of random waves, k x a cos 2 pi (k . x + w t + phase): each is the curl of a wave, so
/// the sum has no divergence, and a gradient in closed form (Kraichnan 1970, Phys. Fluids 13, 22; Fung et al.
/// 1992, J. Fluid Mech. 236, 281). Speeds of octave n fall as 2^(-n/3) and times as 2^(-2n/3), as those of
/// eddies do by Kolmogorov's law.
class Turbulence {
public:
    using Settings = TurbulenceSettings;
    using Table = std::optional<Settings>;
    static constexpr std::string_view name = "turbulence";
    static constexpr std::string_view help = "Air in eddies of many sizes; needs a drag.";
    static constexpr bool symmetric = false;

    static Problems problems(const Settings& settings, double step);

    Turbulence(const Settings& settings, const FieldSource& source);

    bool acts() const { return settings_.amplitude != 0; }
    Box bounds() const { return unbounded(); }
    void add(const Vector3d& x, double time, FieldValue& sum) const;
    void add_all(std::span<const Vector3d> places, double time, std::span<FieldValue* const> sums) const;

    /// velocity cos 2 pi (number . x + rate t + phase)
    struct Wave {
        Vector3d number, velocity; ///< 1 / length; length / time
        double rate, phase;        ///< 1 / time; turns
    };
    std::vector<Wave> waves() const; ///< that the field is the sum of

private:
    static constexpr std::size_t waves_of_octave = 12;
    static constexpr std::size_t most_waves = max_octaves * waves_of_octave;

    using Shifts = std::array<double, most_waves>;

    simd::Waves waves_at(double time, Shifts& shifts) const;
    void add_some(std::span<const Vector3d> places, const simd::Waves& waves,
                  std::span<FieldValue* const> sums) const;

    Settings settings_;
    const simd::WaveKernels* kernels_;
    std::array<std::vector<double>, 3> number_, velocity_; ///< by wave, as Wave
    std::vector<double> rate_, phase_;
};

} // namespace slod
