#include "scene/galaxy_disc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/portable_math.hpp"
#include "scene/galaxy_quantiles.hpp"

namespace slod {

DiscModel::DiscModel(const DiscShape& shape, double softening, double toomre_q,
                     const std::function<double(double)>& spheroid_potential)
    : profile_(disc_profile(shape)), field_(shape, softening, spheroid_potential), orbits_(field_, toomre_q),
      layers_(field_), rms_swing_(DiscField::radius_steps + 1, Swing{1, 1})
{
    for (std::size_t i = 1; i <= DiscField::radius_steps; ++i) {
        const double radius = field_.radius(double(i));
        Swing mean_squares{0, 0};
        for (std::size_t q = 0; q < std::tuple_size_v<NormalQuantiles>; ++q) {
            const Swing one = swing(radius, orbits_.at(radius, deviate_of_quantile(q)).guiding_radius);
            mean_squares.height += share_of_quantile(q) * one.height * one.height;
            mean_squares.velocity += share_of_quantile(q) * one.velocity * one.velocity;
        }
        rms_swing_[i] = {std::sqrt(mean_squares.height), std::sqrt(mean_squares.velocity)};
    }
}

/// A star whose guiding radius is further in was made for a stronger vertical pull. Where that changes
/// slowly, its action stays and its height goes with frequency^(-1/2); here the radial oscillation is as
/// fast as the vertical one, and to first order the exponent is -m, m = 2 nu^2 / (4 nu^2 - kappa^2). With
/// one thickness everywhere the vertical frequency nu goes with the vertical dispersion.
DiscModel::Swing DiscModel::swing(double radius, double guiding_radius) const
{
    const double thickness =
        field_.shape().scale_height * std::numbers::pi / std::sqrt(12.0); // rms of sech^2
    const double vertical = layers_.dispersion(radius) / thickness;
    const double radial = orbits_.epicyclic_frequency(radius);
    const double excess = 4 * vertical * vertical - radial * radial;
    const double exponent = excess > 0 ? std::min(2 * vertical * vertical / excess, 1.0) : 1;
    const double logarithm = portable_log(layers_.dispersion(guiding_radius) / layers_.dispersion(radius));
    return {portable_exp(exponent * logarithm), portable_exp((1 - exponent) * logarithm)};
}

PhasePoint DiscModel::star(const QuietNumbers::Point& random) const
{
    const double radius = profile_.radius_of(random[0]);
    const SineCosine turn = portable_sincos(2 * std::numbers::pi * random[1]);
    const double layer = 0.5 * field_.shape().scale_height * portable_log(random[2] / (1 - random[2]));
    const auto [radial_deviate, orbit_deviate] = normal_pair(random[3], random[4]);
    const double vertical_deviate = normal_pair(random[5], random[6])[0];

    const OrbitInPlane orbit = orbits_.at(radius, orbit_deviate);
    const Swing own = swing(radius, orbit.guiding_radius);
    const Swing& usual = rms_swing_[std::size_t(field_.radius_index(radius) + 0.5)];
    const double height = own.height / usual.height * layer;
    const double radial = orbit.radial_dispersion * radial_deviate;
    const Vector3d velocity{radial * turn.cosine - orbit.azimuthal * turn.sine,
                            radial * turn.sine + orbit.azimuthal * turn.cosine,
                            own.velocity / usual.velocity *
                                layers_.velocity(radius, layer, vertical_deviate)};
    constexpr double most_of_escape = 0.95;
    const double limit = most_of_escape * field_.escape_speed(radius, height);
    const double speed = std::sqrt(velocity.squaredNorm());
    return {{radius * turn.cosine, radius * turn.sine, height}, std::min(1.0, limit / speed) * velocity};
}

} // namespace slod
