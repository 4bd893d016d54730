#include "app/command_desk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/scene_check.hpp"
#include "scene/value_text.hpp"

namespace slod {

namespace {

constexpr double longest_lease_s = 1e6;

Answer refusal(wire::ResultCode result, std::string_view field, std::string text)
{
    return {.result = result, .field = std::string(field), .text = std::move(text)};
}

/// The first problem, which starts with the key that is to blame.
Answer refusal(const Problems& problems)
{
    const std::string& first = problems.front();
    const std::string more =
        problems.size() > 1 ? " (and " + std::to_string(problems.size() - 1) + " more problems)" : "";
    return refusal(slod_v1_RESULT_INVALID, first.substr(0, first.find_first_of(" :")), first + more);
}

Answer no_revision()
{
    return refusal(slod_v1_RESULT_INVALID, "if_revision",
                   "What the command is about has no revision; use 0.");
}

Answer addressed(Answer answer, const Request& request)
{
    answer.client = request.client;
    answer.number = request.number;
    return answer;
}

/// Whether a new region is told from the whole scene: by a shape, which may be everywhere, or else by a range
/// of mass, speed or acceleration. A place or size without a shape would go unheard.
bool says_where(const Request& request)
{
    const auto any = [&](const auto& says) {
        return std::any_of(request.settings.begin(), request.settings.end(),
                           [&](const Assignment& assignment) { return says(assignment.key); });
    };
    const bool placed =
        request.centre != Vector3d::Zero() || request.half_extent != Vector3d::Zero() || request.radius != 0;
    return any([](const std::string& key) { return key == "shape"; }) ||
           (!placed && any([](const std::string& key) {
               return key.starts_with("least_") || key.starts_with("most_");
           }));
}

bool of_loop(const Assignment& assignment)
{
    constexpr std::array tables{"server.", "control.", "meter.", "alarms."};
    return std::any_of(tables.begin(), tables.end(),
                       [&](const char* table) { return assignment.key.starts_with(table); });
}

/// What a region looks like to a view.
RegionOfInterest following(const RegionOfInterest& region, const ClientView& view)
{
    RegionOfInterest moved = region;
    moved.centre = view.eye;
    moved.direction = view.look_at - view.eye;
    moved.up = view.up;
    const double field_of_view_deg = view.field_of_view_deg * region.view_share;
    moved.field_of_view_deg =
        std::isfinite(field_of_view_deg) ? std::min(field_of_view_deg, 179.0) : field_of_view_deg;
    moved.aspect = view.aspect;
    return moved;
}

} // namespace

struct CommandDesk::Kind {
    std::string_view name;
    Answer (CommandDesk::*decide)(const Request& request);
    bool changes_outcome;
    bool reads_revision = false;
};

const std::array<CommandDesk::Kind, 12> CommandDesk::kinds{{
    {"pause", &CommandDesk::pause, false},
    {"resume", &CommandDesk::resume, false},
    {"step", &CommandDesk::step, false},
    {"stop", &CommandDesk::stop, false},
    {"keep_alive", &CommandDesk::keep_alive, false},
    {"set", &CommandDesk::set, true, true},
    {"add_roi", &CommandDesk::add_roi, true},
    {"move_roi", &CommandDesk::move_roi, true, true},
    {"resize_roi", &CommandDesk::resize_roi, true, true},
    {"set_roi", &CommandDesk::set_roi, true, true},
    {"remove_roi", &CommandDesk::remove_roi, true, true},
    {"checkpoint", &CommandDesk::checkpoint, false},
}};

Answer CommandDesk::handle(const Request& request, std::uint64_t frame, Clock::time_point now)
{
    frame_ = frame;
    now_ = now;
    leases_.renew(request.client, now);
    memory_.renew(request.client, now);
    if (const Answer* const before = memory_.find(request.client, request.number))
        return *before;
    if (memory_.too_old(request.client, request.number))
        return addressed(refusal(slod_v1_RESULT_LIMIT_REACHED, "request",
                                 "The request is older than the last 64 of its client, whose answers "
                                 "are remembered; ask anew."),
                         request);
    if (!memory_.has_room(request.client, now))
        return addressed(refusal(slod_v1_RESULT_LIMIT_REACHED, "client",
                                 "Too many clients have commanded in the last 10 seconds; ask anew later, or "
                                 "raise wire.max_commanders."),
                         request);
    Answer answer = addressed(decide(request), request);
    memory_.remember(answer, now);
    return answer;
}

Answer CommandDesk::decide(const Request& request)
{
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& each) { return each.name == request.kind; });
    if (kind == kinds.end())
        return refusal(slod_v1_RESULT_UNSUPPORTED, "kind", "This server knows no such command.");
    if (read_only_ && kind->changes_outcome)
        return refusal(slod_v1_RESULT_NOT_PERMITTED, "kind",
                       "The server repeats a recorded run, which nothing may change; start another.");
    if (request.if_revision != 0 && !kind->reads_revision)
        return no_revision();
    return (this->*kind->decide)(request);
}

Answer CommandDesk::applied(const Request& request) const
{
    const RegionRecord* const record = editor_.find(request.region);
    return {.applied_frame = frame_, .revision = record ? record->revision : 0};
}

Answer CommandDesk::pause(const Request& request)
{
    control_.pause();
    return applied(request);
}

Answer CommandDesk::resume(const Request& request)
{
    control_.resume();
    return applied(request);
}

Answer CommandDesk::step(const Request& request)
{
    if (!control_.paused())
        return refusal(slod_v1_RESULT_NOT_PERMITTED, "kind", "The simulation runs; pause it to step.");
    if (request.frames == 0)
        return refusal(slod_v1_RESULT_INVALID, "frames", "There are no 0 frames to step; use 1 or more.");
    control_.step(request.frames);
    return applied(request);
}

Answer CommandDesk::stop(const Request& request)
{
    control_.stop();
    return applied(request);
}

Answer CommandDesk::keep_alive(const Request& request)
{
    return applied(request);
}

Answer CommandDesk::checkpoint(const Request&)
{
    return refusal(slod_v1_RESULT_UNSUPPORTED, "kind", "This server writes no checkpoints.");
}

Answer CommandDesk::set(const Request& request)
{
    if (request.settings.empty())
        return refusal(slod_v1_RESULT_INVALID, "settings", "Nothing is set; name a table.key and a value.");
    if (const Problems found = unchangeable(request.settings); !found.empty())
        return refusal(found);
    if (of_loop(request.settings.front()))
        return set_loop(request);
    Request asked = request;
    asked.region = are_of_background(request.settings) ? background_name : std::string_view();
    if (asked.region.empty() && request.if_revision != 0)
        return no_revision();
    if (!asked.region.empty())
        if (auto answer = objection(asked))
            return *answer;
    if (const Problems found = editor_.set(request.settings, frame_, loop_.alarms); !found.empty())
        return refusal(found);
    return applied(asked);
}

Answer CommandDesk::set_loop(const Request& request)
{
    if (request.if_revision != 0)
        return no_revision();
    const auto other = std::find_if_not(request.settings.begin(), request.settings.end(), of_loop);
    if (other != request.settings.end())
        return refusal(slod_v1_RESULT_INVALID, other->key,
                       other->key + " is set by itself; give " + request.settings.front().key +
                           " in a command of its own.");
    LoopSettings wanted = loop_;
    Problems found = assign_fields(wanted, request.settings);
    for (const std::string& problem : problems(wanted))
        found.push_back(problem);
    for (const std::string& problem : problems(wanted.alarms, editor_.scene()))
        found.push_back(problem);
    if (wanted.server.threads != loop_.server.threads || wanted.server.isa != loop_.server.isa)
        found.push_back("server has nothing but frame_rate that can change while the scene runs; start the "
                        "server with the others.");
    if (!found.empty())
        return refusal(found);
    loop_ = wanted;
    return applied({});
}

Answer CommandDesk::add_roi(const Request& request)
{
    if (!is_name(request.region))
        return refusal(slod_v1_RESULT_INVALID, "region",
                       "region = \"" + request.region + "\" is no name; use 1 to 32 of a-z, 0-9, _ and -.");
    if (editor_.find(request.region))
        return refusal(slod_v1_RESULT_REGION_EXISTS, "region",
                       "There is a region " + request.region +
                           " already; choose another name, or change it.");
    if (editor_.region_count() > max_regions)
        return refusal(slod_v1_RESULT_LIMIT_REACHED, "region",
                       "There are " + std::to_string(max_regions) + " regions already; remove one first.");
    if (!(request.lease_s >= 0 && request.lease_s <= longest_lease_s))
        return refusal(slod_v1_RESULT_INVALID, "lease_s", "lease_s is out of range; use 0 to 1000000.");

    RegionOfInterest region;
    region.name = request.region;
    if (!says_where(request))
        return refusal(
            slod_v1_RESULT_INVALID, "shape",
            "The settings say no shape; use box, sphere or frustum, or everywhere for all there is.");
    std::vector<Assignment> fields{{"centre", value_text(request.centre)}};
    if (request.half_extent != Vector3d::Zero())
        fields.push_back({"half_extent", value_text(request.half_extent)});
    if (request.radius != 0)
        fields.push_back({"radius", value_text(request.radius)});
    fields.insert(fields.end(), request.settings.begin(), request.settings.end());
    Problems found = assign_fields(region, fields);
    if (found.empty() && region.name != request.region)
        found.push_back("name is the command's region; leave it out of the settings.");
    const bool leased = request.lease_s > 0;
    if (found.empty())
        found = editor_.add(region, leased ? request.client : wire::Uuid{}, request.lease_s, frame_);
    if (!found.empty())
        return refusal(found);
    if (leased)
        leases_.grant(region.name, request.client, request.lease_s, now_);
    return applied(request);
}

std::optional<Answer> CommandDesk::objection(const Request& request) const
{
    const RegionRecord* const record = editor_.find(request.region);
    if (!record)
        return refusal(slod_v1_RESULT_UNKNOWN_REGION, "region",
                       "There is no region \"" + request.region + "\"; slodctl roi list prints all of them.");
    if (record->owner != wire::Uuid{} && record->owner != request.client)
        return refusal(slod_v1_RESULT_NOT_OWNER, "region",
                       "Region " + request.region + " is client " + wire::to_string(record->owner) +
                           "'s own; add another.");
    if (request.if_revision != 0 && request.if_revision != record->revision)
        return refusal(slod_v1_RESULT_STALE_REVISION, "if_revision",
                       "Region " + request.region + " is at revision " + std::to_string(record->revision) +
                           ", not " + std::to_string(request.if_revision) +
                           "; slodctl roi show prints what it is now.");
    return {};
}

Answer CommandDesk::change(const Request& request, const std::vector<Assignment>& settings)
{
    RegionOfInterest wanted = editor_.find(request.region)->settings;
    Problems found = assign_fields(wanted, settings);
    if (found.empty() && wanted.name != request.region)
        found.push_back("name cannot change; remove the region and add another.");
    if (found.empty())
        found = editor_.change(wanted, frame_);
    return found.empty() ? applied(request) : refusal(found);
}

Answer CommandDesk::move_roi(const Request& request)
{
    if (auto answer = objection(request))
        return *answer;
    if (editor_.find(request.region)->settings.shape == Shape::Everywhere)
        return refusal(
            slod_v1_RESULT_INVALID, "region",
            request.region + " is everywhere; " +
                (request.region == background_name ? "move another region." : "set its shape first."));
    return change(request, {{"centre", value_text(request.centre)}});
}

Answer CommandDesk::resize_roi(const Request& request)
{
    if (auto answer = objection(request))
        return *answer;
    const Shape shape = editor_.find(request.region)->settings.shape;
    if (shape != Shape::Box && shape != Shape::Sphere)
        return refusal(slod_v1_RESULT_INVALID, "region",
                       request.region +
                           " is no box or sphere, which alone can be resized; change its settings "
                           "with slodctl roi set.");
    const bool box = shape == Shape::Box;
    if (box && request.radius != 0)
        return refusal(slod_v1_RESULT_INVALID, "radius",
                       "The region is a box, which has no radius; give half_extent.");
    if (!box && request.half_extent != Vector3d::Zero())
        return refusal(slod_v1_RESULT_INVALID, "half_extent",
                       "The region is a sphere, which has no half_extent; give radius.");
    if (box && (request.half_extent.array() == 0).any())
        return refusal(slod_v1_RESULT_INVALID, "half_extent",
                       "half_extent is 0, which leaves nothing; give half the sides along x, y and z.");
    if (!box && request.radius == 0)
        return refusal(slod_v1_RESULT_INVALID, "radius", "radius is 0, which leaves nothing; give one.");
    return change(request, {box ? Assignment{"half_extent", value_text(request.half_extent)}
                                : Assignment{"radius", value_text(request.radius)}});
}

Answer CommandDesk::set_roi(const Request& request)
{
    if (auto answer = objection(request))
        return *answer;
    if (request.settings.empty())
        return refusal(slod_v1_RESULT_INVALID, "settings", "Nothing is set; name a setting and a value.");
    return change(request, request.settings);
}

Answer CommandDesk::remove_roi(const Request& request)
{
    if (request.region == background_name)
        return refusal(slod_v1_RESULT_NOT_PERMITTED, "region",
                       "The background cannot go: it holds whatever no other region does.");
    if (auto answer = objection(request))
        return *answer;
    const Problems found = editor_.remove(request.region, frame_);
    leases_.end(request.region);
    return found.empty() ? applied(request) : refusal(found);
}

void CommandDesk::see(const ClientView& view, Clock::time_point now)
{
    leases_.renew(view.client, now);
    if (!read_only_ && !view.client_name.empty())
        views_[view.client] = view;
}

void CommandDesk::follow_views(std::uint64_t frame)
{
    for (const auto& [client, view] : std::exchange(views_, {})) {
        std::vector<RegionOfInterest> moved;
        for (const auto& [name, record] : editor_.records())
            if (record.settings.shape == Shape::Frustum && record.settings.follows == view.client_name)
                moved.push_back(following(record.settings, view));
        for (const RegionOfInterest& region : moved)
            if (problems(region).empty())
                static_cast<void>(editor_.change(region, frame)); // what else could be wrong was so before
    }
}

void CommandDesk::expire_leases(std::uint64_t frame, Clock::time_point now)
{
    for (const std::string& region : leases_.overdue(now)) {
        static_cast<void>(editor_.remove(region, frame)); // leased regions are there
        leases_.end(region);
    }
}

} // namespace slod
