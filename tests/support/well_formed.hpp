#pragma once

#include <string>
#include <vector>

namespace slod::test {

/// What is wrong with a document of elements, their attributes in double quotes, and text without & but for
/// the three that stand for characters; empty when it is well-formed.
inline std::string malformed(const std::string& page)
{
    std::vector<std::string> open;
    for (std::size_t at = 0; at < page.size(); ++at) {
        if (page[at] == '&' && page.compare(at, 4, "&lt;") != 0 && page.compare(at, 4, "&gt;") != 0 &&
            page.compare(at, 5, "&amp;") != 0)
            return "a bare &";
        if (page[at] == '>')
            return "a bare >";
        if (page[at] != '<')
            continue;
        const std::size_t end = page.find('>', at);
        if (end == std::string::npos)
            return "no end of a tag";
        const std::string tag = page.substr(at + 1, end - at - 1);
        at = end;
        std::size_t quotes = 0;
        for (const char c : tag)
            quotes += c == '"' ? 1 : 0;
        if (quotes % 2 != 0 || tag.find('<') != std::string::npos)
            return "a tag <" + tag + ">";
        if (tag.starts_with("!DOCTYPE") || tag.ends_with("/"))
            continue;
        const std::string name = tag.substr(0, tag.find_first_of(" \n\t"));
        if (!name.starts_with("/"))
            open.push_back(name);
        else if (open.empty() || "/" + open.back() != name)
            return "<" + name + "> ends <" + (open.empty() ? "" : open.back()) + ">";
        else
            open.pop_back();
    }
    return open.empty() ? "" : "no end of <" + open.back() + ">";
}

} // namespace slod::test
