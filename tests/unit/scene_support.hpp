#pragma once

#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.hpp"
#include "support/scratch_folder.hpp"

namespace slod::test {

/// The least that is a scene.
inline const std::string minimal_scene = "[[kind]]\n"
                                         "name = \"star\"\n"
                                         "[background]\n"
                                         "max_breadth = 1.0\n";

/// What load_scene makes of a text in a file s.toml.
inline std::variant<Scene, Problems> load_text(const std::string& text,
                                               const std::vector<std::string>& overrides = {})
{
    const ScratchFolder folder;
    return load_scene(folder.write("s.toml", text), overrides);
}

/// Its problems, with the folder's name left out; empty when it is a scene.
inline Problems problems_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const auto loaded = load_text(text, overrides);
    const auto* const found = std::get_if<Problems>(&loaded);
    Problems result = found != nullptr ? *found : Problems{};
    for (std::string& problem : result)
        if (const auto name = problem.find("s.toml"); problem.starts_with('/') && name != std::string::npos)
            problem.erase(0, name);
    return result;
}

/// The scene; fails the test, and is the default one, when there are problems.
inline Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
    const auto loaded = load_text(text, overrides);
    if (const auto* const found = std::get_if<Problems>(&loaded))
        for (const std::string& problem : *found)
            ADD_FAILURE() << problem;
    const auto* const scene = std::get_if<Scene>(&loaded);
    return scene != nullptr ? *scene : Scene{};
}

/// Whether exactly one problem contains all of `parts`.
inline testing::AssertionResult one_says(const Problems& problems, const std::vector<std::string>& parts)
{
    int count = 0;
    std::string all;
    for (const std::string& problem : problems) {
        bool has_all = true;
        for (const std::string& part : parts)
            has_all = has_all && problem.find(part) != std::string::npos;
        count += has_all;
        all += "\n  " + problem;
    }
    if (count == 1)
        return testing::AssertionSuccess();
    std::string wanted;
    for (const std::string& part : parts)
        wanted += " \"" + part + "\"";
    return testing::AssertionFailure() << count << " problems contain" << wanted << " of:" << all;
}

/// Whether there is one problem, which contains all of `parts`.
inline testing::AssertionResult only_says(const Problems& problems, const std::vector<std::string>& parts)
{
    const auto result = one_says(problems, parts);
    if (result && problems.size() > 1)
        return testing::AssertionFailure()
               << "and " << problems.size() - 1 << " more, such as " << problems.back();
    return result;
}

} // namespace slod::test
