#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/attracting_world.hpp"
#include "support/case_rows.hpp"
#include "support/clouds.hpp"

// What second moments are worth, over the shapes that break tree codes.
namespace slod::test {
namespace {

constexpr std::size_t count = 20'000;

struct CloudOfBodies {
    const char* name;
    std::function<ParticleSet()> make;

    friend std::ostream& operator<<(std::ostream& out, const CloudOfBodies& cloud)
    {
        return out << cloud.name;
    }
};

class Quadrupoles : public testing::TestWithParam<CloudOfBodies> {
protected:
    Quadrupoles() : world_(walked(GetParam().make())) {}

    void act_by(Multipoles multipoles)
    {
        world_.settings.multipoles = multipoles;
        world_.rebuild();
    }

    ForceErrors geometric_errors(Multipoles multipoles, double angle)
    {
        act_by(multipoles);
        world_.settings.opening = OpeningCriterion::Geometric;
        world_.settings.opening_angle = angle;
        world_.evaluate();
        return force_errors(world_);
    }

    AttractingWorld world_;
};

INSTANTIATE_TEST_SUITE_P(
    Of, Quadrupoles,
    testing::Values(CloudOfBodies{"plummer_sphere", [] { return plummer_sphere(count, 1); }},
                    CloudOfBodies{"disc", [] { return cloud(count, 4, in_exponential_disc); }},
                    CloudOfBodies{"two_clumps", [] { return two_clumps(count, 1); }},
                    CloudOfBodies{"mass_spectrum", [] { return mass_spectrum(count, 2); }},
                    CloudOfBodies{"uniform_box", [] { return cloud(count, 3, in_unit_box); }}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(Quadrupoles, G13_BeatMonopolesAtEveryAngle)
{
    for (const double angle : {0.9, 0.7, 0.5, 0.3}) {
        const ForceErrors monopole = geometric_errors(Multipoles::Monopole, angle);
        const ForceErrors quadrupole = geometric_errors(Multipoles::Quadrupole, angle);
        expect_at_most("median error, of that of monopoles", quadrupole.median / monopole.median, 1);
        expect_at_most("99th percentile, of that of monopoles", quadrupole.p99 / monopole.p99, 1);
    }
}

// A node's terms are sums of one sign over 20,000 bodies, rounded by 20,000 / 2^53 = 2e-12 at most.
TEST_P(Quadrupoles, G13_TheRootsSecondMomentsAreTheDirectSum)
{
    act_by(Multipoles::Quadrupole);
    const ForceView::Node& root = world_.view.nodes.front();
    ASSERT_EQ(root.count, count);
    Matrix3d sum = Matrix3d::Zero();
    for (const PointMass& body : world_.bodies)
        sum += body.mass * (body.position - root.centre) * (body.position - root.centre).transpose();
    expect_at_most("relative error of the root's second moments",
                   (root.mass * world_.view.second_moments.front().matrix() - sum).norm() / sum.norm(),
                   1e-10);
}

TEST_P(Quadrupoles, BeatMonopolesWithFewerPairsAtTheDefaultTolerance)
{
    act_by(Multipoles::Monopole);
    const std::uint64_t pairs = world_.evaluate_again().interactions;
    const ForceErrors monopole = force_errors(world_);
    act_by(Multipoles::Quadrupole);
    EXPECT_LT(world_.evaluate_again().interactions, pairs);
    const ForceErrors quadrupole = force_errors(world_);
    EXPECT_LT(quadrupole.median, monopole.median);
    EXPECT_LT(quadrupole.p99, monopole.p99);
}

// A tide that left out its quadrupole's part would be no better than the monopole's.
TEST_P(Quadrupoles, TidesAreCloserToThoseOfAllPairs)
{
    const auto tides = [&] {
        std::vector<Matrix3d> result;
        for (std::size_t body = 0; body < world_.bodies.size(); body += 10)
            result.push_back(world_.tide(body));
        return result;
    };
    const auto median_error = [&](const std::vector<Matrix3d>& exact) {
        std::vector<double> errors;
        const std::vector<Matrix3d> found = tides();
        for (std::size_t i = 0; i < exact.size(); ++i)
            errors.push_back((found[i] - exact[i]).norm() / exact[i].norm());
        std::sort(errors.begin(), errors.end());
        return errors[errors.size() / 2];
    };
    world_.settings.direct_below = UINT32_MAX;
    world_.evaluate();
    const std::vector<Matrix3d> exact = tides();
    world_.settings.direct_below = 0;
    geometric_errors(Multipoles::Monopole, 0.7);
    const double monopole = median_error(exact);
    geometric_errors(Multipoles::Quadrupole, 0.7);
    EXPECT_LT(median_error(exact), 0.5 * monopole);
}

} // namespace
} // namespace slod::test
