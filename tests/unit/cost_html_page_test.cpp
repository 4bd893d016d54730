#include "cost_rows.hpp"

#include <cctype>
#include <vector>

#include <gtest/gtest.h>

#include "cost/html_page.hpp"

namespace slod::cost {
namespace {

/// What is wrong with a document of elements, their attributes in double quotes, and text without & but for
/// the three that stand for characters; empty when it is well-formed.
std::string malformed(const std::string& page)
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

const Sweep sweep{.rows = {row({}, 100, 0.1), row({Motion::Flow, 16}, 10, 3), row({Motion::Flow, 64}, 20, 3),
                           row({Motion::Rigid, 16, 0.1, {}, 2}, 5, 4)}};

const Circumstances circumstances{.scene = "Stars & <clouds>",
                                  .version = "1.0",
                                  .machine = "a \"fast\" one",
                                  .particles = 100,
                                  .frames = 10,
                                  .threads = 2};

const std::string svg = "<?xml version=\"1.0\"?>\n<svg width=\"9\"><path d=\"M0,0\"/></svg>\n";

TEST(CostPage, IsWellFormedWhateverTheSceneIsCalled)
{
    const std::string page = html_page(sweep, circumstances, svg, "title = \"a < b && c > d\"\x01\n");
    EXPECT_EQ(malformed(page), "") << page;
    EXPECT_EQ(malformed(html_page(sweep, circumstances, "", "")), "");
    EXPECT_NE(malformed("<p>" + page), ""); // so that the parser says something
}

TEST(CostPage, NeedsNoOtherFileAndNoScript)
{
    const std::string page = html_page(sweep, circumstances, svg, "");
    for (const char* needed : {"<script", "src=", "href=", "@import", "url("})
        EXPECT_EQ(page.find(needed), std::string::npos) << needed;
}

TEST(CostPage, HasAnswerPictureTableSceneAndMachine)
{
    const std::string page = html_page(sweep, circumstances, svg, "step = 0.25");
    for (const char* part :
         {"<li>at  60 frames a second      flow 16: 10.000 ms", "<svg width", "rigid 16, clock 0.1, 2 steps",
          "step = 0.25", "a \"fast\" one", "Stars &amp; &lt;clouds&gt;"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
    EXPECT_EQ(page.find("<?xml"), std::string::npos);
}

TEST(CostPage, MarksWhatNothingBeats)
{
    const std::string page = html_page(sweep, circumstances, svg, "");
    EXPECT_NE(page.find("<tr class=\"front\"><td>flow 16</td>"), std::string::npos) << page;
    EXPECT_NE(page.find("<tr><td>flow 64</td>"), std::string::npos) << page;
}

} // namespace
} // namespace slod::cost
