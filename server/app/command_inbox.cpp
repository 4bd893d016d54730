#include "app/command_inbox.hpp"

namespace slod {

namespace {

/// Views taken at once: a client has one, and a crowd of clients may wait for the next frame.
constexpr int max_views = 256;

Vector3d vector_of(const slod_v1_Vector& from)
{
    return {from.x, from.y, from.z};
}

Request request_of(const wire::Command& command)
{
    Request request{.client = wire::uuid_of(command.client),
                    .number = command.request,
                    .kind = command.kind,
                    .region = command.region,
                    .if_revision = command.if_revision,
                    .lease_s = command.lease_s,
                    .frames = command.frames,
                    .centre = vector_of(command.centre),
                    .half_extent = vector_of(command.half_extent),
                    .radius = command.radius};
    for (const wire::Assignment& assignment : wire::span_of(command.settings))
        request.settings.push_back({.key = assignment.setting, .value = assignment.value});
    return request;
}

ClientView view_of(const wire::View& view)
{
    return {.client = wire::uuid_of(view.client),
            .client_name = view.client_name,
            .eye = vector_of(view.eye),
            .look_at = vector_of(view.look_at),
            .up = vector_of(view.up),
            .field_of_view_deg = view.field_of_view_deg,
            .aspect = view.height_px > 0 ? double(view.width_px) / double(view.height_px) : 1};
}

} // namespace

const std::vector<Request>& CommandInbox::take_requests(std::size_t limit)
{
    requests_.clear();
    commands_.take_each(int(limit), [this](const wire::Command& command, const dds_sample_info_t& info) {
        const wire::Uuid meant = wire::uuid_of(command.session);
        if (info.valid_data && (meant == wire::Uuid{} || meant == session_))
            requests_.push_back(request_of(command));
    });
    return requests_;
}

const std::vector<ClientView>& CommandInbox::take_views()
{
    client_views_.clear();
    views_.take_each(max_views, [this](const wire::View& view, const dds_sample_info_t& info) {
        const wire::Uuid meant = wire::uuid_of(view.session);
        if (info.valid_data && (meant == wire::Uuid{} || meant == session_))
            client_views_.push_back(view_of(view));
    });
    return client_views_;
}

} // namespace slod
