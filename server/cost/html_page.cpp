#include "cost/html_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/formatted.hpp"
#include "cost/answer.hpp"
#include "idl/html.hpp"

namespace slod::cost {
namespace {

constexpr std::string_view style = "th, tr.front td { border-bottom: 1px solid; }\n"
                                   "tr.front { font-weight: bold; }\n"
                                   "pre { overflow: auto; border: 1px solid; padding: 1em; }\n";

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
    Column{"setting", [](const Row& row) { return html_escaped(row.setting.name()); }},
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
        head += html_element("th", column.title);
    std::string lines = "<tr>" + head + "</tr>\n";
    for (const Row& row : rows) {
        lines += on_front(row, rows) ? "<tr class=\"front\">" : "<tr>";
        for (const Column& column : columns)
            lines += html_element("td", column.cell(row));
        lines += "</tr>\n";
    }
    return html_element("table", lines);
}

std::string answers(const Sweep& sweep)
{
    std::string items;
    std::istringstream lines(answer(sweep));
    for (std::string line; std::getline(lines, line);)
        items += html_element("li", html_escaped(line));
    return html_element("ul", items);
}

} // namespace

std::string html_page(const Sweep& sweep, const Circumstances& c, const std::string& svg,
                      const std::string& scene_text)
{
    const Floor& floor = sweep.floor;
    return html_document(
        "What accuracy costs: " + c.scene, style,
        html_paragraph(formatted("%llu particles, %d frames, %d threads on ",
                                 static_cast<unsigned long long>(c.particles), c.frames, c.threads) +
                       c.machine + ". SLOD " + c.version + ".") +
            answers(sweep) + html_picture(svg) +
            html_paragraph(
                formatted("Errors are in noise floors: distances from the reference, the unclustered run "
                          "with %u steps a frame, over those between unclustered runs of ",
                          reference_steps) +
                (floor.resampled ? "bootstrap samples" : "different seeds") +
                formatted(". 1 is as another seed, below 2 good, above 3 visible. The floor is %.3g in "
                          "positions and %.3g in velocities (scene units), %.3g and %.3g of the particles "
                          "in cubes of a quarter and a sixteenth of the rms radius, %.3g.",
                          floor.position, floor.velocity, floor.coarse, floor.fine, floor.rms_radius)) +
            html_paragraph(
                std::string(
                    "Milliseconds are medians of a frame, p10 and p90 their spread. In bold: what no other "
                    "setting of the same motion beats in both time and error. Force: error of the "
                    "accelerations, |a - exact| / |exact|, median and p99. Drifts are relative, of systems "
                    "that nothing acts on from outside.") +
                (c.opening.empty() ? "" : " Opening is gravity." + c.opening + ".")) +
            table(sweep.rows) + html_element("h2", "The scene") +
            html_element("pre", html_escaped(scene_text)));
}

} // namespace slod::cost
