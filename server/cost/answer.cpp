#include "cost/answer.hpp"

#include <algorithm>

#include "core/formatted.hpp"

namespace slod::cost {
namespace {

std::string line(const std::string& head, const std::optional<Row>& row, const char* none)
{
    if (!row)
        return head + none + "\n";
    return head + formatted("%s: %.3f ms, %.2f noise floors\n", row->setting.name().c_str(), row->ms_median,
                            row->errors.largest());
}

template <class Accepts>
std::optional<Row> fastest_where(const std::vector<Row>& rows, const Accepts& accepts)
{
    std::optional<Row> fastest;
    for (const Row& row : rows)
        if (accepts(row) && (!fastest || row.ms_median < fastest->ms_median))
            fastest = row;
    return fastest;
}

} // namespace

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
    return fastest_where(rows, [&](const Row& row) { return row.errors.largest() <= error; });
}

std::string answer(const Sweep& sweep)
{
    std::string text;
    for (const double rate : {30.0, 60.0, 120.0})
        text += line(formatted("at %3.0f frames a second      ", rate), best_within(sweep.rows, 1000 / rate),
                     "none of these settings is fast enough");
    for (const double error : {1.0, 2.0, 5.0})
        text += line(formatted("within %1.0f noise floor%s       ", error, error > 1 ? "s" : " "),
                     fastest_within(sweep.rows, error), "none of these settings");
    if (std::none_of(sweep.rows.begin(), sweep.rows.end(),
                     [](const Row& row) { return row.force.median > 0; }))
        return text;
    for (const double error : {0.01, 0.001})
        text += line(formatted("accelerations to %3.1f %%      ", 100 * error),
                     fastest_where(sweep.rows, [&](const Row& row) { return row.force.median <= error; }),
                     "none of these settings");
    return text;
}

} // namespace slod::cost
