#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "support/default_fields.hpp"

// What holds for every effect of place, by itself. An effect that is added to the list is tested by this.
namespace slod::test {
namespace {

constexpr int places = 200;

/// Around the origin, where default settings act.
Vector3d some_place(std::uint64_t index)
{
    Random random(7, 0, index);
    Vector3d x;
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = 3 * random.uniform() - 1.5;
    return x;
}

template <class F>
class EffectOfPlace : public testing::Test {
protected:
    typename F::Settings settings_;
    F field_{settings_, FieldSource{5}};

    FieldValue at(const Vector3d& x, double time) const
    {
        FieldValue sum;
        field_.add(x, time, sum);
        return sum;
    }
};

TYPED_TEST_SUITE(EffectOfPlace, TestTypes<AllFields>::Types, FieldName);

TYPED_TEST(EffectOfPlace, ActsAsItIsByDefault)
{
    EXPECT_TRUE(this->field_.acts());
    EXPECT_EQ(TypeParam::problems(this->settings_, 1.0 / 60), Problems{});
    double largest = 0;
    for (int i = 0; i < places; ++i)
        largest = std::max(largest, this->at(some_place(i), 0.3).value.norm());
    EXPECT_GT(largest, 0);
}

// Central differences with steps h and 2 h: the error of the first is a third of how they differ, and the
// values' rounding over h.
TYPED_TEST(EffectOfPlace, HasTheGradientOfItsValue)
{
    constexpr double h = 0x1p-12;
    for (int i = 0; i < places; ++i) {
        const Vector3d x = some_place(i);
        const FieldValue here = this->at(x, 0.3);
        for (int axis = 0; axis < 3; ++axis) {
            const auto difference = [&](double step) -> Vector3d {
                const Vector3d d = step * Vector3d::Unit(axis);
                return (this->at(x + d, 0.3).value - this->at(x - d, 0.3).value) / (2 * step);
            };
            const Vector3d fine = difference(h), coarse = difference(2 * h);
            const double tolerance = (fine - coarse).norm() + 16 * 0x1p-52 / h * (1 + here.value.norm());
            EXPECT_LE((here.gradient.col(axis) - fine).norm(), tolerance)
                << x.transpose() << " axis " << axis;
        }
    }
}

TYPED_TEST(EffectOfPlace, IsSymmetricIfItSaysSo)
{
    double largest = 0;
    for (int i = 0; i < places; ++i) {
        const Matrix3d gradient = this->at(some_place(i), 0.3).gradient;
        largest = std::max(largest, (gradient - gradient.transpose()).norm() / (1 + gradient.norm()));
    }
    if (TypeParam::symmetric)
        EXPECT_LE(largest, 8 * 0x1p-52);
    else
        EXPECT_GT(largest, 0.01) << "what is symmetric saves a column by saying so";
}

TYPED_TEST(EffectOfPlace, IsTheSlopeOfItsPotentialWhereItHasOne)
{
    if constexpr (HasPotential<TypeParam>) {
        constexpr double h = 0x1p-12;
        for (int i = 0; i < places; ++i) {
            const Vector3d x = some_place(i);
            const FieldValue here = this->at(x, 0);
            for (int axis = 0; axis < 3; ++axis) {
                const auto slope = [&](double step) {
                    const Vector3d d = step * Vector3d::Unit(axis);
                    return (this->field_.potential(x + d) - this->field_.potential(x - d)) / (2 * step);
                };
                const double fine = slope(h), coarse = slope(2 * h);
                const double rounding = 16 * 0x1p-52 / h * (1 + std::abs(this->field_.potential(x)));
                EXPECT_NEAR(-here.value[axis], fine, std::abs(fine - coarse) + rounding) << x.transpose();
            }
        }
    }
}

TYPED_TEST(EffectOfPlace, IsFiniteEverywhereAndNothingOutsideItsBounds)
{
    const Box bounds = this->field_.bounds();
    for (const double scale : {0.0, 1e-12, 1.0, 30.0, 1e9}) {
        for (int i = 0; i < places; ++i) {
            const Vector3d x = scale * some_place(i);
            const FieldValue here = this->at(x, 1e4);
            ASSERT_TRUE(here.value.allFinite() && here.gradient.allFinite()) << x.transpose();
            if (!bounds.contains(x)) {
                EXPECT_EQ(here.value, Vector3d(0, 0, 0)) << x.transpose();
                EXPECT_EQ(here.gradient, Matrix3d(Matrix3d::Zero())) << x.transpose();
            }
        }
    }
}

TYPED_TEST(EffectOfPlace, ThatEndsHasABoundaryForClustersToStraddle)
{
    const Box bounds = this->field_.bounds();
    const bool ends = bounds.lower.array().isFinite().any() || bounds.upper.array().isFinite().any();
    EXPECT_TRUE(!ends || HasBoundary<TypeParam>);
}

TYPED_TEST(EffectOfPlace, IsTheSameAtManyPlacesAsAtEach)
{
    for (const std::size_t count : {1U, 7U, 64U, 65U, 200U}) { // some are asked at 64 together
        std::vector<FieldValue> together(count, FieldValue{{1, 2, 3}, Matrix3d::Ones()});
        const std::vector<FieldValue> before = together;
        {
            Asking asking(this->field_, 0.3);
            for (std::size_t i = 0; i < count; ++i)
                asking.add(some_place(i), together[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            FieldValue alone = before[i];
            this->field_.add(some_place(i), 0.3, alone);
            ASSERT_EQ(together[i].value, alone.value) << i << " of " << count;
            ASSERT_EQ(together[i].gradient, alone.gradient) << i << " of " << count;
        }
    }
}

TYPED_TEST(EffectOfPlace, OfNoStrengthDoesNotAct)
{
    EXPECT_FALSE(TypeParam(powerless<TypeParam>(), FieldSource{}).acts());
}

} // namespace
} // namespace slod::test
