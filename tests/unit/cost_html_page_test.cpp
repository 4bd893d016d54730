#include "cost_rows.hpp"

#include <gtest/gtest.h>

#include "cost/html_page.hpp"
#include "support/well_formed.hpp"

namespace slod::cost {
namespace {

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
    EXPECT_EQ(test::malformed(page), "") << page;
    EXPECT_EQ(test::malformed(html_page(sweep, circumstances, "", "")), "");
    EXPECT_NE(test::malformed("<p>" + page), ""); // so that the parser says something
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
