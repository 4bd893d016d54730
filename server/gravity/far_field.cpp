#include "gravity/far_field.hpp"

#include <algorithm>

namespace slod {
namespace {

using namespace simd::FarTerm;
using namespace simd::Entry;

/// Indices of symmetric tensors' entries, as FarTerm has them: x, y and z are 0, 1 and 2.
constexpr std::size_t triples[10][3] = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 1, 1}, {0, 1, 2},
                                        {0, 2, 2}, {1, 1, 1}, {1, 1, 2}, {1, 2, 2}, {2, 2, 2}};
constexpr std::size_t quadruples[15][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 2}, {0, 0, 1, 1},
                                           {0, 0, 1, 2}, {0, 0, 2, 2}, {0, 1, 1, 1}, {0, 1, 1, 2},
                                           {0, 1, 2, 2}, {0, 2, 2, 2}, {1, 1, 1, 1}, {1, 1, 1, 2},
                                           {1, 1, 2, 2}, {1, 2, 2, 2}, {2, 2, 2, 2}};

constexpr double delta(std::size_t i, std::size_t j)
{
    return i == j ? 1 : 0;
}

/// One index of a symmetric tensor summed up with a vector, for the entries that differ in that index.
double with(const double* tensor, const std::size_t (&entries)[3], const Vector3d& v)
{
    return tensor[entries[0]] * v[0] + tensor[entries[1]] * v[1] + tensor[entries[2]] * v[2];
}

} // namespace

Expansion moved(const Expansion& expansion, const Vector3d& offset, double reach)
{
    const Vector3d s = offset / expansion.reach;
    const double ratio = reach / expansion.reach;
    double fourth_s[10], third_s[6], fourth_ss[6], tide_s[3], third_ss[3], fourth_sss[3];
    for (std::size_t e = 0; e < 10; ++e)
        fourth_s[e] = with(expansion.fourth, of4[e], s);
    for (std::size_t e = 0; e < 6; ++e) {
        third_s[e] = with(expansion.third, of3[e], s);
        fourth_ss[e] = with(fourth_s, of3[e], s);
    }
    for (std::size_t e = 0; e < 3; ++e) {
        tide_s[e] = with(expansion.tide, of2[e], s);
        third_ss[e] = with(third_s, of2[e], s);
        fourth_sss[e] = with(fourth_ss, of2[e], s);
    }
    Expansion result{};
    result.reach = reach;
    for (std::size_t e = 0; e < 3; ++e)
        result.pull[e] = expansion.pull[e] + (tide_s[e] + (third_ss[e] / 2 + fourth_sss[e] / 6));
    for (std::size_t e = 0; e < 6; ++e)
        result.tide[e] = ratio * (expansion.tide[e] + (third_s[e] + fourth_ss[e] / 2));
    for (std::size_t e = 0; e < 10; ++e)
        result.third[e] = ratio * ratio * (expansion.third[e] + fourth_s[e]);
    for (std::size_t e = 0; e < 15; ++e)
        result.fourth[e] = ratio * ratio * ratio * expansion.fourth[e];
    return result;
}

Expansion operator+(const Expansion& a, const Expansion& b)
{
    Expansion sum = a;
    for (std::size_t e = 0; e < 3; ++e)
        sum.pull[e] += b.pull[e];
    for (std::size_t e = 0; e < 6; ++e)
        sum.tide[e] += b.tide[e];
    for (std::size_t e = 0; e < 10; ++e)
        sum.third[e] += b.third[e];
    for (std::size_t e = 0; e < 15; ++e)
        sum.fourth[e] += b.fourth[e];
    return sum;
}

template <class Real>
void FarField<Real>::begin(const ForceView::Node& targets)
{
    static_assert(most_nodes % simd::tile_width == 0);
    centre_ = targets.centre;
    reach_ = double(targets.radius) * units_.per_length;
    q_ = targets.q * units_.per_length * units_.per_length;
    count_ = added_ = 0;
    terms_.fill(0);
}

template <class Real>
void FarField<Real>::add(const ForceView::Node& node, const Symmetric3& second_moments)
{
    if (count_ == most_nodes)
        flush();
    nodes_.put(count_, node.centre - centre_, node.mass, node.q, units_);
    nodes_.put_moments(count_++, second_moments, units_);
    ++added_;
}

template <class Real>
void FarField<Real>::flush()
{
    const std::size_t padded = (count_ + simd::tile_width - 1) / simd::tile_width * simd::tile_width;
    nodes_.pad(count_, padded);
    alignas(64) std::array<Real, simd::FarTerm::count * simd::tile_width> sums{};
    kernels_.add_far_nodes({Real(q_), Real(reach_), sums.data()}, nodes_.list(padded));
    for (std::size_t term = 0; term < terms_.size(); ++term)
        for (std::size_t lane = 0; lane < simd::tile_width; ++lane)
            terms_[term] += double(sums[term * simd::tile_width + lane]);
    count_ = 0;
}

/// The derivatives of (d d + q)^(-1/2): products of n components over r^(2n + 1) times 1 3 5.. (2n - 1), less
/// those with one pair of components taken out, and so on.
template <class Real>
Expansion FarField<Real>::sum()
{
    if (count_ > 0)
        flush();
    const auto& t = terms_;
    Expansion far{};
    far.reach = reach_;
    std::copy_n(&t[Pull], 3, far.pull);
    std::copy_n(&t[Tide], 6, far.tide);
    for (std::size_t e = 0; e < 10; ++e) {
        const auto [i, j, k] = triples[e];
        const double one_pair =
            delta(i, j) * t[Fifth + k] + delta(i, k) * t[Fifth + j] + delta(j, k) * t[Fifth + i];
        far.third[e] = 15 * t[Third + e] - 3 * one_pair;
    }
    const auto sixth = [&](std::size_t i, std::size_t j) { return t[Sixth + of2[i][j]]; };
    for (std::size_t e = 0; e < 15; ++e) {
        const auto [i, j, k, l] = quadruples[e];
        const double one_pair = delta(i, j) * sixth(k, l) + delta(i, k) * sixth(j, l) +
                                delta(i, l) * sixth(j, k) + delta(j, k) * sixth(i, l) +
                                delta(j, l) * sixth(i, k) + delta(k, l) * sixth(i, j);
        const double two_pairs =
            delta(i, j) * delta(k, l) + delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k);
        far.fourth[e] = 105 * t[Fourth + e] - 15 * one_pair + 3 * two_pairs * t[Seventh];
    }
    return far;
}

template class FarField<float>;
template class FarField<double>;

} // namespace slod
