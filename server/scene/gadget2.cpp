#include "scene/gadget2.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>

#include "scene/kinds.hpp"
#include "scene/record_file.hpp"

namespace slod {

namespace {

constexpr std::size_t type_count = gadget2_types.size();
constexpr std::uint32_t header_bytes = 256;

/// What the reader uses of the header; the rest concerns cosmology and gas.
struct Header {
    std::array<std::int32_t, type_count> counts{};
    std::array<double, type_count> masses{}; ///< 0: of each particle, in the MASS block
    std::int32_t file_count = 0;             ///< files that the snapshot is spread over; 0 in old files

    std::size_t total() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }
    bool has_own_masses(std::size_t type) const { return counts[type] > 0 && masses[type] == 0; }
};

std::uint32_t byte_swapped(std::uint32_t value)
{
    return value >> 24 | (value >> 8 & 0xff00) | (value << 8 & 0xff0000) | value << 24;
}

/// Tells files that are something else by their first four bytes, which in SnapFormat 1 are the length of
/// the header.
void check_format(RecordFile& file)
{
    constexpr std::uint32_t label_bytes = 8;         // of SnapFormat 2's block names
    constexpr std::uint32_t hdf5_start = 0x46444889; // "\x89HDF"
    const std::uint32_t first = file.next_length("header", header_bytes);
    if (first == header_bytes)
        return;
    const std::uint32_t swapped = byte_swapped(first);
    if (swapped == header_bytes || swapped == label_bytes)
        throw UnusableFile("the file is big-endian: its first record marker reads " + std::to_string(first) +
                           ", which is " + std::to_string(swapped) +
                           " with the bytes in reverse; convert it to little-endian.");
    if (first == label_bytes)
        throw UnusableFile(
            "the file is in SnapFormat 2, with a name before each block; write it in SnapFormat 1.");
    if (first == hdf5_start)
        throw UnusableFile("the file is in SnapFormat 3, HDF5; write it in SnapFormat 1.");
    throw UnusableFile("no GADGET-2 file in SnapFormat 1: the first record marker reads " +
                       std::to_string(first) + " where " + std::to_string(header_bytes) + " is expected.");
}

Header read_header(RecordFile& file)
{
    check_format(file);
    const auto bytes = file.read<char>("header", header_bytes);
    Header header;
    std::memcpy(header.counts.data(), bytes.data(), sizeof header.counts);
    std::memcpy(header.masses.data(), bytes.data() + 24, sizeof header.masses);
    std::memcpy(&header.file_count, bytes.data() + 124, sizeof header.file_count);

    for (std::size_t type = 0; type < type_count; ++type) {
        const std::string of_type =
            " of type " + std::to_string(type) + ", " + std::string(gadget2_types[type]);
        if (header.counts[type] < 0)
            throw UnusableFile("the header has " + std::to_string(header.counts[type]) + " particles" +
                               of_type + "; the file is damaged, get it anew.");
        if (!std::isfinite(header.masses[type]) || header.masses[type] < 0)
            throw UnusableFile("the header has the mass " + std::to_string(header.masses[type]) + of_type +
                               "; masses are finite and not negative.");
    }
    if (header.total() == 0)
        throw UnusableFile("the file holds no particles; name another.");
    if (header.total() > max_gadget2_particles)
        throw UnusableFile("the file holds " + std::to_string(header.total()) + " particles; at most " +
                           std::to_string(max_gadget2_particles) + " are read.");
    if (header.file_count > 1)
        throw UnusableFile("the snapshot is spread over " + std::to_string(header.file_count) +
                           " files; join them in one.");
    return header;
}

/// Ids of 32 or 64 bits, as the block's length tells.
std::vector<std::uint64_t> read_ids(RecordFile& file, std::size_t count)
{
    if (file.next_length("ID", count * sizeof(std::uint32_t)) == count * sizeof(std::uint64_t))
        return file.read<std::uint64_t>("ID", count);
    const auto ids = file.read<std::uint32_t>("ID", count);
    return {ids.begin(), ids.end()};
}

/// The scene's kind for each type that the file holds.
std::array<std::uint8_t, type_count> kinds_of_types(const Header& header,
                                                    const std::vector<ParticleKind>& kinds, Problems& found)
{
    std::array<std::uint8_t, type_count> rows{};
    for (std::size_t type = 0; type < type_count; ++type) {
        const auto row = kind_index(kinds, gadget2_types[type]);
        if (header.counts[type] > 0 && !row)
            found.push_back("the file holds " + std::to_string(header.counts[type]) + " particles of type " +
                            std::to_string(type) +
                            " and the scene has no kind for them; add a [[kind]] with name = \"" +
                            std::string(gadget2_types[type]) + "\".");
        rows[type] = row.value_or(0);
    }
    return rows;
}

ParticleSet read_particles(RecordFile& file, const Header& header,
                           const std::array<std::uint8_t, type_count>& rows)
{
    const std::size_t count = header.total();
    const auto positions = file.read<std::array<float, 3>>("POS", count);
    const auto velocities = file.read<std::array<float, 3>>("VEL", count);
    const auto ids = read_ids(file, count);
    std::size_t own_masses = 0;
    for (std::size_t type = 0; type < type_count; ++type)
        own_masses += header.has_own_masses(type) ? std::size_t(header.counts[type]) : 0;
    const auto masses = own_masses > 0 ? file.read<float>("MASS", own_masses) : std::vector<float>();

    ParticleSet particles;
    particles.reserve(count);
    auto own_mass = masses.begin();
    for (std::size_t type = 0; type < type_count; ++type)
        for (std::int32_t n = 0; n < header.counts[type]; ++n) {
            const auto& [x, y, z] = positions[particles.size()];
            const auto& [vx, vy, vz] = velocities[particles.size()];
            Particle particle{.position = {x, y, z}, .velocity = {vx, vy, vz}};
            particle.id = ids[particles.size()];
            particle.mass = header.has_own_masses(type) ? *own_mass++ : float(header.masses[type]);
            particle.kind = rows[type];
            particles.push_back(particle);
        }
    return particles;
}

/// One sentence on the particles that `is_wrong` picks, naming the first.
template <class Test>
void report(const ParticleSet& particles, const std::string& what, const std::string& remedy,
            const Test& is_wrong, Problems& found)
{
    const auto first = std::find_if(particles.begin(), particles.end(), is_wrong);
    if (first == particles.end())
        return;
    const auto count = std::count_if(first, particles.end(), is_wrong);
    found.push_back("particle " + std::to_string(first->id) +
                    (count > 1 ? " and " + std::to_string(count - 1) + " more have " : " has ") + what +
                    "; " + remedy);
}

void check_particles(const ParticleSet& particles, Problems& found)
{
    report(
        particles, "a position that is not finite", "repair or remove it.",
        [](const Particle& p) { return !p.position.allFinite(); }, found);
    report(
        particles, "a velocity that is not finite", "repair or remove it.",
        [](const Particle& p) { return !p.velocity.allFinite(); }, found);
    report(
        particles, "a mass that is not finite", "repair or remove it.",
        [](const Particle& p) { return !std::isfinite(p.mass); }, found);
    report(
        particles, "a negative mass", "masses are 0 or more.", [](const Particle& p) { return p.mass < 0; },
        found);

    std::vector<std::uint64_t> ids;
    ids.reserve(particles.size());
    for (const Particle& particle : particles)
        ids.push_back(particle.id);
    std::sort(ids.begin(), ids.end());
    if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
        found.push_back("the id " + std::to_string(*twice) +
                        " belongs to more than one particle; give each its own.");
}

} // namespace

std::variant<ParticleSet, Problems> read_gadget2(const std::filesystem::path& path,
                                                 const std::vector<ParticleKind>& kinds)
{
    ParticleSet particles;
    Problems found;
    try {
        RecordFile file(path);
        const Header header = read_header(file);
        const auto rows = kinds_of_types(header, kinds, found);
        particles = read_particles(file, header, rows);
        check_particles(particles, found);
    } catch (const UnusableFile& failure) {
        found.emplace_back(failure.what());
    }
    if (found.empty())
        return particles;
    for (std::string& problem : found)
        problem = path.string() + ": " + problem;
    return found;
}

} // namespace slod
