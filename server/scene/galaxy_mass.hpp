#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace slod {

/// Mass on a sphere (shell) or a circle (ring) about the centre.
struct MassAtRadius {
    double radius;
    double mass;
};

/// How mass grows with the radius: a table, from a quadrature.
class MassProfile {
public:
    /// `radii` ascend from 0; `mass_per_radius(r)` is dM/dr, scaled so that the whole has `mass`.
    MassProfile(std::vector<double> radii, const std::function<double(double)>& mass_per_radius, double mass);

    double outer_radius() const { return radii_.back(); }
    double mass_inside(double radius) const;

    /// The radius that holds this share, in [0, 1], of the mass.
    double radius_of(double share) const;

    /// One shell or ring in the middle of each interval of the table.
    std::vector<MassAtRadius> pieces() const;

private:
    std::vector<double> radii_;
    std::vector<double> inside_; ///< mass within radii_
};

/// Exponential disc with the density ~ exp(-R / scale_length) sech^2(z / scale_height), cut where less than
/// a thousandth of its mass is left.
struct DiscShape {
    double mass;
    double scale_length;
    double scale_height;

    double outer_radius() const { return 10 * scale_length; }
    double surface_density(double radius) const;
};

/// Mass of the disc by distance from its axis.
MassProfile disc_profile(const DiscShape& disc);

/// The disc's mass by distance from its centre, as shells.
std::vector<MassAtRadius> disc_shells(const DiscShape& disc, const MassProfile& profile);

/// Hernquist sphere (1990, ApJ 356, 359) that fades to nothing at its cut-off: the density is
/// ~ (1 - (r/cutoff)^2)^2 / (r (r + scale)^3). Cut sharply, no isotropic distribution of velocities
/// could hold its edge.
struct SpheroidShape {
    double mass;
    double scale_length;
    double cutoff;

    /// Up to a constant factor. `radius` > 0.
    double relative_density(double radius) const;
};

MassProfile spheroid_profile(const SpheroidShape& spheroid);

/// Potential of shells at `radius` from the centre, G = 1, Plummer-softened.
double shell_potential(std::span<const MassAtRadius> shells, double radius, double softening_squared);

/// Potential of rings in the plane z = 0 at `radius` from the axis and at a height with the square
/// `height_squared`, to which a softening may be added. G = 1.
double ring_potential(std::span<const MassAtRadius> rings, double radius, double height_squared);

} // namespace slod
