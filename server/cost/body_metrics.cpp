#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "core/parallel.hpp"
#include "cost/metrics.hpp"

namespace slod::cost {
namespace {

constexpr std::size_t most_compared = 1500;
constexpr std::size_t shell_count = 9;

Points thinned(const Points& points)
{
    const std::size_t count = std::min(points.size(), most_compared);
    Points some;
    for (std::size_t i = 0; i < count; ++i)
        some.push_back(points[i * points.size() / count]);
    return some;
}

/// Mean distance of all pairs.
double mean_distance(const Points& a, const Points& b)
{
    std::vector<double> sums(a.size());
    for_each_block(a.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (const Vector3d& point : b)
                sums[i] += (a[i] - point).norm();
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0) / (double(a.size()) * double(b.size()));
}

Vector3d mean(const Points& points)
{
    const Vector3d sum = std::accumulate(points.begin(), points.end(), Vector3d(0, 0, 0));
    return sum / double(points.size());
}

/// What is within shells about the mean.
struct Shells {
    std::array<double, shell_count> share{};      ///< of the points
    std::array<double, shell_count> dispersion{}; ///< root mean square of the velocity about its mean
};

Shells shells_of(const Points& x, const Points& v, const std::array<double, shell_count>& ends)
{
    std::array<Vector3d, shell_count> momentum;
    momentum.fill(Vector3d(0, 0, 0));
    std::array<double, shell_count> number{}, squares{};
    const Vector3d centre = mean(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto end = std::upper_bound(ends.begin(), ends.end(), (x[i] - centre).norm());
        if (end == ends.end())
            continue;
        const auto shell = std::size_t(end - ends.begin());
        number[shell] += 1;
        momentum[shell] += v[i];
        squares[shell] += v[i].squaredNorm();
    }
    Shells shells;
    for (std::size_t shell = 0; shell < shell_count; ++shell) {
        const double count = std::max(number[shell], 1.0);
        shells.share[shell] = number[shell] / double(x.size());
        shells.dispersion[shell] =
            std::sqrt(std::max(squares[shell] / count - (momentum[shell] / count).squaredNorm(), 0.0));
    }
    return shells;
}

/// Mean of |ln(a / b)|, where nothing counts as `least`.
double mean_log_ratio(const std::array<double, shell_count>& a, const std::array<double, shell_count>& b,
                      double least)
{
    double sum = 0;
    for (std::size_t shell = 0; shell < shell_count; ++shell)
        sum += std::abs(std::log(std::max(a[shell], least) / std::max(b[shell], least)));
    return sum / double(shell_count);
}

} // namespace

double energy_distance(const Points& a, const Points& b)
{
    if (a.empty() || b.empty())
        return a.empty() && b.empty() ? 0 : std::numeric_limits<double>::infinity();
    const Points some_a = thinned(a), some_b = thinned(b);
    const double between = 2 * mean_distance(some_a, some_b);
    return std::sqrt(std::max(between - mean_distance(some_a, some_a) - mean_distance(some_b, some_b), 0.0));
}

ProfileDistances profile_distances(const Points& reference_x, const Points& reference_v, const Points& x,
                                   const Points& v)
{
    if (reference_x.size() <= shell_count || x.size() <= shell_count)
        return {};
    std::array<double, shell_count> ends;
    for (std::size_t shell = 0; shell < shell_count; ++shell)
        ends[shell] = lagrangian_radius(reference_x, double(shell + 1) / double(shell_count + 1));
    const Shells wanted = shells_of(reference_x, reference_v, ends), found = shells_of(x, v, ends);
    const double slowest = 1e-6 * *std::max_element(wanted.dispersion.begin(), wanted.dispersion.end());
    return {.density = mean_log_ratio(wanted.share, found.share, 0.5 / double(x.size())),
            .dispersion = slowest > 0 ? mean_log_ratio(wanted.dispersion, found.dispersion, slowest) : 0};
}

double thickness(const Points& points)
{
    const std::size_t half = points.size() / 2;
    if (half < 2)
        return 0;
    const Vector3d centre = mean(points);
    Points inner = points;
    std::nth_element(inner.begin(), inner.begin() + std::ptrdiff_t(half), inner.end(),
                     [&](const Vector3d& a, const Vector3d& b) {
                         return (a - centre).squaredNorm() < (b - centre).squaredNorm();
                     });
    inner.resize(half);
    const Vector3d middle = mean(inner);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Vector3d& point : inner)
        moments += (point - middle) * (point - middle).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments / double(half), Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(axes.eigenvalues()[0], 0.0));
}

} // namespace slod::cost
