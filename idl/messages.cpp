#include "idl/messages.hpp"

#include <random>

namespace slod::wire {

namespace {

template <class Sequence>
std::size_t bytes(const Sequence& sequence)
{
    return sequence._length * sizeof(*sequence._buffer);
}

} // namespace

Uuid new_uuid()
{
    std::random_device entropy;
    Uuid uuid;
    for (std::uint8_t& octet : uuid)
        octet = static_cast<std::uint8_t>(entropy());
    constexpr std::uint8_t version_4 = 0x40;
    constexpr std::uint8_t rfc_4122 = 0x80;
    uuid[6] = static_cast<std::uint8_t>((uuid[6] & 0x0f) | version_4);
    uuid[8] = static_cast<std::uint8_t>((uuid[8] & 0x3f) | rfc_4122);
    return uuid;
}

std::string to_string(const Uuid& uuid)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < uuid.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10)
            text += '-';
        text += digits[uuid[i] >> 4];
        text += digits[uuid[i] & 0x0f];
    }
    return text;
}

std::string_view fitting(std::string_view text, std::size_t capacity)
{
    if (text.size() <= capacity)
        return text;
    const auto continues_a_character = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
    };
    std::size_t length = capacity;
    while (length > 0 && continues_a_character(text[length]))
        --length;
    return text.substr(0, length);
}

std::string fitting_words(std::string_view sentence, std::size_t capacity)
{
    constexpr std::string_view dots = " ...";
    if (sentence.size() <= capacity)
        return std::string(sentence);
    // A word ends before the space that follows it, which may be the first that does not fit.
    const std::size_t end = sentence.rfind(' ', capacity - dots.size());
    const std::string_view words =
        end == std::string_view::npos ? fitting(sentence, capacity - dots.size()) : sentence.substr(0, end);
    return std::string(words).append(dots);
}

std::size_t wire_bytes(const Clusters& message)
{
    return sizeof(message) + bytes(message.position) + bytes(message.velocity) + bytes(message.mass) +
           bytes(message.particles) + bytes(message.covariance) + bytes(message.cluster_id) +
           bytes(message.formation);
}

std::size_t wire_bytes(const Overview& message)
{
    return sizeof(message) + bytes(message.position) + bytes(message.velocity) + bytes(message.mass) +
           bytes(message.particles) + bytes(message.radius);
}

std::size_t wire_bytes(const FrameManifest& message)
{
    return sizeof(message) + bytes(message.regions);
}

std::size_t wire_bytes(const Stats& message)
{
    return sizeof(message) + bytes(message.phases) + bytes(message.counts);
}

std::size_t wire_bytes(const ServerState& message)
{
    return sizeof(message) + bytes(message.topics);
}

std::size_t wire_bytes(const RoiState& message)
{
    return sizeof(message) + bytes(message.settings);
}

std::size_t wire_bytes(const Members& message)
{
    return sizeof(message) + bytes(message.particle_id) + bytes(message.cluster_id) +
           bytes(message.position) + bytes(message.velocity) + bytes(message.mass) + bytes(message.kind);
}

std::size_t wire_bytes(const Command& message)
{
    return sizeof(message) + bytes(message.settings);
}

} // namespace slod::wire
