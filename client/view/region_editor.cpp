#include "view/region_editor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace slod::view {

namespace {

std::array<double, 3> array_of(const Vector& from)
{
    return {from.x(), from.y(), from.z()};
}

std::string text_of(double number)
{
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.17g", number);
    return text.data();
}

std::string text_of(const Vector& vector)
{
    return "[" + text_of(vector.x()) + ", " + text_of(vector.y()) + ", " + text_of(vector.z()) + "]";
}

} // namespace

std::optional<client::CommandRequest> command_between(const std::string& region, const RegionPose& from,
                                                      const RegionPose& to)
{
    const bool moved = from.centre != to.centre;
    const bool resized = to.sphere ? from.radius != to.radius : from.half_extent != to.half_extent;
    if (moved && resized) { // in one command, or a frame could see one without the other
        const std::pair<std::string, std::string> size =
            to.sphere ? std::pair("radius", text_of(to.radius))
                      : std::pair("half_extent", text_of(to.half_extent));
        return client::CommandRequest{
            .kind = "set_roi", .region = region, .settings = {{"centre", text_of(to.centre)}, size}};
    }
    if (moved)
        return client::CommandRequest{.kind = "move_roi", .region = region, .centre = array_of(to.centre)};
    if (resized && to.sphere)
        return client::CommandRequest{.kind = "resize_roi", .region = region, .radius = to.radius};
    if (resized)
        return client::CommandRequest{
            .kind = "resize_roi", .region = region, .half_extent = array_of(to.half_extent)};
    return {};
}

void RegionEditor::on_regions(const client::Connection::Regions& regions)
{
    const bool unchanged =
        std::equal(regions.begin(), regions.end(), regions_.begin(), regions_.end(),
                   [](const auto& left, const auto& right) {
                       return left.first == right.first && left.second.revision == right.second.revision;
                   });
    if (unchanged)
        return;
    regions_ = regions;
    std::erase_if(changes_, [this](const auto& change) { return !regions_.contains(change.first); });
    if (drag_ && !regions_.contains(drag_->grip.region))
        drag_.reset();
    forget_settled();
}

std::optional<RegionEditor::Grip> RegionEditor::grip_at(const Lens& lens, const Pixel& pixel) const
{
    constexpr double reach_px = 10;
    double nearest = reach_px;
    std::optional<Grip> found;
    for (const auto& [name, region] : regions_) {
        const auto pose = shown(name);
        if (!pose)
            continue;
        for (const Handle& handle : all_handles()) {
            const auto at = lens.project(place_of(handle, *pose));
            const double distance = at ? std::hypot(at->x - pixel.x, at->y - pixel.y) : reach_px;
            if (distance < nearest && can_be_dragged(handle, *pose, lens)) {
                nearest = distance;
                found = {name, handle};
            }
        }
    }
    return found;
}

void RegionEditor::begin(const Grip& grip, const Pixel& pixel)
{
    const auto pose = shown(grip.region);
    if (!pose)
        return;
    drag_ = {.grip = grip, .from = pixel, .before = *pose};
    changes_.try_emplace(grip.region, Change{.wanted = *pose, .told = *pose});
}

void RegionEditor::drag(const Lens& lens, const Pixel& pixel)
{
    if (drag_)
        changes_.at(drag_->grip.region).wanted =
            dragged(drag_->before, drag_->grip.handle, lens, drag_->from, pixel);
}

void RegionEditor::release()
{
    drag_.reset();
    forget_settled();
}

void RegionEditor::cancel()
{
    if (drag_)
        changes_.at(drag_->grip.region).wanted = drag_->before;
    release();
}

const RegionPose* RegionEditor::echo(const std::string& region) const
{
    const auto change = changes_.find(region);
    return change != changes_.end() ? &change->second.wanted : nullptr;
}

RegionEditor::Phase RegionEditor::phase(const std::string& region) const
{
    if (drag_ && drag_->grip.region == region)
        return Phase::Dragged;
    return changes_.contains(region) ? Phase::Pending : Phase::Settled;
}

/// While a command is unanswered the next one waits: it will be the newest.
std::optional<client::CommandRequest> RegionEditor::next_command(Clock::time_point now)
{
    for (auto& [name, change] : changes_) {
        if (change.unanswered || change.about_to_send || now - change.last_command < command_period)
            continue;
        auto command = command_between(name, change.told, change.wanted);
        if (!command)
            continue;
        change.told = change.wanted;
        change.last_command = now;
        change.about_to_send = true;
        return command;
    }
    return {};
}

void RegionEditor::sent(const std::string& region, std::uint64_t number)
{
    const auto change = changes_.find(region);
    if (change == changes_.end())
        return;
    change->second.about_to_send = false;
    change->second.unanswered = number;
}

bool RegionEditor::on_answer(std::uint64_t number, const client::CommandAnswer& answer)
{
    for (auto& [name, change] : changes_) {
        if (change.unanswered != number)
            continue;
        change.unanswered.reset();
        change.revision = answer.revision;
        if (!answer.applied()) {
            if (drag_ && drag_->grip.region == name)
                drag_.reset();
            changes_.erase(name);
        } else {
            forget_settled();
        }
        return true;
    }
    return false;
}

void RegionEditor::reset()
{
    changes_.clear();
    drag_.reset();
    regions_.clear();
}

std::optional<RegionPose> RegionEditor::shown(const std::string& region) const
{
    if (const RegionPose* pose = echo(region))
        return *pose;
    const auto known = regions_.find(region);
    return known != regions_.end() ? pose_of(known->second) : std::nullopt;
}

void RegionEditor::forget_settled()
{
    std::erase_if(changes_, [this](const auto& entry) {
        const auto& [name, change] = entry;
        const auto known = regions_.find(name);
        const bool confirmed = known != regions_.end() && known->second.revision >= change.revision;
        const bool said = !change.unanswered && !change.about_to_send && change.told == change.wanted;
        return said && confirmed && !(drag_ && drag_->grip.region == name);
    });
}

} // namespace slod::view
