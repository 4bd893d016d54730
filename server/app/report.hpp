#pragma once

#include <string>
#include <string_view>

#include "app/run_summary.hpp"
#include "scene/scene.hpp"
#include "sim/plan.hpp"

namespace slod {

/// What a report is about.
struct ReportedRun {
    const Scene& scene;
    const Plan& plan;
    const RunSummary& summary;
    std::string_view initial_source; ///< in words
    std::string_view isa;            ///< of the kernels that ran
    int threads;
};

/// The figures of a run as JSON. Times in milliseconds unless the key says otherwise, all else in scene
/// units. A phase or an effect that is not in the plan is absent; a ratio without a scale is null.
std::string report(const ReportedRun& run);

} // namespace slod
