// What far nodes do about one point: FarPoint of gravity_kernels.hpp. gravity_kernels.inl includes this. Here
// the lanes of a register are nodes.

#include "simd/quadrupole_kernels.inl"

namespace slod::simd::SLOD_ISA {

namespace {

/// Sums over every so many nodes, in lanes.
template <class Real>
struct FarLanes {
    Lanes<Real> pull[3] = {}, third[10] = {}, fifth[3] = {}, fourth[15] = {}, sixth[6] = {}, seventh = {};
    TideSums<Real> tide;

    void add(const Pairs<Real>& pairs, const SecondMoments<Lanes<Real>>& moments, Real reach)
    {
        const Lanes<Real> by_r3 = pairs.mass_by_r * pairs.inverse_square;
        const Quadrupole<Real> quadrupole(pairs, moments);
        pull[0] += by_r3 * (quadrupole.factor * pairs.dx - quadrupole.x);
        pull[1] += by_r3 * (quadrupole.factor * pairs.dy - quadrupole.y);
        pull[2] += by_r3 * (quadrupole.factor * pairs.dz - quadrupole.z);
        tide.add(reach * by_r3, pairs, moments, quadrupole);

        const Lanes<Real> inverse = square_roots<Real>(pairs.inverse_square);
        const Lanes<Real> x = pairs.dx * inverse, y = pairs.dy * inverse, z = pairs.dz * inverse;
        const Lanes<Real> nearness = reach * inverse;
        const Lanes<Real> second = reach * by_r3 * nearness;
        add_higher(second, second * nearness, x, y, z);
    }

    /// `second` and `cube`: p (R/r)^2 and p (R/r)^3.
    void add_higher(const Lanes<Real>& second, const Lanes<Real>& cube, const Lanes<Real>& x,
                    const Lanes<Real>& y, const Lanes<Real>& z)
    {
        const Lanes<Real> xx = x * x, xy = x * y, xz = x * z, yy = y * y, yz = y * z, zz = z * z;
        const Lanes<Real> cubes[10] = {xx * x, xx * y, xx * z, xy * y, xy * z,
                                       xz * z, yy * y, yy * z, yz * z, zz * z};
        const Lanes<Real> squares[6] = {xx, xy, xz, yy, yz, zz};
        for (std::size_t i = 0; i < 10; ++i)
            third[i] += second * cubes[i];
        fifth[0] += second * x;
        fifth[1] += second * y;
        fifth[2] += second * z;
        for (std::size_t i = 0; i < 10; ++i)
            fourth[i] += cube * (x * cubes[i]);
        const Lanes<Real> last[5] = {yy * yy, yy * yz, yy * zz, yz * zz, zz * zz};
        for (std::size_t i = 0; i < 5; ++i)
            fourth[10 + i] += cube * last[i];
        for (std::size_t i = 0; i < 6; ++i)
            sixth[i] += cube * squares[i];
        seventh += cube;
    }

    void store(Real* terms) const
    {
        const auto put = [&](std::size_t term, const Lanes<Real>& sum) {
            add_to(terms + term * tile_width, sum);
        };
        const Lanes<Real> tides[6] = {tide.xx, tide.xy, tide.xz, tide.yy, tide.yz, tide.zz};
        for (std::size_t i = 0; i < 3; ++i)
            put(FarTerm::Pull + i, pull[i]);
        for (std::size_t i = 0; i < 6; ++i)
            put(FarTerm::Tide + i, tides[i]);
        for (std::size_t i = 0; i < 10; ++i)
            put(FarTerm::Third + i, third[i]);
        for (std::size_t i = 0; i < 3; ++i)
            put(FarTerm::Fifth + i, fifth[i]);
        for (std::size_t i = 0; i < 15; ++i)
            put(FarTerm::Fourth + i, fourth[i]);
        for (std::size_t i = 0; i < 6; ++i)
            put(FarTerm::Sixth + i, sixth[i]);
        put(FarTerm::Seventh, seventh);
    }
};

template <class Real>
void add_far_nodes(const FarPoint<Real>& point, const GravityNodes<Real>& nodes)
{
    for (std::size_t first = 0; first < tile_width; first += lane_count<Real>) {
        FarLanes<Real> sums;
        for (std::size_t s = first; s < nodes.count; s += tile_width) {
            Pairs<Real> pairs;
            pairs.dx = load(nodes.x + s);
            pairs.dy = load(nodes.y + s);
            pairs.dz = load(nodes.z + s);
            const Lanes<Real> square = pairs.dx * pairs.dx + pairs.dy * pairs.dy + pairs.dz * pairs.dz +
                                       (point.q + load(nodes.q + s));
            pairs.inverse_square = square > 0 ? 1 / square : Lanes<Real>{};
            pairs.mass_by_r = load(nodes.mass + s) * square_roots<Real>(pairs.inverse_square);
            sums.add(pairs,
                     {load(nodes.xx + s), load(nodes.xy + s), load(nodes.xz + s), load(nodes.yy + s),
                      load(nodes.yz + s), load(nodes.zz + s), load(nodes.trace + s)},
                     point.reach);
        }
        sums.store(point.terms + first);
    }
}

/// A pair of indices for each entry of a symmetric matrix.
constexpr std::size_t pair_of[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};

template <class Real>
void add_expansion(const GravityTargets<Real>& targets, const FarExpansion<Real>& far)
{
    const Real per_length = 1 / far.reach;
    Real* const accelerations[3] = {targets.ax, targets.ay, targets.az};
    Real* const tides[6] = {targets.txx, targets.txy, targets.txz, targets.tyy, targets.tyz, targets.tzz};
    for (std::size_t first = 0; first < targets.padded_count; first += lane_count<Real>) {
        const Lanes<Real> y[3] = {per_length * load(targets.x + first), per_length * load(targets.y + first),
                                  per_length * load(targets.z + first)};
        const Lanes<Real> yy[6] = {y[0] * y[0], 2 * (y[0] * y[1]), 2 * (y[0] * y[2]),
                                   y[1] * y[1], 2 * (y[1] * y[2]), y[2] * y[2]};
        Lanes<Real> slope[6]; // (a - pull) = slope y
        for (std::size_t e = 0; e < 6; ++e) {
            const Lanes<Real> once = far.third[Entry::of3[e][0]] * y[0] + far.third[Entry::of3[e][1]] * y[1] +
                                     far.third[Entry::of3[e][2]] * y[2];
            Lanes<Real> twice = far.fourth[Entry::of4[Entry::of3[e][0]][0]] * yy[0];
            for (std::size_t k = 1; k < 6; ++k)
                twice += far.fourth[Entry::of4[Entry::of3[e][pair_of[k][0]]][pair_of[k][1]]] * yy[k];
            slope[e] = far.tide[e] + (Real(0.5) * once + Real(1) / 6 * twice);
            if (targets.txx != nullptr)
                add_to<Real>(tides[e] + first, per_length * (far.tide[e] + (once + Real(0.5) * twice)));
        }
        for (std::size_t i = 0; i < 3; ++i)
            add_to<Real>(accelerations[i] + first,
                         far.pull[i] + (slope[Entry::of2[i][0]] * y[0] + slope[Entry::of2[i][1]] * y[1] +
                                        slope[Entry::of2[i][2]] * y[2]));
    }
}

} // namespace

} // namespace slod::simd::SLOD_ISA
