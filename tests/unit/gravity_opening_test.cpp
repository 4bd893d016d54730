#include <array>

#include <gtest/gtest.h>

#include "gravity/opening.hpp"
#include "simd/kernels.hpp"
#include "support/attracting_world.hpp"
#include "support/clouds.hpp"

// The opening criterion by itself, for a group that is one body at the origin.
namespace slod::test {
namespace {

class OpeningTest : public testing::Test {
protected:
    OpeningTest()
        : world_(cloud(1, 1, [](Random&) { return Vector3d(0, 0, 0); })),
          targets_(world_.view.nodes.front()), pulls_{0}
    {
        targets_.q = 0;
    }

    /// Whether a node of this radius and mass at x = distance may act as one body.
    bool acts(double radius, double distance, double mass = 1, double q = 0, double blur = 0)
    {
        return role(radius, distance, mass, q, blur) != NodeRole::Opened;
    }

    /// As what it may.
    NodeRole role(double radius, double distance, double mass = 1, double q = 0, double blur = 0)
    {
        targets_.radius = float(reach_);
        const Allowance allowance = allowance_for(world_.view, targets_, settings_, G, pulls_, 0);
        std::array<double, simd::tile_width> x{distance}, nothing{}, masses{mass}, qs{q}, radii{radius},
            blurs{blur};
        std::array<std::uint8_t, simd::tile_width> roles{};
        simd::kernels().in_double.find_roles(opening_terms(world_.view, targets_, settings_, allowance),
                                             {roles.size(), x.data(), nothing.data(), nothing.data(),
                                              masses.data(), qs.data(), radii.data(), blurs.data()},
                                             roles.data());
        return NodeRole(roles.front());
    }

    static constexpr double G = 2;
    AttractingWorld world_;
    ForceView::Node targets_;
    double reach_ = 0; ///< that the targets count as having
    GravitySettings settings_{
        .multipoles = Multipoles::Monopole, .opening_angle = 0.5, .force_tolerance = 0.01};
    AlignedVector<double> pulls_; ///< of the one body
};

TEST_F(OpeningTest, TheGeometricCriterionLooksAtTheAngle)
{
    settings_.opening = OpeningCriterion::Geometric;
    pulls_[0] = 1e30;
    EXPECT_TRUE(acts(1, 2));
    EXPECT_FALSE(acts(1, 1.999));
    EXPECT_TRUE(acts(1, 2, 1e30));
}

TEST_F(OpeningTest, TheRelativeCriterionLooksAtTheError)
{
    pulls_[0] = 200; // G m r^2 / d^4 <= 0.01 * 200 at d = 1 for r = 0.5 and m = 4
    EXPECT_TRUE(acts(0.5, 1, 4));
    EXPECT_FALSE(acts(0.5, 1, 4.001));
    EXPECT_TRUE(acts(0.5, 2, 64));
    EXPECT_TRUE(acts(0.5, 1, 16, 1)); // softening makes the pull and its error smaller
}

TEST_F(OpeningTest, NoCriterionLetsAGroupBeWithinTheGuard)
{
    pulls_[0] = 1e30;
    EXPECT_TRUE(acts(0.899, 1));
    EXPECT_FALSE(acts(0.901, 1));
    settings_.opening = OpeningCriterion::Geometric;
    settings_.opening_angle = 2;
    EXPECT_TRUE(acts(0.899, 1));
    EXPECT_FALSE(acts(0.901, 1));
}

TEST_F(OpeningTest, ABodyWhosePullIsNotKnownAsksForTheGeometricCriterion)
{
    EXPECT_TRUE(acts(1, 2, 1e30));
    EXPECT_FALSE(acts(1, 1.999, 1e-30));
}

// Half of the node with q = 0 and half with 2 at d = 1: the mean is 1, (15/8 var)^(1/4) is 1.17, and the pull
// is (1 + 3^(-3/2)) / 2 = 0.60 instead of 2^(-3/2) = 0.35.
TEST_F(OpeningTest, NodesOfUnlikeSofteningAreOpenedNearby)
{
    pulls_[0] = 1;
    EXPECT_TRUE(acts(0, 1, 1, 1, 0));
    EXPECT_FALSE(acts(0, 1, 1, 1, 1.17));
    EXPECT_TRUE(acts(0, 10, 1, 1, 1.17));
    settings_.opening = OpeningCriterion::Geometric;
    EXPECT_FALSE(acts(0, 1, 1, 1, 1.17));
    EXPECT_TRUE(acts(0, 10, 1, 1, 1.17));
}

TEST_F(OpeningTest, ANodeWithoutExtentActsAsOneAtAnyDistance)
{
    for (const OpeningCriterion criterion : {OpeningCriterion::Geometric, OpeningCriterion::Relative}) {
        settings_.opening = criterion;
        pulls_[0] = 1;
        EXPECT_TRUE(acts(0, 1e-300));
        EXPECT_TRUE(acts(0, 0));
    }
}

TEST_F(OpeningTest, NodesArePointsUnlessSecondMomentsAreAskedFor)
{
    pulls_[0] = 200;
    EXPECT_EQ(role(0.5, 1, 4), NodeRole::Point);
    settings_.opening = OpeningCriterion::Geometric;
    EXPECT_EQ(role(1, 2), NodeRole::Point);
    settings_.multipoles = Multipoles::Quadrupole;
    EXPECT_EQ(role(1, 2), NodeRole::Extended);
    EXPECT_EQ(role(1, 1.999), NodeRole::Opened);
}

TEST_F(OpeningTest, NodesTakeSecondMomentsWhereTheirMassAloneWouldMissHalfOfWhatIsAllowed)
{
    settings_.multipoles = Multipoles::Quadrupole;
    pulls_[0] = 200; // G m r^2 / d^4 <= 1/2 0.01 * 200 at d = 1 for r = 0.5 and m = 2
    EXPECT_EQ(role(0.5, 1, 2), NodeRole::Point);
    EXPECT_EQ(role(0.5, 1, 2.001), NodeRole::Extended);
    EXPECT_EQ(role(0.5, 1, 64), NodeRole::Extended); // G m r^4 / d^6 <= 4 * 0.01 * 200
    EXPECT_EQ(role(0.5, 1, 64.001), NodeRole::Opened);
    EXPECT_EQ(role(0.5, 1, 512, 1), NodeRole::Extended); // softening makes the pull and its error smaller
    EXPECT_EQ(role(0.5, 1, 512.01, 1), NodeRole::Opened);
    pulls_[0] = 1e30;
    EXPECT_EQ(role(0.901, 1), NodeRole::Opened);
}

// Twice the allowance of 0.01 * 200 / G is 2: m (r + R)^4 / d^6 <= 2, with r = R = 0.25 and d = 1 for m = 32.
TEST_F(OpeningTest, NodesAreFarWhereBothRadiiAreSmallBesideTheDistance)
{
    settings_.multipoles = Multipoles::Quadrupole;
    pulls_[0] = 200;
    reach_ = 0.25;
    EXPECT_EQ(role(0.25, 1, 32), NodeRole::Far);
    EXPECT_NE(role(0.25, 1, 32.001), NodeRole::Far);
    EXPECT_EQ(role(0.25, 1, 32.001, 0.01), NodeRole::Far) << "softening makes the pull and its error smaller";
    EXPECT_EQ(role(0.649, 1, 1e-9), NodeRole::Far);
    EXPECT_NE(role(0.651, 1, 1e-9), NodeRole::Far) << "within the guard";
    reach_ = 0;
    EXPECT_EQ(role(0.25, 1, 2), NodeRole::Point) << "targets in one place need no expansion";
    EXPECT_EQ(role(0, 0, 2, 0.1), NodeRole::Point) << "nor of what is there, too";
    reach_ = 0.25;
    settings_.multipoles = Multipoles::Monopole;
    EXPECT_EQ(role(0.25, 1, 0.01), NodeRole::Point);
}

// Neither the fourth power of the blur nor that of the radius is above its bound here.
TEST_F(OpeningTest, SofterBodiesOnOneSideOpenANodeWithSecondMoments)
{
    settings_.multipoles = Multipoles::Quadrupole;
    pulls_[0] = 200; // G m r b^2 <= 0.01 * 200 at d = 1 for r = 0.5, b = 0.5 and m = 8
    EXPECT_EQ(role(0.5, 1, 8, 0, 0.5), NodeRole::Extended);
    EXPECT_EQ(role(0.5, 1, 8.001, 0, 0.5), NodeRole::Opened);
}

} // namespace
} // namespace slod::test
