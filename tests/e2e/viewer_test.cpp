#include <cstdlib>
#include <memory>
#include <signal.h>

#include <gd.h>

#include "e2e/command_fixture.hpp"
#include "view/region_shape.hpp"

// The real viewer: without a screen, and in a window on a screen that nobody sees.
namespace slod {
namespace {

using namespace std::chrono_literals;
using client::ExitCode;
using test::Child;
using test::eventually;

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// A PNG file's pixels.
class Picture {
public:
    explicit Picture(const std::filesystem::path& path)
    {
        const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
        if (file)
            image_.reset(gdImageCreateFromPng(file.get()));
    }

    bool readable() const { return image_ != nullptr; }
    int width() const { return gdImageSX(image_.get()); }
    int height() const { return gdImageSY(image_.get()); }

    /// Pixels that are not near black.
    int lit() const
    {
        constexpr int dark = 40; // of three times 255
        int count = 0;
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) {
                const int colour = gdImageGetTrueColorPixel(image_.get(), x, y);
                count +=
                    gdTrueColorGetRed(colour) + gdTrueColorGetGreen(colour) + gdTrueColorGetBlue(colour) >
                    dark;
            }
        return count;
    }

    int different_from(const Picture& other) const
    {
        int count = 0;
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x)
                count += gdImageGetTrueColorPixel(image_.get(), x, y) !=
                         gdImageGetTrueColorPixel(other.image_.get(), x, y);
        return count;
    }

private:
    struct Destroy {
        void operator()(gdImage* image) const { gdImageDestroy(image); }
    };
    std::unique_ptr<gdImage, Destroy> image_;
};

class Viewer : public CommandTest {
protected:
    Words viewer(const Words& more) const
    {
        Words words{SLOD_VIEWER, "--domain", domain.text()};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    /// Draws without a screen; for ever when nothing comes, as far as the test is concerned.
    Words headless(const Words& more = {}) const
    {
        Words words = viewer({"--screenshot", picture.string(), "--timeout", "60"});
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    Words source(const std::string& frames) const { return {WIRE_SOURCE, domain.text(), "100", frames}; }

    const std::filesystem::path picture = scratch.path() / "picture.png";
};

TEST_F(Viewer, DrawsTheFountainWithoutAScreen)
{
    Child running({SLOD_SERVER, SLOD_SCENES "/fountain.toml", "--domain", domain.text()});
    Child drawing(headless({"--size", "640x400", "--from-frame", "60", "--camera",
                            "look_at=0,0,4 distance=14 azimuth=-90 elevation=10"}));
    ASSERT_EQ(drawing.wait(), 0) << drawing.errors();
    const Picture drawn(picture);
    ASSERT_TRUE(drawn.readable());
    EXPECT_EQ(drawn.width(), 640);
    EXPECT_EQ(drawn.height(), 400);
    EXPECT_GT(drawn.lit(), 640 * 400 / 1000) << "a stream one pixel wide and a fifth of the picture high";
    EXPECT_LT(drawn.lit(), 640 * 400 / 2) << "the sky is black";
    const std::filesystem::path link = scratch.path() / "link.png";
    std::filesystem::create_symlink(picture, link);
    std::filesystem::resize_file(picture, 0);
    Child linked(viewer({"--screenshot", link.string(), "--timeout", "60"}));
    EXPECT_EQ(linked.wait(), 0) << linked.errors();
    EXPECT_TRUE(std::filesystem::is_symlink(link)) << "and what it leads to has the picture";
    EXPECT_TRUE(Picture(picture).readable());
    Child lost(headless({"--region", "nowhere"}));
    EXPECT_EQ(lost.wait(), int(ExitCode::NotFound));
    EXPECT_TRUE(contains(lost.errors(), "no region named nowhere; slodctl roi list")) << lost.errors();
}

TEST_F(Viewer, SaysThatThereIsNoServerAndWhatToDo)
{
    Child lonely(viewer({"--screenshot", picture.string(), "--timeout", "0.2"}));
    EXPECT_EQ(lonely.wait(), int(ExitCode::NoServer));
    EXPECT_TRUE(contains(lonely.errors(), "no server was heard on domain " + domain.text()))
        << lonely.errors();
    EXPECT_TRUE(contains(lonely.errors(), "start slod-server")) << lonely.errors();
    EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST_F(Viewer, NamesTheDomainThatTheServerIsOn)
{
    Child running(source("0"));
    ASSERT_TRUE(eventually([&] { return control({"status"}) == 0; })) << running.errors();
    const test::FreeDomain wrong;
    Child lost({SLOD_VIEWER, "--domain", wrong.text(), "--screenshot", picture.string(), "--timeout", "0.2"});
    EXPECT_EQ(lost.wait(), int(ExitCode::NoServer));
    const std::string errors = lost.errors();
    const std::string hint = "programs on this machine use DDS domain";
    ASSERT_TRUE(contains(errors, hint)) << errors;
    // Other tests may use other domains at the same time.
    const std::string named = errors.substr(errors.find(hint) + hint.size()) + ",";
    EXPECT_TRUE(contains(named, " " + domain.text() + ",") || contains(named, " " + domain.text() + ";"))
        << errors;
}

TEST_F(Viewer, SaysThatTheServerWasStopped)
{
    Child running(source("0"));
    Child waiting(headless({"--frames", "1000000"}));
    ASSERT_TRUE(eventually([&] { return contains(waiting.errors(), "hears"); }));
    running.signal(SIGTERM);
    EXPECT_EQ(waiting.wait(), int(ExitCode::NoServer));
    EXPECT_TRUE(contains(waiting.errors(), "the server was stopped")) << waiting.errors();
}

TEST_F(Viewer, SaysThatTheServerFellSilent)
{
    Child running(source("0"));
    Child waiting(headless({"--frames", "1000000"}));
    ASSERT_TRUE(eventually([&] { return contains(waiting.errors(), "hears"); }));
    running.signal(SIGKILL);
    EXPECT_EQ(waiting.wait(), int(ExitCode::NoServer));
    EXPECT_TRUE(contains(waiting.errors(), "it was killed, or the network is cut")) << waiting.errors();
}

TEST_F(Viewer, SaysThatTheServerIsStalled)
{
    Child running(source("1"));
    ASSERT_TRUE(eventually([&] { return control({"status"}) == 0 && answer.at("contact") == "stalled"; }))
        << running.errors();
    Child waiting(viewer({"--screenshot", picture.string(), "--frames", "1000000", "--timeout", "5"}));
    EXPECT_EQ(waiting.wait(), int(ExitCode::TimedOut));
    EXPECT_TRUE(contains(waiting.errors(), "has completed no frame for")) << waiting.errors();
}

TEST_F(Viewer, RefusesAWrongCommandLineWithTheRemedy)
{
    const auto refusal = [&](const Words& words, const std::string& remedy) {
        Child refused(viewer(words));
        EXPECT_EQ(refused.wait(), int(ExitCode::Usage));
        EXPECT_TRUE(contains(refused.errors(), remedy)) << refused.errors();
    };
    refusal({"--camera", "distance=-1"}, "distance needs a number");
    refusal({"--size", "1280"}, "WIDTHxHEIGHT");
    refusal({"--range", "5,1"}, "LOW,HIGH");
    refusal({"--frames", "3"}, "--screenshot");
    refusal({"--screenshot", ""}, "--screenshot: there is no name");
    refusal({"--screenshot", "picture.jpg"}, "--screenshot: picture.jpg is no name of a PNG picture");
    refusal({"--screenshot", "/no/folder/picture.png"}, "--screenshot: there is no folder /no/folder");
    refusal({"--zoom"}, "--zoom");
}

TEST_F(Viewer, WithoutAScreenItNamesTheWayThatNeedsNone)
{
    Child blind(
        {"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", SLOD_VIEWER, "--domain", domain.text()});
    EXPECT_EQ(blind.wait(), int(ExitCode::Failure));
    EXPECT_TRUE(contains(blind.errors(), "--screenshot")) << blind.errors();
}

/// The viewer in a window on a screen of its own, from the front at a galaxy with a region in the middle.
class ViewerWindow : public Viewer {
protected:
    void SetUp() override
    {
        // Mesa's driver leaves two small blocks behind when X unloads it. What the viewer itself would leave
        // shows in the tests without a screen.
        setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
        ASSERT_TRUE(eventually([&] { return contains(screen.output(), "\n"); })) << screen.errors();
        const std::string display = ":" + screen.output();
        setenv("DISPLAY", display.substr(0, display.find('\n')).c_str(), 1);
        ASSERT_TRUE(eventually([&] { return control({"status"}) == 0; })) << running.errors();
        ASSERT_EQ(control({"roi", "add", "core", "--centre", "0,0,0", "--half-extent", "4"}), 0);
    }

    /// A screen that is killed leaves its socket behind.
    void TearDown() override
    {
        screen.signal(SIGTERM);
        screen.wait();
    }

    /// The picture that key e writes; pressed again until one shows the scene, and `accept` takes it.
    template <class Accept>
    Picture picture_when(const Accept& accept)
    {
        std::filesystem::path path;
        EXPECT_TRUE(eventually([&] {
            path = scratch.path() / ("slod-viewer-" + std::to_string(++pictures) + ".png");
            xdotool({"key", "e"});
            return eventually([&] { return std::filesystem::exists(path); }) && accept(Picture(path));
        }));
        return Picture(path);
    }

    /// Waits until the window answers to keys and shows the scene; then takes the panels away.
    void show_scene_alone()
    {
        picture_when([](const Picture& shown) { return shown.readable() && shown.lit() > 0; });
        xdotool({"key", "p"});
        picture_when([](const Picture& shown) { return shown.readable(); }); // keys are taken in order
    }

    void xdotool(Words words) const
    {
        words.insert(words.begin(), XDOTOOL);
        Child hand(words);
        EXPECT_EQ(hand.wait(), 0) << hand.errors();
    }

    /// The window, once it draws.
    std::unique_ptr<Child> window(const Words& more)
    {
        Words words = viewer({"--size", "800x600", "--output-dir", scratch.path().string()});
        words.insert(words.end(), more.begin(), more.end());
        auto child = std::make_unique<Child>(words);
        EXPECT_TRUE(eventually([&] {
            Child search({XDOTOOL, "search", "--onlyvisible", "--name", "SLOD"});
            return search.wait() == 0;
        })) << child->errors();
        xdotool({"mousemove", "700", "580"});
        return child;
    }

    static std::string text(int number) { return std::to_string(number); }

    /// Presses the left button at one place and moves it to another.
    Words press_and_move(const view::Pixel& from, const view::Pixel& to) const
    {
        return {"mousemove", text(int(from.x)), text(int(from.y)), "mousedown",
                "1",         "mousemove",       text(int(to.x)),   text(int(to.y))};
    }

    Child screen{{XVFB, "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp", "-noreset"}};
    Child running{server()};
    const view::Camera camera{.look_at = {0, 0, 0}, .distance = 60, .azimuth_deg = -90, .elevation_deg = 0};
    const view::Lens lens{camera, {.width = 800, .height = 600}};
    int pictures = 0;
};

TEST_F(ViewerWindow, AHandleThatIsDraggedMovesTheRegionAndChangesThePicture)
{
    const auto child = window({"--camera", view::to_text(camera)});
    client::Connection connection = connect({.regions = true});
    const auto region = [&] { return connection.regions().at("core"); };
    ASSERT_TRUE(sees(connection, [&] { return connection.knows_all_regions(); }));
    const view::RegionPose before = *view::pose_of(region());
    show_scene_alone();
    ASSERT_EQ(control({"pause"}), 0);
    ASSERT_TRUE(sees(connection, [&] { return connection.server()->paused; }));
    // Paused, two pictures are the same but for what the hand does; the first may still be of a frame
    // earlier.
    std::unique_ptr<Picture> still;
    picture_when([&](Picture shown) {
        const bool rests = still && shown.different_from(*still) == 0;
        still = std::make_unique<Picture>(std::move(shown));
        return rests;
    });

    // The middle, seventy pixels to the right and thirty up.
    const view::Pixel middle = *lens.project({0, 0, 0}), aside{middle.x + 70, middle.y - 30};
    xdotool(press_and_move(middle, aside));
    xdotool({"mouseup", "1"});
    const view::RegionPose moved = view::dragged(before, view::Handle{}, lens, middle, aside);
    constexpr double rounding = 1e-9; // pixels are whole, and poses travel as doubles
    EXPECT_TRUE(sees(connection, [&] {
        return (view::pose_of(region())->centre - moved.centre).norm() < rounding;
    })) << child->errors();
    EXPECT_EQ(control({"roi", "show", "core"}), 0);
    EXPECT_NEAR(answer.at("centre").at(0).get<double>(), moved.centre.x(), rounding);
    EXPECT_EQ(answer.at("half_extent"), nlohmann::json({4, 4, 4}));
    picture_when([&](const Picture& shown) { return shown.different_from(*still) > 100; });

    child->signal(SIGTERM);
    EXPECT_EQ(child->wait(), 0) << child->errors();
}

TEST_F(ViewerWindow, AFaceIsResizedAndEscapePutsItBack)
{
    const auto child = window({"--camera", view::to_text(camera)});
    client::Connection connection = connect({.regions = true});
    ASSERT_TRUE(sees(connection, [&] { return connection.knows_all_regions(); }));
    const auto half_width = [&] { return connection.regions().at("core").half_extent[0]; };
    show_scene_alone();
    const view::Pixel face = *lens.project({4, 0, 0}), out{face.x + 100, face.y};
    xdotool(press_and_move(face, out));
    EXPECT_TRUE(sees(connection, [&] { return half_width() > 4; }))
        << "the server is told while it is dragged";
    xdotool({"key", "Escape"});
    EXPECT_TRUE(sees(connection, [&] { return half_width() == 4; }));
    xdotool({"mouseup", "1"});
    EXPECT_EQ(connection.regions().at("core").centre[0], 0);
}

TEST_F(ViewerWindow, AFollowingRegionGoesWhereTheCameraGoes)
{
    const auto child = window({"--camera", view::to_text(camera), "--follow", "--name", "desk"});
    client::Connection connection = connect({.regions = true});
    const auto is_at = [&](const view::Vector& eye) {
        const auto found = connection.regions().find("desk");
        if (found == connection.regions().end())
            return false;
        const auto& centre = found->second.centre;
        constexpr double rounding = 1e-9; // of sines of angles read back from text
        return (view::Vector(centre[0], centre[1], centre[2]) - eye).norm() < rounding * camera.distance;
    };
    EXPECT_TRUE(sees(connection, [&] { return is_at(camera.eye()); })) << child->errors();
    EXPECT_EQ(connection.regions().at("desk").shape, "frustum");
    xdotool({"key", "5"});
    const view::Camera top = view::seen_from(camera, view::AxisView::Top);
    EXPECT_TRUE(sees(connection, [&] { return is_at(top.eye()); })) << child->errors();
}

} // namespace
} // namespace slod
