#include "cost/html_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "cost/answer.hpp"
#include "cost/formatted.hpp"

namespace slod::cost {
namespace {

constexpr std::string_view style = "body { font-family: sans-serif; max-width: 75em; margin: 2em auto; }\n"
                                   "table { border-collapse: collapse; }\n"
                                   "th, td { padding: 0.1em 0.6em; text-align: right; }\n"
                                   "th:first-child, td:first-child { text-align: left; }\n"
                                   "th, tr.front td { border-bottom: 1px solid; }\n"
                                   "tr.front { font-weight: bold; }\n"
                                   "pre { overflow: auto; border: 1px solid; padding: 1em; }\n";

std::string escaped(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
            safe += c;
    return safe;
}

std::string element(const char* name, const std::string& content)
{
    return std::string("<") + name + ">" + content + "</" + name + ">\n";
}

std::string paragraph(const std::string& text)
{
    return element("p", escaped(text));
}

/// A number with so many digits; nothing for what is not known.
std::string number(double value, int digits)
{
    return std::isfinite(value) ? formatted("%.*g", digits, value) : "";
}

struct Column {
    const char* title;
    std::string (*cell)(const Row&);
};

constexpr std::array columns{
    Column{"setting", [](const Row& row) { return escaped(row.setting.name()); }},
    Column{"ms", [](const Row& row) { return number(row.ms_median, 4); }},
    Column{"p10", [](const Row& row) { return number(row.ms_p10, 4); }},
    Column{"p90", [](const Row& row) { return number(row.ms_p90, 4); }},
    Column{"clusters", [](const Row& row) { return formatted("%.0f", row.clusters); }},
    Column{"error", [](const Row& row) { return number(row.errors.largest(), 3); }},
    Column{"positions", [](const Row& row) { return number(row.errors.position, 3); }},
    Column{"velocities", [](const Row& row) { return number(row.errors.velocity, 3); }},
    Column{"energy", [](const Row& row) { return number(row.errors.energy, 3); }},
    Column{"coarse", [](const Row& row) { return number(row.errors.coarse, 3); }},
    Column{"fine", [](const Row& row) { return number(row.errors.fine, 3); }},
    Column{"density profile", [](const Row& row) { return number(row.errors.profile, 3); }},
    Column{"dispersion profile", [](const Row& row) { return number(row.errors.dispersion, 3); }},
    Column{"thickness", [](const Row& row) { return number(row.thickness, 4); }},
    Column{"r50", [](const Row& row) { return number(row.r50, 4); }},
    Column{"force", [](const Row& row) { return number(row.force.median, 2); }},
    Column{"force p99", [](const Row& row) { return number(row.force.p99, 2); }},
    Column{"energy drift", [](const Row& row) { return number(row.drifts.energy, 2); }},
    Column{"spin drift", [](const Row& row) { return number(row.drifts.angular_momentum, 2); }},
    Column{"update ms", [](const Row& row) { return number(row.phases[Phase::Update], 3); }},
    Column{"forces ms", [](const Row& row) { return number(row.phases[Phase::Forces], 3); }},
};

bool on_front(const Row& row, const std::vector<Row>& rows)
{
    const std::vector<Row> front = pareto_front(rows, row.setting.motion);
    return std::any_of(front.begin(), front.end(),
                       [&](const Row& point) { return point.setting == row.setting; });
}

std::string table(const std::vector<Row>& rows)
{
    std::string head;
    for (const Column& column : columns)
        head += element("th", column.title);
    std::string lines = "<tr>" + head + "</tr>\n";
    for (const Row& row : rows) {
        lines += on_front(row, rows) ? "<tr class=\"front\">" : "<tr>";
        for (const Column& column : columns)
            lines += element("td", column.cell(row));
        lines += "</tr>\n";
    }
    return element("table", lines);
}

std::string answers(const Sweep& sweep)
{
    std::string items;
    std::istringstream lines(answer(sweep));
    for (std::string line; std::getline(lines, line);)
        items += element("li", escaped(line));
    return element("ul", items);
}

/// The picture without what stands before it in a file of its own.
std::string inlined(const std::string& svg)
{
    const auto begin = svg.find("<svg");
    return begin == std::string::npos ? "" : element("div", svg.substr(begin));
}

} // namespace

std::string html_page(const Sweep& sweep, const Circumstances& c, const std::string& svg,
                      const std::string& scene_text)
{
    const std::string title = "What accuracy costs: " + escaped(c.scene);
    const Floor& floor = sweep.floor;
    return "<!DOCTYPE html>\n<html lang=\"en\">\n" +
           element("head", "<meta charset=\"utf-8\"/>\n" + element("title", title) +
                               element("style", std::string(style))) +
           "<body>\n" + element("h1", title) +
           paragraph(formatted("%llu particles, %d frames, %d threads on ",
                               static_cast<unsigned long long>(c.particles), c.frames, c.threads) +
                     c.machine + ". SLOD " + c.version + ".") +
           answers(sweep) + inlined(svg) +
           paragraph(
               formatted("Errors are in noise floors: distances from the reference, the unclustered run "
                         "with %u steps a frame, over those between unclustered runs of ",
                         reference_steps) +
               (floor.resampled ? "bootstrap samples" : "different seeds") +
               formatted(". 1 is as another seed, below 2 good, above 3 visible. The floor is %.3g in "
                         "positions and %.3g in velocities (scene units), %.3g and %.3g of the particles "
                         "in cubes of a quarter and a sixteenth of the rms radius, %.3g.",
                         floor.position, floor.velocity, floor.coarse, floor.fine, floor.rms_radius)) +
           paragraph(
               std::string(
                   "Milliseconds are medians of a frame, p10 and p90 their spread. In bold: what no other "
                   "setting of the same motion beats in both time and error. Force: error of the "
                   "accelerations, |a - exact| / |exact|, median and p99. Drifts are relative, of systems "
                   "that nothing acts on from outside.") +
               (c.opening.empty() ? "" : " Opening is gravity." + c.opening + ".")) +
           table(sweep.rows) + element("h2", "The scene") + element("pre", escaped(scene_text)) +
           "</body>\n</html>\n";
}

} // namespace slod::cost
