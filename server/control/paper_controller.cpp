#include "control/paper_controller.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slod {

PaperController::PaperController(const ControlSettings& settings, const ControlScope& scope,
                                 const Detail& detail)
    : settings_(settings), scope_(scope), detail_(bounded(detail, settings))
{
    detail_.dithered = false;
}

void PaperController::set_scope(const ControlScope& scope)
{
    scope_ = scope;
    in_vain_ = 0;
}

Detail PaperController::next(const FrameWork& work)
{
    if (!(work.work_ms > 0 && std::isfinite(work.work_ms)))
        return detail_;
    std::rotate(works_.begin(), works_.begin() + 1, works_.end());
    works_.back() = work.work_ms;
    frames_ = std::min(frames_ + 1, int(works_.size()));
    if (frames_ < int(works_.size()))
        return detail_;
    const double mean = std::accumulate(works_.begin(), works_.end(), 0.0) / double(works_.size());
    if (mean == work.target_ms) {
        state_ = ControlState::Holding;
        return detail_;
    }
    const bool coarser = mean > work.target_ms;
    state_ = ControlState::Adjusting;
    if (turn_size(coarser))
        in_vain_ = 0;
    else if (!turn_breadth(coarser))
        state_ = coarser ? ControlState::Unreachable : ControlState::Finest;
    return detail_;
}

bool PaperController::turn_size(bool coarser)
{
    const double before = detail_.cluster_size;
    const SizeFactors factors = size_factors(settings_, scope_);
    const double step = scope_.regions > 1 ? before * (coarser ? percent / 100 : -percent / (100 + percent))
                                           : (coarser ? 1 : -1) / scope_.most_size;
    detail_.cluster_size = std::clamp(before + step, factors.least, factors.most);
    return detail_.cluster_size != before;
}

bool PaperController::turn_breadth(bool coarser)
{
    const double wanted = coarser ? std::min(detail_.breadth * breadth_step, settings_.largest_breadth)
                                  : std::max(detail_.breadth / breadth_step, 1.0);
    if (!scope_.breadth || wanted == detail_.breadth)
        return false;
    if (++in_vain_ == patience) {
        detail_.breadth = wanted;
        in_vain_ = 0;
    }
    return true;
}

} // namespace slod
