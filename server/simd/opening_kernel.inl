// Which nodes act as one body: OpeningTerms of gravity_kernels.hpp. gravity_kernels.inl includes this. The
// lanes of a register are nodes.
//
// Bounds are compared as ratios of lengths, each no more than about 1 where it matters, times a mass: the
// powers by themselves leave the range of a float.

namespace slod::simd::SLOD_ISA {

namespace {

template <class Real>
Lanes<Real> larger(const Lanes<Real>& a, const Lanes<Real>& b)
{
    return a > b ? a : b;
}

template <class Real>
Lanes<Real> inverse_or_0(const Lanes<Real>& value)
{
    return value > 0 ? 1 / value : Lanes<Real>{};
}

/// Distance along one axis from the targets' box.
template <class Real>
Lanes<Real> gap(Real lower, Real upper, const Lanes<Real>& x)
{
    return larger<Real>(larger<Real>(lower - x, x - upper), Lanes<Real>{});
}

template <class Real>
void find_roles(const OpeningTerms<Real>& terms, const NodesInQuestion<Real>& nodes, std::uint8_t* roles)
{
    for (std::size_t first = 0; first < nodes.padded_count; first += lane_count<Real>) {
        const Lanes<Real> x = load(nodes.x + first), y = load(nodes.y + first), z = load(nodes.z + first);
        const Lanes<Real> mass = load(nodes.mass + first), q = load(nodes.q + first);
        const Lanes<Real> radius = load(nodes.radius + first), blur = load(nodes.blur + first);
        const Lanes<Real> square = radius * radius, blur_square = blur * blur;

        const Lanes<Real> from_centre = x * x + y * y + z * z;
        const Lanes<Real> t_far = from_centre + (q + terms.q), by_t_far = inverse_or_0<Real>(t_far);
        const Lanes<Real> size = radius + terms.reach, size_square = size * size;
        const Lanes<Real> s_far = size_square * by_t_far, b_far = blur_square * by_t_far;
        const auto far = (size_square <= terms.far_guard * from_centre) &
                         (mass * (s_far * s_far) <= terms.far_error * t_far) &
                         (mass * (b_far * b_far) <= terms.error * t_far) &
                         (Real(1.5) * mass * (terms.q_spread * by_t_far) <= terms.error * t_far);

        const Lanes<Real> gap_x = gap<Real>(terms.lower[0], terms.upper[0], x);
        const Lanes<Real> gap_y = gap<Real>(terms.lower[1], terms.upper[1], y);
        const Lanes<Real> gap_z = gap<Real>(terms.lower[2], terms.upper[2], z);
        const Lanes<Real> from_box = gap_x * gap_x + gap_y * gap_y + gap_z * gap_z;
        const Lanes<Real> t = from_box + q, by_t = inverse_or_0<Real>(t);
        const Lanes<Real> r = square * by_t, b = blur_square * by_t;
        const auto one =
            (square <= terms.guard * from_box) & (b <= terms.most_blur) & (mass * (b * b) <= terms.error * t);
        const auto point = mass * r <= terms.point_error * t;
        const auto extended = (mass * (r * r) <= terms.extended_error * t) &
                              (mass * (b * square_roots<Real>(r)) <= terms.error * t);

        const Lanes<Real> as_one =
            point ? Lanes<Real>{} + Real(NodeRole::Point)
                  : (extended ? Lanes<Real>{} + Real(NodeRole::Extended) : Lanes<Real>{});
        const Lanes<Real> role = far ? Lanes<Real>{} + Real(NodeRole::Far) : (one ? as_one : Lanes<Real>{});
        for (std::size_t lane = 0; lane < lane_count<Real>; ++lane)
            roles[first + lane] = static_cast<std::uint8_t>(role[lane]);
    }
}

} // namespace

} // namespace slod::simd::SLOD_ISA
