// What nodes add to the sums of gravity_kernels.inl, which includes this: mass and second moments, for
// targets outside. All factors but the pull itself are powers of (size / distance): none overflows.

namespace slod::simd::SLOD_ISA {

namespace {

/// A node's second moments: of one for all lanes, or of one for each.
template <class Value>
struct SecondMoments {
    Value xx, xy, xz, yy, yz, zz; ///< 3 s
    Value trace;                  ///< half of theirs
};

template <class Real>
SecondMoments<Real> moments_of(const GravityNodes<Real>& nodes, std::size_t s)
{
    return {nodes.xx[s], nodes.xy[s], nodes.xz[s], nodes.yy[s], nodes.yz[s], nodes.zz[s], nodes.trace[s]};
}

/// What a node's second moments S = m s do to the pull of its mass, for a register of targets.
template <class Real>
struct Quadrupole {
    Lanes<Real> x, y, z; ///< 3 s d / r^2
    Lanes<Real> along;   ///< 15/2 d.s.d / r^4
    Lanes<Real> trace;   ///< 3/2 tr s / r^2
    Lanes<Real> factor;  ///< of the pull along d

    template <class Value>
    Quadrupole(const Pairs<Real>& pairs, const SecondMoments<Value>& s)
        : x(pairs.inverse_square * (s.xx * pairs.dx + s.xy * pairs.dy + s.xz * pairs.dz)),
          y(pairs.inverse_square * (s.xy * pairs.dx + s.yy * pairs.dy + s.yz * pairs.dz)),
          z(pairs.inverse_square * (s.xz * pairs.dx + s.yz * pairs.dy + s.zz * pairs.dz)),
          along(Real(2.5) * (pairs.inverse_square * (x * pairs.dx + y * pairs.dy + z * pairs.dz))),
          trace(pairs.inverse_square * s.trace), factor(1 + along - trace)
    {}
};

template <class Real>
struct NodesAcceleration {
    using Targets = GravityTargets<Real>;
    using Sources = GravityNodes<Real>;
    Acceleration<Real> sum;

    void add(const Pairs<Real>& pairs, const Sources& nodes, std::size_t s)
    {
        const Lanes<Real> pull = pairs.mass_by_r * pairs.inverse_square;
        const Quadrupole<Real> quadrupole(pairs, moments_of(nodes, s));
        sum.x += pull * (quadrupole.factor * pairs.dx - quadrupole.x);
        sum.y += pull * (quadrupole.factor * pairs.dy - quadrupole.y);
        sum.z += pull * (quadrupole.factor * pairs.dz - quadrupole.z);
    }

    void store(const Targets& targets, std::size_t first) const { sum.store(targets, first); }
};

/// The tide of one node is pull (3 s / r^2 + d v^T + v d^T - factor), with
/// v = ((3/2 + 7/2 along - 5/2 trace) d - 5 (3 s d / r^2)) / r^2.
template <class Real>
struct TideSums {
    Lanes<Real> xx = {}, xy = {}, xz = {}, yy = {}, yz = {}, zz = {};

    template <class Value>
    void add(const Lanes<Real>& pull, const Pairs<Real>& pairs, const SecondMoments<Value>& s,
             const Quadrupole<Real>& quadrupole)
    {
        const Lanes<Real> radial = Real(1.5) + Real(3.5) * quadrupole.along - Real(2.5) * quadrupole.trace;
        const Lanes<Real> vx = pairs.inverse_square * (radial * pairs.dx - 5 * quadrupole.x);
        const Lanes<Real> vy = pairs.inverse_square * (radial * pairs.dy - 5 * quadrupole.y);
        const Lanes<Real> vz = pairs.inverse_square * (radial * pairs.dz - 5 * quadrupole.z);
        const Lanes<Real>& inverse_square = pairs.inverse_square;
        xx += pull * (inverse_square * s.xx + 2 * (pairs.dx * vx) - quadrupole.factor);
        xy += pull * (inverse_square * s.xy + (pairs.dx * vy + vx * pairs.dy));
        xz += pull * (inverse_square * s.xz + (pairs.dx * vz + vx * pairs.dz));
        yy += pull * (inverse_square * s.yy + 2 * (pairs.dy * vy) - quadrupole.factor);
        yz += pull * (inverse_square * s.yz + (pairs.dy * vz + vy * pairs.dz));
        zz += pull * (inverse_square * s.zz + 2 * (pairs.dz * vz) - quadrupole.factor);
    }
};

template <class Real>
struct NodesAccelerationAndTide {
    using Targets = GravityTargets<Real>;
    using Sources = GravityNodes<Real>;
    Acceleration<Real> sum;
    TideSums<Real> tide;

    void add(const Pairs<Real>& pairs, const Sources& nodes, std::size_t s)
    {
        const Lanes<Real> pull = pairs.mass_by_r * pairs.inverse_square;
        const SecondMoments<Real> moments = moments_of(nodes, s);
        const Quadrupole<Real> quadrupole(pairs, moments);
        sum.x += pull * (quadrupole.factor * pairs.dx - quadrupole.x);
        sum.y += pull * (quadrupole.factor * pairs.dy - quadrupole.y);
        sum.z += pull * (quadrupole.factor * pairs.dz - quadrupole.z);
        tide.add(pull, pairs, moments, quadrupole);
    }

    void store(const Targets& targets, std::size_t first) const
    {
        sum.store(targets, first);
        add_to(targets.txx + first, tide.xx);
        add_to(targets.txy + first, tide.xy);
        add_to(targets.txz + first, tide.xz);
        add_to(targets.tyy + first, tide.yy);
        add_to(targets.tyz + first, tide.yz);
        add_to(targets.tzz + first, tide.zz);
    }
};

template <class Real, class Sums>
void add_nodes(const GravityTargets<Real>& targets, const GravityNodes<Real>& nodes)
{
    add<Real, Sums>(targets, nodes, no_self);
}

} // namespace

} // namespace slod::simd::SLOD_ISA
