#include "effects/emitter_settings.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "effects/emitter_shape.hpp"

namespace slod {

Problems problems(const EmitterSettings& settings)
{
    Problems found = shape_problems(settings);
    const EmitterSettings defaults;
    if (!settings.schedule.empty() && settings.rate != defaults.rate && settings.rate != 0)
        found.push_back("rate = " + number_text(settings.rate) +
                        " is given beside a schedule, which has rates of its own; leave one of them out.");
    for (std::size_t i = 1; i < settings.schedule.size(); ++i)
        if (settings.schedule[i].front() <= settings.schedule[i - 1].front())
            found.push_back("schedule has the time " + number_text(settings.schedule[i].front()) + " after " +
                            number_text(settings.schedule[i - 1].front()) +
                            "; put its pairs in order of time.");
    if (settings.burst == 0 && std::isfinite(settings.burst_period))
        found.push_back("burst_period = " + number_text(settings.burst_period) +
                        " is given without a burst; say how many particles, burst = 100, or leave it out.");
    return found;
}

} // namespace slod
