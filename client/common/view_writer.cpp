#include "common/view_writer.hpp"

#include <utility>

namespace slod::client {

namespace {

slod_v1_Vector message_of(const std::array<double, 3>& from)
{
    return {from[0], from[1], from[2]};
}

} // namespace

ViewWriter::ViewWriter(const wire::Participant& participant, const wire::Uuid& client, std::string name)
    : client_(client), name_(std::move(name)), writer_(participant)
{}

bool ViewWriter::write(const ClientView& view, const wire::Uuid& session)
{
    wire::View message{};
    wire::set(message.client, client_);
    wire::set(message.session, session);
    wire::set(message.client_name, name_);
    message.eye = message_of(view.eye);
    message.look_at = message_of(view.look_at);
    message.up = message_of(view.up);
    message.field_of_view_deg = view.field_of_view_deg;
    message.width_px = view.width_px;
    message.height_px = view.height_px;
    return writer_.write(message);
}

} // namespace slod::client
