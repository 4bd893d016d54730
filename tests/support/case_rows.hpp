#pragma once

#include <limits>
#include <source_location>
#include <string>
#include <string_view>
#include <vector>

// What a test of a hard case (its name begins with the case's number: G01_, F12_, S30_, N09_) measured,
// beside the limit it is held to. Where the environment's SLOD_CASE_ROWS names a folder, every such test
// leaves a file there, of which `./dev test stability --report DIR` makes its table and its pictures.
namespace slod::test {

/// Both ends are allowed.
struct CaseLimits {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};

/// Fails the running test where `measured` is beyond the limits or no number. Of a quantity that is named
/// more than once in a test the report shows the value that has least room. `quantity` is a few words, with
/// the unit if it has one: "error of the energy", "clusters split".
void expect_limits(std::string_view quantity, double measured, CaseLimits limits,
                   std::source_location where = std::source_location::current());

inline void expect_at_most(std::string_view quantity, double measured, double most,
                           std::source_location where = std::source_location::current())
{
    expect_limits(quantity, measured, {.most = most}, where);
}

inline void expect_at_least(std::string_view quantity, double measured, double least,
                            std::source_location where = std::source_location::current())
{
    expect_limits(quantity, measured, {.least = least}, where);
}

inline void expect_within(std::string_view quantity, double measured, double least, double most,
                          std::source_location where = std::source_location::current())
{
    expect_limits(quantity, measured, {least, most}, where);
}

/// The larger of the two, and what is no number where one is: a NaN is the worst there is.
inline double worse(double one, double other)
{
    return !(other <= one) ? other : one;
}

/// A measured value that nothing is held to, for the report's reader.
inline void report_value(std::string_view quantity, double measured,
                         std::source_location where = std::source_location::current())
{
    expect_limits(quantity, measured, {}, where);
}

/// Points to be joined by lines.
struct CaseCurve {
    std::string name;
    std::vector<double> x, y; ///< of one length
};

/// A picture for the report: curves over one pair of axes, whose names have their units.
struct CasePicture {
    std::string title, x_axis, y_axis;
    std::vector<CaseCurve> curves;
    bool log_x = false, log_y = false;
};

void report_picture(CasePicture picture);

} // namespace slod::test
