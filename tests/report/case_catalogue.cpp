#include "report/case_catalogue.hpp"

#include <array>

#include "core/formatted.hpp"
#include "scene/scene_document.hpp"

namespace slod::report {
namespace {

struct Family {
    char letter;
    int count;
};
constexpr std::array families{Family{'G', 37}, Family{'F', 34}, Family{'S', 36}, Family{'N', 24}};

/// Text of a key that has to be one; nothing where it is missing.
std::string text_of(const toml::table& table, std::string_view key, Problems& problems)
{
    const toml::node* const node = table.get(key);
    if (node == nullptr)
        return "";
    const auto* const text = node->as_string();
    if (text == nullptr || text->get().empty())
        problems.push_back(where(*node) + ": " + std::string(key) +
                           " has to be a text in double quotes with something in it");
    return text == nullptr ? "" : text->get();
}

HardCase read_case(const std::string& number, const toml::table& table, Problems& problems)
{
    for (const auto& [key, node] : table)
        if (key.str() != "claim" && key.str() != "note" && key.str() != "struck")
            problems.push_back(where(node) + ": no \"" + std::string(key.str()) +
                               "\" is known; a case has claim, note and struck");
    if (!table.contains("claim"))
        problems.push_back(where(table) + ": " + number + " has no claim; say in a sentence what holds");
    return {number, text_of(table, "claim", problems), text_of(table, "note", problems),
            text_of(table, "struck", problems)};
}

void read_family(Family family, const std::filesystem::path& file, Catalogue& catalogue)
{
    if (!std::filesystem::exists(file)) {
        catalogue.problems.push_back(file.string() +
                                     formatted(" is missing; write it, with tables [%c01] to [%c%02d]",
                                               family.letter, family.letter, family.count));
        return;
    }
    toml::table all;
    try {
        all = toml::parse_file(file.string());
    } catch (const toml::parse_error& failure) {
        catalogue.problems.push_back(file.string() + ":" + std::to_string(failure.source().begin.line) +
                                     ": not TOML: " + std::string(failure.description()));
        return;
    }
    for (int i = 1; i <= family.count; ++i) {
        const std::string number = formatted("%c%02d", family.letter, i);
        const toml::table* const table = all.get_as<toml::table>(number);
        if (table != nullptr)
            catalogue.cases.push_back(read_case(number, *table, catalogue.problems));
        else if (!all.contains(number))
            catalogue.problems.push_back(file.string() + ": no [" + number +
                                         "]; add it, with a claim, and a reason if it is struck");
        if (table != nullptr)
            all.erase(number);
    }
    for (const auto& [key, node] : all)
        catalogue.problems.push_back(
            where(node) + ": \"" + std::string(key.str()) +
            formatted("\" is no table of a case from %c01 to %c%02d; make it one or take it out",
                      family.letter, family.letter, family.count));
}

} // namespace

Catalogue read_catalogue(const std::filesystem::path& folder)
{
    Catalogue catalogue;
    for (const Family family : families)
        read_family(family, folder / (std::string(1, family.letter) + ".toml"), catalogue);
    return catalogue;
}

} // namespace slod::report
