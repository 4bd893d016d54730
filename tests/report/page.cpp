#include "report/page.hpp"

#include "core/formatted.hpp"
#include "idl/html.hpp"
#include "report/tables.hpp"

namespace slod::report {
namespace {

constexpr std::string_view style = "td { vertical-align: top; }\n"
                                   "th { border-bottom: 2px solid; }\n"
                                   "td.text { text-align: left; }\n"
                                   "td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }\n"
                                   "tr.case td { border-top: 1px solid #bbb; padding-top: 0.4em; }\n"
                                   "p { margin: 0.2em 0; }\n"
                                   "p.small, td.test { font-size: 80%; color: #555; text-align: left; }\n"
                                   ".no { color: #b00; font-weight: bold; }\n"
                                   ".yes { color: #070; }\n"
                                   ".none { color: #777; }\n";

std::string small(const std::string& text)
{
    return text.empty() ? "" : "<p class=\"small\">" + html_escaped(text) + "</p>\n";
}

std::string cell(const char* kind, const std::string& content)
{
    return std::string("<td class=\"") + kind + "\">" + content + "</td>";
}

const char* style_of(Outcome outcome)
{
    switch (outcome) {
    case Outcome::Passed:
        return "yes";
    case Outcome::Failed:
        return "no";
    default:
        return "none";
    }
}

std::string line(const Measurement& row)
{
    return "<tr><td></td>" + cell("text", "") + cell("text", html_escaped(row.quantity)) +
           cell("number", value_text(row.measured)) + cell("number", limit_text(row.limits)) +
           (!row.held()   ? cell("none", "")
            : row.holds() ? cell("yes", "yes")
                          : cell("no", "NO")) +
           "</tr>\n";
}

/// The claim stands beside as many lines as follow.
std::string lines_of(const CaseFindings& each, const std::string& pictures)
{
    const HardCase& c = each.hard_case;
    std::string lines = "<tr class=\"case\" id=\"" + html_escaped(c.number) + "\">" +
                        html_element("td", html_escaped(c.number)) + "<td class=\"text\" colspan=\"4\">" +
                        html_paragraph(c.claim) + small(c.note.empty() ? "" : "Note: " + c.note) +
                        small(c.struck.empty() ? "" : "Struck: " + c.struck) + "</td>" +
                        cell(style_of(each.outcome()), name(each.outcome())) + "</tr>\n";
    for (const TestFindings& test : each.tests) {
        lines +=
            "<tr><td></td><td class=\"test\" colspan=\"5\">" + html_escaped(test_text(test)) + "</td></tr>\n";
        for (const Measurement& row : test.rows)
            lines += line(row);
    }
    if (!pictures.empty())
        lines += "<tr><td></td><td class=\"text\" colspan=\"5\">" + pictures + "</td></tr>\n";
    return lines;
}

} // namespace

std::string html_page(const Findings& findings,
                      const std::vector<std::pair<std::string, std::string>>& pictures,
                      const std::string& circumstances)
{
    std::string lines = "<tr>";
    for (const char* const title : {"case", "claim", "measured quantity", "measured", "limit", "pass"})
        lines += html_element("th", title);
    lines += "</tr>\n";
    for (const CaseFindings& each : findings.cases) {
        std::string own;
        for (const auto& [number, svg] : pictures)
            own += number == each.hard_case.number ? html_picture(svg) : "";
        lines += lines_of(each, own);
    }
    std::string problems;
    for (const std::string& problem : findings.problems)
        problems += html_element("li", html_escaped(problem));
    return html_document(
        "Stability in hard cases", style,
        html_paragraph(findings.summary() + ".") + html_paragraph(circumstances) +
            (problems.empty() ? "" : html_element("h2", "Errors") + html_element("ul", problems)) +
            html_element("table", lines));
}

} // namespace slod::report
