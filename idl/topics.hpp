#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>
#include <tuple>

#include <dds/dds.h>

#include "idl/messages.hpp"

namespace slod::wire {

using namespace std::chrono_literals;

enum class Sender : std::uint8_t { Server, Client };

/// How a topic is delivered. Every topic is reliable and keeps the newest samples only, so that no writer
/// ever waits for a reader.
struct Delivery {
    bool late_joiners;                 ///< who joins later gets the newest sample at once
    std::int32_t depth;                ///< newest samples kept, per instance
    std::chrono::nanoseconds lifespan; ///< undelivered samples are dropped after it; 0: never
    std::chrono::nanoseconds lease;    ///< a silent writer is given up after it; 0: DDS's default of 10 s
};

/// The picture and the numbers: a newer sample replaces the older one, and who joins waits for the next.
inline constexpr Delivery stream{.late_joiners = false, .depth = 1, .lifespan = 0s, .lease = 0s};
/// What is so until it changes.
inline constexpr Delivery state{.late_joiners = true, .depth = 1, .lifespan = 0s, .lease = 1s};
/// Commands: only who is there gets them, and not when they have gone stale.
inline constexpr Delivery request{.late_joiners = false, .depth = 16, .lifespan = 10s, .lease = 0s};
/// Answers: DDS may match the asker's reader after the answer was written.
inline constexpr Delivery reply{.late_joiners = true, .depth = 16, .lifespan = 10s, .lease = 0s};

struct TopicInfo {
    std::string_view name; ///< after "slod/v1/"
    const dds_topic_descriptor_t* descriptor;
    Sender sender;
    Delivery delivery;
    bool by_region = false; ///< written in the partition of a region of interest
};

/// A row of the table: one topic, and the C++ type that is written to it.
template <class Message>
struct Topic : TopicInfo {};

inline constexpr std::string_view topic_prefix = "slod/v1/";

/// The one table of topics. Server, clients and tests read names, types and QoS here.
inline constexpr std::tuple topic_table{
    Topic<Clusters>{{"clusters", &slod_v1_Clusters_desc, Sender::Server, stream, true}},
    Topic<Overview>{{"overview", &slod_v1_Overview_desc, Sender::Server, stream}},
    Topic<FrameManifest>{{"frame", &slod_v1_FrameManifest_desc, Sender::Server, stream}},
    Topic<Members>{{"members", &slod_v1_Members_desc, Sender::Server, stream, true}},
    Topic<Stats>{{"stats", &slod_v1_Stats_desc, Sender::Server, stream}},
    Topic<EffectStats>{{"effect_stats", &slod_v1_EffectStats_desc, Sender::Server, stream}},
    Topic<ErrorEstimate>{{"error", &slod_v1_ErrorEstimate_desc, Sender::Server, stream}},
    Topic<Alarm>{{"alarms", &slod_v1_Alarm_desc, Sender::Server, state}},
    Topic<RoiState>{{"roi_state", &slod_v1_RoiState_desc, Sender::Server, state}},
    Topic<ServerState>{{"server_state", &slod_v1_ServerState_desc, Sender::Server, state}},
    Topic<Command>{{"command", &slod_v1_Command_desc, Sender::Client, request}},
    Topic<CommandReply>{{"command_reply", &slod_v1_CommandReply_desc, Sender::Server, reply}},
    Topic<View>{{"view", &slod_v1_View_desc, Sender::Client, state}},
};

/// The row of a message type.
template <class Message>
constexpr const TopicInfo& topic()
{
    return std::get<Topic<Message>>(topic_table);
}

/// Calls visit(const TopicInfo&) for every row.
template <class Visitor>
void for_each_topic(Visitor&& visit)
{
    std::apply([&](const auto&... row) { (visit(static_cast<const TopicInfo&>(row)), ...); }, topic_table);
}

/// Partition of the topics of all regions that have none of their own.
inline constexpr std::string_view shared_partition = "auto";

/// Partition of a region's topics; "roi/*" is all of them.
std::string region_partition(std::string_view region);

} // namespace slod::wire
