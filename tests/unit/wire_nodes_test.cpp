#include "wire_snapshots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "app/publish_nodes.hpp"

namespace slod {
namespace {

constexpr std::size_t cluster_count = 5000;

struct Totals {
    double mass = 0;
    std::uint64_t particles = 0;
    Vector3d momentum{0, 0, 0};
    Vector3d moment{0, 0, 0};                  ///< sum of mass times position
    Matrix3d second_moment = Matrix3d::Zero(); ///< about the scene's origin
    double size = 0;                           ///< sum of |mass times position|, for tolerances
};

void add(Totals& totals, const PublishedNode& node)
{
    totals.mass += node.mass;
    totals.particles += node.particles;
    totals.momentum += node.mass * node.velocity;
    totals.moment += node.mass * node.position;
    totals.second_moment +=
        node.mass * (node.covariance.matrix() + node.position * node.position.transpose());
    totals.size += node.mass * node.position.norm();
}

std::vector<PublishedNode> nodes_of(const ClusterStates& states, std::size_t limit)
{
    NodeGroups groups;
    groups.form(states, limit);
    std::vector<PublishedNode> nodes;
    for (std::size_t i = 0; i < groups.size(); ++i)
        nodes.push_back(sum_of(states, groups[i]));
    return nodes;
}

Totals totals_of(const std::vector<PublishedNode>& nodes)
{
    Totals totals;
    for (const PublishedNode& node : nodes)
        add(totals, node);
    return totals;
}

/// Every sum has at most cluster_count additions of positive or mixed terms, each rounded by half an ulp, and
/// a mean is divided and multiplied back once: relative to the sum of magnitudes, cluster_count + 4 half
/// ulps.
constexpr double rounding = (cluster_count + 4) * std::numeric_limits<double>::epsilon() / 2;

class NodeLimit : public testing::TestWithParam<std::size_t> {};

TEST_P(NodeLimit, ConservesMassMomentumAndParticles)
{
    const ClusterStates states = made_up_clusters(cluster_count, 3);
    const Totals before = totals_of(nodes_of(states, cluster_count));
    const Totals after = totals_of(nodes_of(states, GetParam()));
    EXPECT_EQ(after.particles, before.particles);
    EXPECT_NEAR(after.mass, before.mass, rounding * before.mass);
    // Speeds are below 6 in each direction: the sum of |momenta| is below 6 sqrt(3) times the mass.
    EXPECT_LT((after.momentum - before.momentum).norm(), rounding * 6 * std::sqrt(3) * before.mass);
    EXPECT_LT((after.moment - before.moment).norm(), rounding * before.size);
}

TEST_P(NodeLimit, ConservesSecondMoments)
{
    const ClusterStates states = made_up_clusters(cluster_count, 4);
    const Totals before = totals_of(nodes_of(states, cluster_count));
    const Totals after = totals_of(nodes_of(states, GetParam()));
    // Entries are sums of products of coordinates below 1100, each with two more roundings.
    const double magnitude = before.mass * 1100 * 1100;
    EXPECT_LT((after.second_moment - before.second_moment).cwiseAbs().maxCoeff(), 3 * rounding * magnitude);
}

TEST_P(NodeLimit, IsRespectedAndReached)
{
    const ClusterStates states = made_up_clusters(cluster_count, 5);
    EXPECT_EQ(nodes_of(states, GetParam()).size(), std::min(GetParam(), cluster_count));
}

TEST_P(NodeLimit, PutsEveryClusterIntoExactlyOneGroup)
{
    const ClusterStates states = made_up_clusters(cluster_count, 6);
    NodeGroups groups;
    groups.form(states, GetParam());
    std::vector<std::uint32_t> rows;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_LE(groups[i].size(), groups.clusters_per_group());
        rows.insert(rows.end(), groups[i].begin(), groups[i].end());
    }
    std::sort(rows.begin(), rows.end());
    std::vector<std::uint32_t> all(cluster_count);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(rows, all);
}

INSTANTIATE_TEST_SUITE_P(WireNodes, NodeLimit, testing::Values(1, 2, 3, 64, 999, 4096, 4999, 5000, 6000));

TEST(WireNodes, ClustersThatFitAreNotTouched)
{
    const ClusterStates states = made_up_clusters(100, 7);
    const std::vector<PublishedNode> nodes = nodes_of(states, 100);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        EXPECT_EQ(nodes[i].position, states.position[i]);
        EXPECT_EQ(nodes[i].velocity, states.velocity[i]);
        EXPECT_EQ(nodes[i].mass, states.mass[i]);
        EXPECT_EQ(nodes[i].id, states.id[i]);
        EXPECT_EQ(nodes[i].formation, states.formation[i]);
    }
}

// Two clumps far apart, their clusters alternating in the arrays: with room for two nodes, each is one.
TEST(WireNodes, NeighboursShareANode)
{
    ClusterStates states = made_up_clusters(64, 8);
    for (std::size_t row = 0; row < states.size(); row += 2)
        states.position[row].x() += 1e6;
    NodeGroups groups;
    groups.form(states, 2);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        std::set<bool> clumps;
        for (const std::uint32_t row : groups[i])
            clumps.insert(row % 2 == 0);
        EXPECT_EQ(clumps.size(), 1U);
    }
}

TEST(WireNodes, ARegionHasItsOwnClustersAlone)
{
    const ClusterStates states = made_up_clusters(90, 9);
    std::vector<std::uint32_t> own;
    for (std::uint32_t row = 0; row < states.size(); row += 3)
        own.push_back(row);
    NodeGroups groups;
    groups.form(states, own, 10);
    EXPECT_EQ(groups.clusters(), 30U);
    for (std::size_t i = 0; i < groups.size(); ++i)
        for (const std::uint32_t row : groups[i])
            EXPECT_EQ(row % 3, 0U);
}

TEST(WireNodes, WeightlessClustersWeighByTheirParticles)
{
    ClusterStates states = made_up_clusters(2, 10);
    states.mass = {0, 0};
    states.count = {1, 3};
    states.position = {Vector3d(0, 0, 0), Vector3d(4, 0, 0)};
    const PublishedNode node = sum_of(states, std::vector<std::uint32_t>{0, 1});
    EXPECT_EQ(node.mass, 0);
    EXPECT_EQ(node.particles, 4U);
    EXPECT_EQ(node.position, Vector3d(3, 0, 0));
}

TEST(WireNodes, NoClustersMakeNoNodes)
{
    NodeGroups groups;
    groups.form({}, 10);
    EXPECT_EQ(groups.size(), 0U);
    EXPECT_EQ(groups.origin(), Vector3d(0, 0, 0));
}

// A place that is not a number must not take the server down with it.
TEST(WireNodes, AClusterWithoutAPlaceIsStillCounted)
{
    ClusterStates states = made_up_clusters(50, 11);
    states.position[20].y() = std::numeric_limits<double>::quiet_NaN();
    states.position[21].x() = std::numeric_limits<double>::infinity();
    NodeGroups groups;
    groups.form(states, 7);
    std::size_t clusters = 0;
    for (std::size_t i = 0; i < groups.size(); ++i)
        clusters += groups[i].size();
    EXPECT_EQ(clusters, 50U);
}

} // namespace
} // namespace slod
