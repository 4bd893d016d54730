#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <slod.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The messages of slod.idl under our names, and the few lines needed to fill and read their C arrays.
namespace slod::wire {

using Clusters = ::slod_v1_Clusters;
using Overview = ::slod_v1_Overview;
using FrameManifest = ::slod_v1_FrameManifest;
using RegionCount = ::slod_v1_RegionCount;
using Members = ::slod_v1_Members;
using Stats = ::slod_v1_Stats;
using PublisherCounts = ::slod_v1_PublisherCounts;
using EffectStats = ::slod_v1_EffectStats;
using ErrorEstimate = ::slod_v1_ErrorEstimate;
using Alarm = ::slod_v1_Alarm;
using RoiState = ::slod_v1_RoiState;
using ServerState = ::slod_v1_ServerState;
using Command = ::slod_v1_Command;
using CommandReply = ::slod_v1_CommandReply;
using View = ::slod_v1_View;
using Assignment = ::slod_v1_Assignment;
using ResultCode = ::slod_v1_ResultCode;

/// Identity of a session or a client. All 0 is nobody's.
using Uuid = std::array<std::uint8_t, 16>;

/// A random one (RFC 4122, version 4).
Uuid new_uuid();

/// As 8-4-4-4-12 hexadecimal digits.
std::string to_string(const Uuid& uuid);

inline void set(slod_v1_Uuid& field, const Uuid& uuid)
{
    std::memcpy(field, uuid.data(), uuid.size());
}

inline Uuid uuid_of(const slod_v1_Uuid& field)
{
    Uuid uuid;
    std::memcpy(uuid.data(), field, uuid.size());
    return uuid;
}

/// `text`, or as much of it as fits into `capacity` bytes without cutting a UTF-8 character.
std::string_view fitting(std::string_view text, std::size_t capacity);

/// `sentence`, or as many of its words as fit into `capacity` bytes, with dots for the others.
std::string fitting_words(std::string_view sentence, std::size_t capacity);

/// Stores `text` in a bounded string, cut where it is too long.
template <std::size_t Size>
void set(char (&field)[Size], std::string_view text)
{
    const std::string_view stored = fitting(text, Size - 1);
    std::copy(stored.begin(), stored.end(), field); // an empty text may have no place in memory
    field[stored.size()] = '\0';
}

/// Likewise words for people, which end with a whole one.
template <std::size_t Size>
void set_sentence(char (&field)[Size], std::string_view sentence)
{
    set(field, fitting_words(sentence, Size - 1));
}

/// Points a message's sequence at `elements`, which must outlive the write: nothing is copied, and DDS frees
/// nothing.
template <class Sequence, class Element>
void lend(Sequence& sequence, std::vector<Element>& elements)
{
    static_assert(std::is_same_v<decltype(sequence._buffer), Element*>);
    sequence._buffer = elements.data();
    sequence._length = static_cast<std::uint32_t>(elements.size());
    sequence._maximum = sequence._length;
    sequence._release = false;
}

/// A received message's sequence; valid as long as the message.
template <class Sequence>
auto span_of(const Sequence& sequence)
{
    return std::span(sequence._buffer, sequence._length);
}

/// What a message weighs on the wire: its sequences and its fixed part. Within some 100 bytes of the encoded
/// size, headers of packets not counted.
std::size_t wire_bytes(const Clusters& message);
std::size_t wire_bytes(const Overview& message);
std::size_t wire_bytes(const FrameManifest& message);
std::size_t wire_bytes(const Stats& message);
std::size_t wire_bytes(const ServerState& message);
std::size_t wire_bytes(const RoiState& message);
std::size_t wire_bytes(const Members& message);
std::size_t wire_bytes(const Command& message);

/// Those without sequences.
template <class Message>
requires(std::is_same_v<Message, EffectStats> || std::is_same_v<Message, ErrorEstimate> ||
         std::is_same_v<Message, Alarm> || std::is_same_v<Message, CommandReply> ||
         std::is_same_v<Message, View>) constexpr std::size_t wire_bytes(const Message& message)
{
    return sizeof(message);
}

} // namespace slod::wire
