#include "control/controller.hpp"

#include <algorithm>

#include "control/error_controller.hpp"
#include "control/paper_controller.hpp"
#include "control/smooth_controller.hpp"

namespace slod {

SizeFactors size_factors(const ControlSettings& settings, const ControlScope& scope)
{
    return {.least = std::min(settings.smallest_cluster_size / scope.most_size, 1.0),
            .most = std::max(settings.largest_cluster_size / scope.least_size, 1.0)};
}

Detail bounded(Detail detail, const ControlSettings& settings)
{
    detail.least_size = settings.smallest_cluster_size;
    detail.most_size = settings.largest_cluster_size;
    return detail;
}

std::unique_ptr<Controller> make_controller(const ControlSettings& settings, const ControlScope& scope,
                                            const Detail& detail)
{
    switch (settings.mode) {
    case ControlMode::Paper:
        return std::make_unique<PaperController>(settings, scope, detail);
    case ControlMode::Smooth:
        return std::make_unique<SmoothController>(settings, scope, detail);
    case ControlMode::Error:
        return std::make_unique<ErrorController>(settings, scope, detail);
    case ControlMode::Off:
        break;
    }
    return nullptr;
}

Problems problems(const ControlSettings& control)
{
    if (control.smallest_cluster_size > control.largest_cluster_size)
        return {"smallest_cluster_size is above largest_cluster_size; exchange them."};
    return {};
}

} // namespace slod
