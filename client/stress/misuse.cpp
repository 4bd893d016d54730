#include "stress/misuse.hpp"

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>

#include "stress/storm.hpp"

namespace slod::stress {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A name that no region has: each command that uses it is refused.
constexpr const char* nobody = "stress-nobody";

/// No region is ever at it.
constexpr std::uint64_t no_revision = std::uint64_t{1} << 62;

// What Command in slod.idl has room for.
constexpr std::size_t name_capacity = 32, value_capacity = 128, settings_capacity = 64;

constexpr std::string_view invalid = "invalid";
constexpr std::string_view unsupported = "unsupported";

using Cases = std::vector<Misuse>;

void add_kinds(Cases& cases)
{
    for (const char* kind :
         {"fly", "", "ADD_ROI", "add_roi ", "add_roi\n", "\x01\x7f", "pause;stop", "\xc3\xa9"})
        cases.push_back({"kind", {.kind = kind}, unsupported});
    cases.push_back({"longest kind", {.kind = std::string(name_capacity, 'k')}, unsupported});
}

void add_names(Cases& cases)
{
    for (const char* name :
         {"", "Core", "two words", "a/b", "../up", "a\nb", "\x01", "\xc3\xa9", "*", "roi/*"})
        cases.push_back({"name",
                         {.kind = "add_roi", .region = name, .radius = 1, .settings = {{"shape", "sphere"}}},
                         invalid});
    for (const char* kind : {"move_roi", "resize_roi", "set_roi", "remove_roi"}) {
        cases.push_back({"region that is not there", {.kind = kind, .region = nobody}, "unknown_region"});
        cases.push_back({"longest name that is not there",
                         {.kind = kind, .region = std::string(name_capacity, 'n')},
                         "unknown_region"});
    }
    cases.push_back({"background", {.kind = "remove_roi", .region = "background"}, "not_permitted"});
    cases.push_back({"background", {.kind = "move_roi", .region = "background"}, invalid});
}

Draft sphere(const Vector& centre, double radius)
{
    return {.kind = "add_roi",
            .region = nobody,
            .centre = centre,
            .radius = radius,
            .settings = {{"shape", "sphere"}}};
}

Draft with_lease(double lease_s)
{
    Draft draft = sphere({}, 1);
    draft.lease_s = lease_s;
    return draft;
}

void add_numbers(Cases& cases, const std::string& box)
{
    for (const double number : {nan, infinity, -infinity}) {
        cases.push_back({"centre", sphere({0, number, 0}, 1), invalid});
        cases.push_back({"centre", {.kind = "move_roi", .region = box, .centre = {number, 0, 0}}, invalid});
        cases.push_back(
            {"half_extent", {.kind = "resize_roi", .region = box, .half_extent = {1, 1, number}}, invalid});
        cases.push_back({"radius", sphere({}, number), invalid});
        cases.push_back({"lease_s", with_lease(number), invalid});
    }
    for (const double number : {-1.0, -1e300})
        cases.push_back({"radius", sphere({}, number), invalid});
    for (const double number : {-1.0, 1e7, 1e300})
        cases.push_back({"lease_s", with_lease(number), invalid});
    cases.push_back(
        {"half_extent", {.kind = "resize_roi", .region = box, .half_extent = {1, -1, 1}}, invalid});
    cases.push_back({"half_extent", {.kind = "resize_roi", .region = box}, invalid});
    cases.push_back({"radius of a box", {.kind = "resize_roi", .region = box, .radius = 1}, invalid});
    cases.push_back({"no shape", {.kind = "add_roi", .region = nobody, .radius = 1}, invalid});
    cases.push_back({"step while it runs", {.kind = "step", .frames = 1}, "not_permitted"});
}

void add_settings(Cases& cases, const std::string& box)
{
    const std::initializer_list<std::pair<std::string, std::string>> wrong{
        {"lunch", "1"},
        {"", ""},
        {"max_cluster_size", ""},
        {"max_cluster_size", "0"},
        {"max_cluster_size", "-1"},
        {"max_cluster_size", "1e300"},
        {"max_cluster_size", "many"},
        {"max_cluster_size", "[1, 2]"},
        {"max_breadth", "nan"},
        {"shape", "banana"},
        {"shape", "\"box"},
        {"name", "another"},
        {"centre", "[1, 2]"},
        {"centre", "[[[[[[[["},
        {"precedence", "1e18"},
        {"\x01\x02", "\x03"},
        {std::string(value_capacity / 2, 's'), std::string(value_capacity, 'v')},
    };
    for (const auto& setting : wrong) {
        cases.push_back(
            {"setting of a region", {.kind = "set_roi", .region = box, .settings = {setting}}, invalid});
        cases.push_back({"setting of a new region",
                         {.kind = "add_roi", .region = nobody, .settings = {{"shape", "box"}, setting}},
                         invalid});
        cases.push_back(
            {"setting of the scene",
             {.kind = "set", .settings = {{"gravity." + setting.first.substr(0, 32), setting.second}}},
             invalid});
    }
    cases.push_back({"setting that stays", {.kind = "set", .settings = {{"time.step", "1"}}}, invalid});
    cases.push_back({"nothing set", {.kind = "set"}, invalid});
    cases.push_back({"nothing set", {.kind = "set_roi", .region = box}, invalid});
    const Settings most(settings_capacity, {"lunch", std::string(value_capacity, '9')});
    cases.push_back({"most settings", {.kind = "set_roi", .region = box, .settings = most}, invalid});
    cases.push_back({"most settings", {.kind = "set", .settings = most}, invalid});
}

void add_revisions(Cases& cases, const std::string& box)
{
    for (const char* kind : {"move_roi", "resize_roi", "set_roi", "remove_roi"})
        cases.push_back({"if_revision",
                         {.kind = kind, .region = box, .if_revision = no_revision, .half_extent = {1, 1, 1}},
                         "stale_revision"});
    for (const char* kind : {"keep_alive", "add_roi", "pause", "stop"})
        cases.push_back({"if_revision", {.kind = kind, .region = nobody, .if_revision = 1}, invalid});
    cases.push_back({"region that is there", add_box(box, {}, 1, 0), "region_exists"});
}

} // namespace

std::vector<Misuse> misuses(const std::string& box)
{
    Cases cases;
    add_kinds(cases);
    add_names(cases);
    add_numbers(cases, box);
    add_settings(cases, box);
    add_revisions(cases, box);
    return cases;
}

} // namespace slod::stress
