#include "view/scene_bounds.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Dense>

namespace slod::view {

namespace {

double quantile(std::vector<double>& values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace

Ball bulk_of(const client::ClusterFrame& frame)
{
    std::vector<Vector> places;
    std::vector<double> spreads; ///< standard deviations of the clusters' particles
    for (const client::RegionClusters& region : frame.regions)
        for (std::size_t i = 0; i < region.mass.size(); ++i) {
            const float* const offset = &region.position[3 * i];
            places.emplace_back(region.origin[0] + offset[0], region.origin[1] + offset[1],
                                region.origin[2] + offset[2]);
            const float* const covariance = &region.covariance[6 * i];
            spreads.push_back(std::sqrt(double(covariance[0] + covariance[3] + covariance[5])));
        }
    if (places.empty())
        return {};
    Ball ball;
    std::vector<double> values(places.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(places, values.begin(), [axis](const Vector& place) { return place[axis]; });
        ball.centre[axis] = quantile(values, 0.5);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        values[i] = (places[i] - ball.centre).norm() + spreads[i];
    ball.radius = quantile(values, 0.9);
    return ball;
}

} // namespace slod::view
