#include "cost/metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "core/parallel.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t directions = 64;

/// Directions on the half sphere, as evenly as a spiral spreads them.
Vector3d direction(std::size_t index)
{
    const double z = (double(index) + 0.5) / double(directions);
    const double azimuth = double(index) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(azimuth), across * std::sin(azimuth), z};
}

std::vector<double> sorted_along(const Points& points, const Vector3d& axis)
{
    std::vector<double> values;
    values.reserve(points.size());
    for (const Vector3d& point : points)
        values.push_back(point.dot(axis));
    std::sort(values.begin(), values.end());
    return values;
}

/// Area between the two quantile functions.
double wasserstein(const std::vector<double>& a, const std::vector<double>& b)
{
    const double step_a = 1 / double(a.size()), step_b = 1 / double(b.size());
    double area = 0, at = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const double end_a = double(i + 1) * step_a, end_b = double(j + 1) * step_b;
        const double end = std::min(end_a, end_b);
        area += std::max(end - at, 0.0) * std::abs(a[i] - b[j]);
        at = end;
        i += end_a <= end_b ? 1U : 0U;
        j += end_b <= end_a ? 1U : 0U;
    }
    return area;
}

using CubeKey = std::array<std::int64_t, 3>;

struct HashCube {
    std::size_t operator()(const CubeKey& key) const
    {
        std::uint64_t hash = 0;
        for (const std::int64_t coordinate : key)
            hash = (hash ^ std::uint64_t(coordinate)) * 0x9e3779b97f4a7c15;
        return hash ^ (hash >> 32);
    }
};

Vector3d mean(const Points& points)
{
    Vector3d sum(0, 0, 0);
    for (const Vector3d& point : points)
        sum += point;
    return points.empty() ? sum : Vector3d(sum / double(points.size()));
}

} // namespace

Points positions(const ParticleSet& particles)
{
    Points points;
    for (const Particle& particle : particles)
        points.push_back(particle.position);
    return points;
}

Points velocities(const ParticleSet& particles)
{
    Points points;
    for (const Particle& particle : particles)
        points.push_back(particle.velocity);
    return points;
}

double sliced_wasserstein(const Points& a, const Points& b)
{
    if (a.empty() || b.empty())
        return a.empty() && b.empty() ? 0 : std::numeric_limits<double>::infinity();
    std::array<double, directions> along{};
    for_each_task(directions, [&](std::size_t index) {
        const Vector3d axis = direction(index);
        along[index] = wasserstein(sorted_along(a, axis), sorted_along(b, axis));
    });
    return std::accumulate(along.begin(), along.end(), 0.0) / double(directions);
}

double density_distance(const Points& a, const Points& b, double cube_side)
{
    if (a.empty() || b.empty())
        return a.empty() && b.empty() ? 0 : 1;
    std::unordered_map<CubeKey, std::array<std::uint64_t, 2>, HashCube> counts;
    const auto count = [&](const Points& points, std::size_t cloud) {
        for (const Vector3d& point : points) {
            CubeKey key;
            for (std::size_t axis = 0; axis < 3; ++axis)
                key[axis] = std::int64_t(std::floor(point[int(axis)] / cube_side));
            ++counts[key][cloud];
        }
    };
    count(a, 0);
    count(b, 1);
    std::vector<double> differences;
    for (const auto& [key, in] : counts)
        differences.push_back(std::abs(double(in[0]) / double(a.size()) - double(in[1]) / double(b.size())));
    std::sort(differences.begin(), differences.end()); // so that the sum's rounding is the same each time
    return std::accumulate(differences.begin(), differences.end(), 0.0) / 2;
}

double rms_radius(const Points& points)
{
    if (points.size() < 2)
        return 0;
    const Vector3d centre = mean(points);
    double sum = 0;
    for (const Vector3d& point : points)
        sum += (point - centre).squaredNorm();
    return std::sqrt(sum / double(points.size()));
}

double lagrangian_radius(const Points& points, double share)
{
    if (points.empty())
        return 0;
    const Vector3d centre = mean(points);
    std::vector<double> radii;
    for (const Vector3d& point : points)
        radii.push_back((point - centre).norm());
    const auto rank = std::size_t(std::clamp(share * double(radii.size()), 1.0, double(radii.size()))) - 1;
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(rank), radii.end());
    return radii[rank];
}

double median_displacement(const ParticleSet& a, const ParticleSet& b)
{
    std::vector<double> distances;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i].id == b[j].id)
            distances.push_back((a[i].position - b[j].position).norm());
        const std::uint64_t id_a = a[i].id, id_b = b[j].id;
        i += id_a <= id_b ? 1U : 0U;
        j += id_b <= id_a ? 1U : 0U;
    }
    if (distances.empty())
        return std::numeric_limits<double>::quiet_NaN();
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

} // namespace slod::cost
