#include "report/tables.hpp"

#include <algorithm>
#include <cmath>

#include "core/formatted.hpp"
#include "core/number_text.hpp"

namespace slod::report {
namespace {

/// Of the longest quantity.
int quantity_width(const Findings& findings)
{
    std::size_t width = std::string_view("measured quantity").size();
    for (const CaseFindings& each : findings.cases)
        for (const TestFindings& test : each.tests)
            for (const Measurement& row : test.rows)
                width = std::max(width, row.quantity.size());
    return int(width);
}

std::string line(const Measurement& row, int width)
{
    return formatted("     %-*s %12s  %-24s %s\n", width, row.quantity.c_str(),
                     value_text(row.measured).c_str(), limit_text(row.limits).c_str(),
                     !row.held()   ? ""
                     : row.holds() ? "yes"
                                   : "NO");
}

std::string paragraph(const char* head, const std::string& text)
{
    return text.empty() ? "" : std::string("     ") + head + text + "\n";
}

/// In quotes where need be, which are then doubled.
std::string cell(const std::string& text)
{
    if (text.find_first_of(",\"\n\r") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& cells)
{
    std::string line;
    for (const std::string& text : cells)
        line += (line.empty() ? "" : ",") + cell(text);
    return line + "\n";
}

std::string limit_cell(double limit)
{
    return std::isfinite(limit) ? number_text(limit) : "";
}

} // namespace

std::string value_text(double value)
{
    return formatted("%.4g", value);
}

std::string limit_text(const test::CaseLimits& limits)
{
    const bool below = std::isfinite(limits.most), above = std::isfinite(limits.least);
    if (below && above)
        return limits.least == limits.most ? value_text(limits.most)
                                           : value_text(limits.least) + " to " + value_text(limits.most);
    return below ? "at most " + value_text(limits.most) : above ? "at least " + value_text(limits.least) : "";
}

std::string test_text(const TestFindings& test)
{
    std::string text = test.name;
    if (test.runs > 1)
        text += formatted(", %d runs", test.runs);
    if (test.failed > 0)
        text += test.runs > 1 ? formatted(", %d FAILED", test.failed) : ", FAILED";
    return text + (test.ended ? "" : ", did not end");
}

std::string table_text(const Findings& findings)
{
    const int width = quantity_width(findings);
    std::string text =
        formatted("case %-*s %12s  %-24s %s\n", width, "measured quantity", "measured", "limit", "pass");
    for (const CaseFindings& each : findings.cases) {
        text +=
            "\n" + each.hard_case.number + "  " + name(each.outcome()) + ": " + each.hard_case.claim + "\n";
        for (const TestFindings& test : each.tests) {
            text += paragraph("by ", test_text(test));
            for (const Measurement& row : test.rows)
                text += line(row, width);
        }
        text += paragraph("note: ", each.hard_case.note) + paragraph("struck: ", each.hard_case.struck);
    }
    text += "\n";
    for (const std::string& problem : findings.problems)
        text += "error: " + problem + "\n";
    return text + findings.summary() + "\n";
}

std::string csv_text(const Findings& findings)
{
    std::string text = csv_line({"case", "claim", "quantity", "measured", "least", "most", "pass", "outcome",
                                 "test", "note", "struck"});
    for (const CaseFindings& each : findings.cases) {
        const HardCase& c = each.hard_case;
        const auto add = [&](const std::string& test, const Measurement* row) {
            std::vector<std::string> cells{c.number, c.claim, "", "", "", "", ""};
            if (row != nullptr)
                cells = {c.number,
                         c.claim,
                         row->quantity,
                         number_text(row->measured),
                         limit_cell(row->limits.least),
                         limit_cell(row->limits.most),
                         !row->held()   ? ""
                         : row->holds() ? "yes"
                                        : "no"};
            for (const std::string& text_cell : {std::string(name(each.outcome())), test, c.note, c.struck})
                cells.push_back(text_cell);
            text += csv_line(cells);
        };
        for (const TestFindings& test : each.tests) {
            for (const Measurement& row : test.rows)
                add(test.name, &row);
            if (test.rows.empty())
                add(test.name, nullptr);
        }
        if (each.tests.empty())
            add("", nullptr);
    }
    return text;
}

} // namespace slod::report
