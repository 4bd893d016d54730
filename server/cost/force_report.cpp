#include "cost/force_report.hpp"

#include <nlohmann/json.hpp>

#include "core/formatted.hpp"
#include "core/number_text.hpp"

namespace slod::cost {
namespace {

/// A field of a table with commas between.
std::string quoted(const std::string& text)
{
    std::string field = "\"";
    for (const char c : text)
        field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + '"';
}

/// What decides on nodes: "accuracy 0.001", "theta 0.5" or "tolerance 0.001".
std::string criterion(const GravitySettings& gravity)
{
    if (gravity.accuracy > 0)
        return "accuracy " + number_text(gravity.accuracy);
    if (gravity.opening == OpeningCriterion::Geometric)
        return "theta " + number_text(gravity.opening_angle);
    return "tolerance " + number_text(gravity.force_tolerance);
}

double per_body(std::uint64_t count, const ForceReport& report)
{
    return double(count) / double(report.bodies);
}

} // namespace

ForceReport measure(ForceWorld& world, const ExactForces& exact, const ForceReport& asked, int repeats,
                    const Clock& clock)
{
    ForceReport report = asked;
    report.rates = measure_kernel_rates(asked.threads, clock);
    world.set_gravity(asked.gravity);
    report.trial = measure_forces(world, exact, repeats, clock);
    report.body_bytes = double(world.bytes()) / double(asked.bodies);
    return report;
}

std::string json_text(const ForceReport& r)
{
    const nlohmann::ordered_json json = {
        {"model", r.model},
        {"n", r.bodies},
        {"threads", r.threads},
        {"softening", r.softening},
        {"criterion", criterion(r.gravity)},
        {"accuracy", r.gravity.accuracy},
        {"seconds", r.trial.seconds},
        {"build_seconds", r.trial.build_seconds},
        {"tree_seconds", r.tree_seconds},
        {"error",
         {{"median", r.trial.error.median},
          {"p90", r.trial.error.p90},
          {"p99", r.trial.error.p99},
          {"max", r.trial.error.max},
          {"rms", r.trial.error.rms}}},
        {"kernel_rate", r.rates.faster()},
        {"kernel_over_bare_loop", r.rates.kernel / r.rates.bare},
        {"normalised_cost", r.normalised_cost()},
        {"pairs_per_body", per_body(r.trial.counts.interactions, r)},
        {"far_nodes_per_body", per_body(r.trial.counts.far_nodes, r)},
        {"bytes_per_body", r.body_bytes},
    };
    return json.dump();
}

std::string text(const ForceReport& r)
{
    const ForceErrors& e = r.trial.error;
    return formatted("%zu bodies of %s, softening %g, %s, %d threads\n", r.bodies, r.model.c_str(),
                     r.softening, criterion(r.gravity).c_str(), r.threads) +
           formatted("time       %.3f ms, of which the view %.3f ms\n", 1e3 * r.trial.seconds,
                     1e3 * r.trial.build_seconds) +
           formatted("before it  %.0f ms, of the SLOD-tree from nothing, which frames keep up\n",
                     1e3 * r.tree_seconds) +
           formatted("error      median %.2e, p90 %.2e, p99 %.2e, largest %.2e, rms %.2e\n", e.median, e.p90,
                     e.p99, e.max, e.rms) +
           formatted("a body     %.0f pairs, %.1f far nodes, %.0f bytes\n",
                     per_body(r.trial.counts.interactions, r), per_body(r.trial.counts.far_nodes, r),
                     r.body_bytes) +
           formatted("kernel     %.2f G pairs/s, a bare loop %.2f\n", 1e-9 * r.rates.kernel,
                     1e-9 * r.rates.bare) +
           formatted("normalised %.0f pairs a body at the faster one's rate\n", r.normalised_cost());
}

std::string table_head()
{
    return formatted("%-12s %8s %7s %9s %9s %9s %9s %9s %7s %10s", "model", "n", "threads", "accuracy", "ms",
                     "view ms", "median", "p99", "bytes", "normalised");
}

std::string table_row(const ForceReport& r)
{
    return formatted("%-12s %8zu %7d %9g %9.2f %9.2f %9.2e %9.2e %7.0f %10.0f", r.model.c_str(), r.bodies,
                     r.threads, r.gravity.accuracy, 1e3 * r.trial.seconds, 1e3 * r.trial.build_seconds,
                     r.trial.error.median, r.trial.error.p99, r.body_bytes, r.normalised_cost());
}

std::string csv_head()
{
    return "model,n,threads,softening,accuracy,seconds,build_seconds,error_median,error_p90,error_p99,error_"
           "max,"
           "error_rms,kernel_rate,bare_rate,normalised_cost,pairs_per_body,bytes_per_body";
}

std::string csv_row(const ForceReport& r)
{
    const ForceErrors& e = r.trial.error;
    return formatted("%s,%zu,%d,%g,%g,%.6g,%.6g,", quoted(r.model).c_str(), r.bodies, r.threads, r.softening,
                     r.gravity.accuracy, r.trial.seconds, r.trial.build_seconds) +
           formatted("%.4g,%.4g,%.4g,%.4g,%.4g,%.6g,%.6g,%.1f,%.1f,%.1f", e.median, e.p90, e.p99, e.max,
                     e.rms, r.rates.kernel, r.rates.bare, r.normalised_cost(),
                     per_body(r.trial.counts.interactions, r), r.body_bytes);
}

} // namespace slod::cost
