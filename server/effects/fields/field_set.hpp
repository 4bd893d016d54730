#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "core/tick.hpp"
#include "effects/fields/field_count.hpp"
#include "effects/fields/list.hpp"

namespace slod {

/// A setting's numbers in order, to sort the elements of a table by: so that the order in the file, which
/// means nothing, changes no rounding.
template <class Settings>
std::vector<double> sort_key(Settings settings) // for_each_field takes what it may change
{
    std::vector<double> key;
    for_each_field(settings, [&]<class T>(const Field&, const T& value) {
        if constexpr (std::is_same_v<T, Vector3d>)
            key.insert(key.end(), value.data(), value.data() + 3);
        else
            key.push_back(double(value));
    });
    return key;
}

template <class List>
class FieldSet;

/// The active elements of the effects of one list. Elements of no strength are left out.
template <PlaceField... F>
class FieldSet<FieldList<F...>> {
public:
    using List = FieldList<F...>;
    using Counts = std::array<FieldCount, List::size>;

    FieldSet(const FieldSettings& settings, const FieldSource& source, Tick tick = {})
        : tick_(std::move(tick))
    {
        (take<F>(settings, source), ...);
    }

    bool empty() const { return (all<F>().empty() && ...); }

    /// Whether the gradient is a symmetric matrix everywhere.
    bool symmetric() const { return ((F::symmetric || all<F>().empty()) && ...); }

    /// Whether the fields are the same at every place.
    bool uniform() const
    {
        const auto everywhere = []<class E>(const Element<E>& element) {
            if constexpr (requires { element.field.uniform(); })
                return element.field.uniform();
            else
                return false;
        };
        const auto of = [&](const auto& elements) {
            return std::all_of(elements.begin(), elements.end(), everywhere);
        };
        return (of(all<F>()) && ...);
    }

    /// How far the nearest boundary of any of them is from a place; infinite where none has one.
    double clearance(const Vector3d& x) const
    {
        double least = std::numeric_limits<double>::infinity();
        const auto look = [&]<class E>(const std::vector<Element<E>>& elements) {
            if constexpr (HasBoundary<E>)
                for (const Element<E>& element : elements)
                    least = std::min(least, element.field.clearance(x));
        };
        (look(all<F>()), ...);
        return least;
    }

    /// Whether one of them has a boundary, which clusters may straddle.
    bool has_boundary() const { return std::isfinite(clearance({0, 0, 0})); }

    FieldValue at(const Vector3d& x, double time) const
    {
        FieldValue sum;
        const auto add = [&](const auto& elements) {
            for (const auto& element : elements)
                if (element.bounds.contains(x))
                    element.field.add(x, time, sum);
        };
        (add(all<F>()), ...);
        return sum;
    }

    /// Potential energy of a body at `x`, of second moments `extent` about it [mass length^2], in the effects
    /// that have a potential: to second order in its size.
    double energy(const Vector3d& x, double mass, const Matrix3d& extent) const
    {
        double sum = 0;
        const auto add = [&]<class E>(const std::vector<Element<E>>& elements) {
            if constexpr (HasPotential<E>)
                for (const Element<E>& element : elements) {
                    FieldValue field;
                    element.field.add(x, 0, field);
                    sum +=
                        mass * element.field.potential(x) - 0.5 * extent.cwiseProduct(field.gradient).sum();
                }
        };
        (add(all<F>()), ...);
        return sum;
    }

    /// Adds the fields at `place(i)` to `sums[i]` for i in [first, last) of `wanted(i)`: effect by effect in
    /// the order of the list, each only where its bounds are. Any thread may call it.
    template <class Wanted, class Place>
    void add(std::size_t first, std::size_t last, const Wanted& wanted, const Place& place, double time,
             FieldValue* sums)
    {
        std::size_t row = 0;
        const auto add_timed = [&](const auto& elements) {
            Tally& tally = tallies_[row++];
            if (!elements.empty())
                tally.ns += nanoseconds_of(
                    tick_, [&] { add_all(elements, tally, first, last, wanted, place, time, sums); });
        };
        (add_timed(all<F>()), ...);
    }

    /// Counts all fields as evaluated for so many clusters, where one value of uniform() fields serves them.
    void count_for_all(std::uint64_t clusters)
    {
        std::size_t row = 0;
        const auto count = [&](const auto& elements) {
            Tally& tally = tallies_[row++];
            tally.calls += clusters > 0 ? elements.size() : 0;
            tally.clusters += elements.size() * clusters;
        };
        (count(all<F>()), ...);
    }

    /// Counts a cluster at `x`, none of whose members is farther from there than `reach`, for each element
    /// whose boundary is nearer. Any thread may call it.
    void count_straddling(const Vector3d& x, double reach)
    {
        std::size_t row = 0;
        const auto count = [&]<class E>(const std::vector<Element<E>>& elements) {
            Tally& tally = tallies_[row++];
            if constexpr (HasBoundary<E>)
                for (const Element<E>& element : elements)
                    if (element.field.clearance(x) < reach)
                        ++tally.straddling;
        };
        (count(all<F>()), ...);
    }

    /// What add(), count_for_all() and count_straddling() did since the last call of this.
    Counts take_counts()
    {
        Counts counts;
        for (std::size_t row = 0; row < List::size; ++row)
            counts[row] = {tallies_[row].calls.exchange(0), tallies_[row].clusters.exchange(0),
                           tallies_[row].straddling.exchange(0)};
        return counts;
    }

    /// Time that add() took since the last call of this, on all threads together.
    std::array<std::int64_t, List::size> take_times_ns()
    {
        std::array<std::int64_t, List::size> times;
        for (std::size_t row = 0; row < List::size; ++row)
            times[row] = tallies_[row].ns.exchange(0);
        return times;
    }

private:
    template <class E>
    struct Element {
        E field;
        Box bounds;
    };

    /// Sums of whole numbers, which come out the same in any order.
    struct Tally {
        std::atomic<std::uint64_t> calls{0}, clusters{0}, straddling{0};
        std::atomic<std::int64_t> ns{0};
    };

    template <class E>
    const std::vector<Element<E>>& all() const
    {
        return std::get<std::vector<Element<E>>>(elements_);
    }

    template <class E>
    void take(const FieldSettings& settings, const FieldSource& source)
    {
        const auto table = elements(settings.of<E>());
        std::vector<typename E::Settings> sorted(table.begin(), table.end());
        std::sort(sorted.begin(), sorted.end(),
                  [](const auto& a, const auto& b) { return sort_key(a) < sort_key(b); });
        for (const auto& each : sorted)
            if (const E field(each, source); field.acts())
                std::get<std::vector<Element<E>>>(elements_).push_back({field, field.bounds()});
    }

    template <class E, class Wanted, class Place>
    static void add_all(const std::vector<Element<E>>& elements, Tally& tally, std::size_t first,
                        std::size_t last, const Wanted& wanted, const Place& place, double time,
                        FieldValue* sums)
    {
        for (const Element<E>& element : elements) {
            std::uint64_t evaluated = 0;
            Asking asking(element.field, time);
            for (std::size_t i = first; i < last; ++i) {
                if (!wanted(i))
                    continue;
                const Vector3d x = place(i);
                if (!element.bounds.contains(x))
                    continue;
                asking.add(x, sums[i]);
                ++evaluated;
            }
            tally.calls += evaluated > 0 ? 1 : 0;
            tally.clusters += evaluated;
        }
    }

    Tick tick_;
    std::tuple<std::vector<Element<F>>...> elements_;
    std::array<Tally, List::size> tallies_;
};

} // namespace slod
