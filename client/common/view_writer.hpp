#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "idl/dds.hpp"

namespace slod::client {

/// Where a client looks, as View in slod.idl.
struct ClientView {
    std::array<double, 3> eye{};
    std::array<double, 3> look_at{};
    std::array<double, 3> up{};
    double field_of_view_deg = 45; ///< vertical
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;

    friend bool operator==(const ClientView&, const ClientView&) = default;
};

/// Tells servers where a client looks: moves the frustum regions that follow its name.
class ViewWriter {
public:
    /// `client` is the commander's, whose leases views renew; `name` has at most 64 bytes. `participant` must
    /// outlive the writer. Throws wire::DdsError.
    ViewWriter(const wire::Participant& participant, const wire::Uuid& client, std::string name);

    const std::string& name() const { return name_; }

    /// To the server of that session. False: DDS refused it; a later one replaces it anyway.
    [[nodiscard]] bool write(const ClientView& view, const wire::Uuid& session);

private:
    wire::Uuid client_;
    std::string name_;
    wire::Writer<wire::View> writer_;
};

} // namespace slod::client
