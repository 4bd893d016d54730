#include "cost/bodies.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

#include "core/portable_math.hpp"
#include "scene/gadget2.hpp"
#include "scene/text_lines.hpp"

namespace slod::cost {
namespace {

Vector3d on_unit_sphere(Random& random)
{
    const double z = 2 * random.uniform() - 1;
    const auto turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    const double rho = std::sqrt(1 - z * z);
    return {rho * turn.cosine, rho * turn.sine, z};
}

/// Two normal deviates (Box and Muller 1958).
std::array<double, 2> normals(Random& random)
{
    const double radius = std::sqrt(-2 * portable_log(random.uniform()));
    const auto turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    return {radius * turn.cosine, radius * turn.sine};
}

Vector3d in_plummer_sphere(Random& random)
{
    double radius = 0;
    do // Aarseth, Henon and Wielen 1974, A&A 37, 183: the mass within r is r^3 / (1 + r^2)^(3/2)
        radius = 1 / std::sqrt(portable_exp(-2.0 / 3.0 * portable_log(random.uniform())) - 1);
    while (radius > 20);
    return radius * on_unit_sphere(random);
}

Vector3d in_two_clumps(Random& random)
{
    const auto [x, y] = normals(random);
    const Vector3d offset = 0.02 * Vector3d(x, y, normals(random)[0]);
    return random.bits() % 2 == 0 ? offset : Vector3d(offset + Vector3d(10.1, 9.9, 10));
}

Vector3d in_disc(Random& random)
{
    const double radius = -portable_log(random.uniform() * random.uniform());
    const auto turn = portable_sincos(2 * std::numbers::pi * random.uniform());
    return {radius * turn.cosine, radius * turn.sine, 0.05 * normals(random)[0]};
}

Vector3d in_box(Random& random)
{
    const double x = random.uniform(), y = random.uniform();
    return {x, y, random.uniform()};
}

constexpr std::array<CloudModel, 4> models{
    {{"plummer", in_plummer_sphere}, {"clumps", in_two_clumps}, {"disc", in_disc}, {"box", in_box}}};

void number_ids(ParticleSet& bodies)
{
    for (std::size_t i = 0; i < bodies.size(); ++i)
        bodies[i].id = i + 1;
}

/// Whether the file begins as one of GADGET-2 does: with the length of its header.
bool is_gadget2(const std::filesystem::path& file)
{
    constexpr std::uint32_t header_bytes = 256;
    std::array<char, 4> marker{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(marker.data(), marker.size()))
        return false;
    std::uint32_t length = 0;
    std::memcpy(&length, marker.data(), sizeof length);
    return length == header_bytes;
}

/// All types in one kind: what they differ in here is nothing.
std::variant<ParticleSet, Problems> read_snapshot(const std::filesystem::path& file)
{
    std::vector<ParticleKind> kinds;
    for (const std::string_view type : gadget2_types)
        kinds.push_back({std::string(type), 0});
    auto read = read_gadget2(file, kinds);
    if (auto* const bodies = std::get_if<ParticleSet>(&read)) {
        number_ids(*bodies);
        for (Particle& body : *bodies) {
            body.kind = 0;
            body.velocity.setZero();
        }
    }
    return read;
}

/// As of all that a scene may set.
constexpr double largest_number = 1e30;

/// The numbers of a line, with blanks or one comma between them; false where something else is in it, or
/// another number of them.
bool read_numbers(std::string_view line, std::array<double, 4>& numbers)
{
    const char* at = line.data();
    const char* const end = at + line.size();
    const auto skip_blanks = [&] {
        while (at != end && std::string_view(" \t\r").find(*at) != std::string_view::npos)
            ++at;
    };
    const auto skip_separator = [&] {
        const char* const begin = at;
        skip_blanks();
        if (at != end && *at == ',')
            ++at;
        skip_blanks();
        return at != begin;
    };
    skip_blanks();
    for (double& number : numbers) {
        if (&number != numbers.data() && !skip_separator())
            return false;
        const auto read = std::from_chars(at, end, number);
        if (read.ec != std::errc() || !(std::abs(number) <= largest_number))
            return false;
        at = read.ptr;
    }
    skip_blanks();
    return at == end;
}

std::variant<ParticleSet, Problems> read_text(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    ParticleSet bodies;
    std::string line;
    const auto refuse = [&](std::size_t number, const std::string& why) {
        return Problems{file.string() + ":" + std::to_string(number) + ": \"" + line.substr(0, 60) + "\" " +
                        why};
    };
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        if (number == 1)
            drop_byte_order_mark(line);
        if (const auto first = line.find_first_not_of(" \t\r"); first == line.npos || line[first] == '#')
            continue;
        std::array<double, 4> numbers{};
        if (!read_numbers(line, numbers))
            return refuse(number, "is no body; write its x, y, z and mass, four numbers of at most 1e30.");
        const double mass = numbers[3];
        if (mass < 0)
            return refuse(number, "has a mass below 0; only 0 and more attract.");
        if (bodies.size() == max_text_bodies)
            return refuse(number,
                          "is one body too many; use at most " + std::to_string(max_text_bodies) + ".");
        Particle body{.position = {numbers[0], numbers[1], numbers[2]}, .velocity = Vector3d::Zero()};
        body.mass = float(mass);
        bodies.push_back(body);
    }
    if (bodies.empty())
        return Problems{file.string() + ": there is no body in it; write a line \"x y z mass\" for each."};
    number_ids(bodies);
    return bodies;
}

} // namespace

ParticleSet cloud(std::size_t count, std::uint64_t seed, const std::function<Vector3d(Random&)>& place)
{
    ParticleSet bodies(count);
    number_ids(bodies);
    for (Particle& body : bodies) {
        Random random(seed, 0, body.id);
        body.position = place(random);
        body.velocity.setZero();
        body.mass = 1 / float(count);
    }
    return bodies;
}

std::span<const CloudModel> cloud_models()
{
    return models;
}

const CloudModel* cloud_model(std::string_view name)
{
    const auto found = std::find_if(models.begin(), models.end(),
                                    [&](const CloudModel& model) { return model.name == name; });
    return found == models.end() ? nullptr : &*found;
}

std::variant<ParticleSet, Problems> read_bodies(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return Problems{file.string() + ": " + (error ? error.message() : "this is no regular file") +
                        "; name a GADGET-2 file, or a text file with a line \"x y z mass\" for each body."};
    if (!std::ifstream(file))
        return Problems{file.string() + ": cannot be read; check its permissions."};
    return is_gadget2(file) ? read_snapshot(file) : read_text(file);
}

std::variant<ParticleSet, Problems> bodies_of(const std::string& model_or_file,
                                              std::optional<std::size_t> count,
                                              std::optional<std::uint64_t> seed)
{
    if (const CloudModel* const model = cloud_model(model_or_file))
        return cloud(count.value_or(100'000), seed.value_or(1), model->place);
    std::error_code error;
    if (std::filesystem::status(model_or_file, error).type() == std::filesystem::file_type::not_found) {
        std::string names;
        for (const CloudModel& known : models)
            names += (names.empty() ? "" : ", ") + std::string(known.name);
        return Problems{model_or_file + ": there is no such file; models without one are " + names + "."};
    }
    if (count || seed)
        return Problems{model_or_file + ": a number of bodies and a seed are of models without a file; leave "
                                        "--n and --seed out, or name such a model."};
    return read_bodies(model_or_file);
}

} // namespace slod::cost
