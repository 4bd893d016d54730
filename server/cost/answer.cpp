#include "cost/answer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace slod::cost {
namespace {

std::string line(const char* format, double value, const std::optional<Row>& row, const char* none)
{
    std::array<char, 160> text{};
    if (!row) {
        std::snprintf(text.data(), text.size(), format, value);
        return text.data() + std::string(none) + "\n";
    }
    std::snprintf(text.data(), text.size(), format, value);
    std::array<char, 160> rest{};
    std::snprintf(rest.data(), rest.size(), "%-12s %8.2f ms  %6.2f noise floors\n",
                  row->setting.name().c_str(), row->ms_median, row->errors.largest());
    return text.data() + std::string(rest.data());
}

} // namespace

std::vector<Row> pareto_front(const std::vector<Row>& rows, Motion motion)
{
    std::vector<Row> own;
    for (const Row& row : rows)
        if (row.setting.unclustered() || row.setting.motion == motion)
            own.push_back(row);
    std::stable_sort(own.begin(), own.end(),
                     [](const Row& a, const Row& b) { return a.ms_median < b.ms_median; });
    std::vector<Row> front;
    for (const Row& row : own)
        if (front.empty() || row.errors.largest() < front.back().errors.largest())
            front.push_back(row);
    return front;
}

std::optional<Row> best_within(const std::vector<Row>& rows, double ms)
{
    std::optional<Row> best;
    for (const Row& row : rows)
        if (row.ms_median <= ms && (!best || row.errors.largest() < best->errors.largest()))
            best = row;
    return best;
}

std::optional<Row> fastest_within(const std::vector<Row>& rows, double error)
{
    std::optional<Row> fastest;
    for (const Row& row : rows)
        if (row.errors.largest() <= error && (!fastest || row.ms_median < fastest->ms_median))
            fastest = row;
    return fastest;
}

std::string answer(const Sweep& sweep)
{
    std::string text;
    for (const double rate : {30.0, 60.0, 120.0})
        text += line("at %3.0f frames a second   ", rate, best_within(sweep.rows, 1000 / rate),
                     "none of these settings is fast enough");
    for (const double error : {1.0, 2.0, 5.0})
        text += line("at an error of %1.0f        ", error, fastest_within(sweep.rows, error), "none");
    return text;
}

} // namespace slod::cost
