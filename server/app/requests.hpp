#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vectors.hpp"
#include "idl/messages.hpp"
#include "scene/assignments.hpp"
#include "tree/region_index.hpp"

namespace slod {

/// What a client asks for: Command of slod.idl in C++ types, with its meanings and units.
struct Request {
    wire::Uuid client{};
    std::uint64_t number = 0;
    std::string kind;
    std::string region{};
    std::uint64_t if_revision = 0;
    double lease_s = 0;
    std::uint32_t frames = 0;
    Vector3d centre{0, 0, 0};
    Vector3d half_extent{0, 0, 0};
    double radius = 0;
    std::vector<Assignment> settings{};
};

/// What it is told: CommandReply likewise.
struct Answer {
    wire::Uuid client{};
    std::uint64_t number = 0;
    wire::ResultCode result = slod_v1_RESULT_APPLIED;
    std::string field{};
    std::string text{};
    std::uint64_t applied_frame = 0;
    std::uint64_t revision = 0;
};

/// Where a client looks: View likewise.
struct ClientView {
    wire::Uuid client{};
    std::string client_name;
    Vector3d eye{0, 0, 0};
    Vector3d look_at{0, 0, -1};
    Vector3d up{0, 1, 0};
    double field_of_view_deg = 60;
    double aspect = 1; ///< width by height
};

/// A region of interest as clients are told about it.
struct RegionRecord {
    RegionRow row = background_row;
    RegionOfInterest settings;
    std::uint64_t revision = 0; ///< grows with every change; never the same again under one name
    wire::Uuid owner{};         ///< all 0: the scene
    double lease_s = 0;         ///< wall time; 0: none
    std::uint64_t frame = 0;    ///< first that has it so
    bool removed = false;
};

} // namespace slod
