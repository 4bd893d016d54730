#include "scene_support.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scene/surface_file.hpp"

// Files of surfaces: what is read of them, and what is refused, with file, line, text and remedy.
namespace slod::test {
namespace {

using Triangles = std::vector<Mesh::Triangle>;

class SurfaceFile : public testing::Test {
protected:
    std::variant<Mesh, Problems> obj(const std::string& text) const
    {
        return read_obj(folder_.write("s.obj", text));
    }
    Mesh mesh(const std::string& text) const
    {
        const auto read = obj(text);
        if (const auto* const found = std::get_if<Problems>(&read))
            ADD_FAILURE() << found->front();
        return std::holds_alternative<Mesh>(read) ? std::get<Mesh>(read) : Mesh{};
    }

    /// Whether the only problem has all the parts.
    static testing::AssertionResult refused(const std::variant<Mesh, Problems>& read,
                                            const std::vector<std::string>& parts)
    {
        if (const auto* const found = std::get_if<Problems>(&read))
            return only_says(*found, parts);
        return testing::AssertionFailure() << "it was taken";
    }

    static std::string face_of(std::size_t vertices)
    {
        std::string face = "f";
        for (std::size_t i = 0; i < vertices; ++i)
            face += " 1";
        return face + "\n";
    }

    const ScratchFolder folder_;
    const std::string square_ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\n";
};

TEST_F(SurfaceFile, HasVerticesAndFacesInEveryNotation)
{
    const Mesh read = mesh("\xEF\xBB\xBF# a square\r\nmtllib a.mtl\no square\n" + square_ +
                           "vt 0 0\nvn 0 0 1\n\ns off\nusemtl red\n"
                           "f 1 2 3\nf 1/1 3/1 4/1 # half\nf 1//1 2//1 4//1\nf -4/1/1 -3/1/1 -1/1/1\n");
    ASSERT_EQ(read.vertices.size(), 4U);
    EXPECT_EQ(read.vertices[3], Vector3d(0, 1, 0.5));
    EXPECT_EQ(read.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {0, 1, 3}}));
}

TEST_F(SurfaceFile, HasFacesOfManyVerticesDividedAboutTheFirst)
{
    EXPECT_EQ(mesh(square_ + "f 1 2 3 4\nv 0 0.5 1e-3 1.0\nf 2 3 4 5 1\n").triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST_F(SurfaceFile, IsRefusedWithLineTextAndRemedyWhereItIsMalformed)
{
    struct Case {
        std::string text;
        std::vector<std::string> parts;
    };
    const std::vector<Case> cases{
        {"v 0 0 0\nv 1 0", {"s.obj:2: \"v 1 0\": a vertex has three coordinates", "get the whole file"}},
        {square_ + "f 1 2", {"s.obj:5: \"f 1 2\": a face has at least three vertices", "write \"f 1 2 3\""}},
        {square_ + "f 1 2 5\n", {"s.obj:5: \"f 1 2 5\": there is no vertex 5 yet; use 1 to 4, or -1"}},
        {square_ + "f 1 2 0\n", {"there is no vertex 0 yet; use 1 to 4"}},
        {square_ + "f 1 2 -5\n", {"there is no vertex -5 yet"}},
        {square_ + "f 1 2 99999999999999999999\n",
         {"\"99999999999999999999\" is no vertex; write its number"}},
        {square_ + "f 1 2 3.5\n", {"\"3.5\" is no vertex"}},
        {square_ + "f 1 2 x/1\n", {"\"x/1\" is no vertex"}},
        {"v 0 nan 0\n", {"s.obj:1:", "\"nan\" is no finite number; write one"}},
        {"v 0 0 inf\n", {"\"inf\" is no finite number"}},
        {"v 0 1e999 0\n", {"\"1e999\" is no finite number"}},
        {"v 0 2e30 0\n", {"\"2e30\" is out of range; use -1e30 to 1e30"}},
        {"v 0 1,5 0\n", {"\"1,5\" is no finite number"}},
        {"\n\nsolid cube\n",
         {"s.obj:3: \"solid cube\": this is no line of a Wavefront OBJ file", "name another file"}},
        {square_, {"s.obj: there is no face in it; write some"}},
        {"", {"s.obj: there is no face in it"}},
        {std::string("\x7f\0ELF\x01\x02", 7), {"s.obj:1:", "no line of a Wavefront OBJ file"}},
        {std::string((1 << 20) + 1, 'v'), {"line 1 is longer than 1048576 characters; name a file of text"}},
    };
    for (const Case& each : cases)
        EXPECT_TRUE(refused(obj(each.text), each.parts)) << each.text.substr(0, 200);
}

TEST_F(SurfaceFile, IsRefusedWhereItIsNone)
{
    EXPECT_TRUE(refused(read_obj(folder_.path() / "none.obj"), {"none.obj: there is no such file; check"}));
    EXPECT_TRUE(refused(read_obj(folder_.path()), {"this is no regular file; name one"}));
    EXPECT_TRUE(refused(read_obj("/dev/null"), {"this is no regular file"}));
}

TEST_F(SurfaceFile, IsRefusedWhereItHasMoreThanTheLimit)
{
    std::string many;
    for (std::size_t i = 0; i <= max_mesh_vertices; ++i)
        many += "v 0 0 0\n";
    EXPECT_TRUE(refused(obj(many), {"s.obj:1048577:", "more than 1048576 vertices; use a coarser surface"}));
    const std::string face = face_of(max_face_vertices);
    std::string faces = "v 0 0 0\n";
    for (std::size_t i = 0; i < max_mesh_triangles / (max_face_vertices - 2) + 1; ++i)
        faces += face;
    EXPECT_TRUE(refused(obj(faces), {"s.obj:33827:", "more than 2097152 triangles; use a coarser surface"}));
}

TEST_F(SurfaceFile, IsRefusedWhereAFaceHasTooManyVertices)
{
    const std::string vertices = "v 0 0 0\n";
    EXPECT_EQ(mesh(vertices + face_of(64)).triangles.size(), 62U);
    EXPECT_TRUE(refused(obj(vertices + face_of(65)),
                        {"s.obj:2:", "a face of 65 vertices, where 64 are the most; cut it up"}));
}

// About the second vertex, and about that place, which every triangle has a vertex of its own at.
TEST_F(SurfaceFile, IsRefusedWhereTooManyTrianglesShareAVertex)
{
    const auto shared = [](std::size_t triangles, bool joined) {
        std::string text = "v 9 9 9\nv 0 0 0\n";
        for (std::size_t i = 0; i < triangles; ++i)
            text += (joined ? "" : "v -0 0 0\n") + ("v 1 0 " + std::to_string(i)) + "\nv 0 1 0.5\nf " +
                    (joined ? "2" : "-3") + " -2 -1\n";
        return text;
    };
    for (const bool joined : {true, false}) {
        // Those at (0, 1, 0.5) are as many, and come later.
        EXPECT_EQ(mesh(shared(256, joined)).triangles.size(), 256U);
        EXPECT_TRUE(refused(
            obj(shared(257, joined)),
            {"s.obj: 257 triangles meet at vertex 2, where 256 are the most", "cut the faces about it up"}));
    }
}

TEST_F(SurfaceFile, HasHeightsOverAGrid)
{
    const auto read = read_heights(folder_.write("s.txt", "# two lines\n0 1 2.5\n\n-1 0 1e-3\n"));
    ASSERT_TRUE(std::holds_alternative<Mesh>(read));
    const Mesh& surface = std::get<Mesh>(read);
    ASSERT_EQ(surface.vertices.size(), 6U);
    EXPECT_EQ(surface.vertices[2], Vector3d(2, 0, 2.5));
    EXPECT_EQ(surface.vertices[3], Vector3d(0, 1, -1));
    EXPECT_EQ(surface.triangles, (Triangles{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}));
    const auto heights = [&](const std::string& text) { return read_heights(folder_.write("s.txt", text)); };
    EXPECT_TRUE(refused(heights("0 1\n2\n"), {"s.txt:2: \"2\": 1 heights where the lines before have 2"}));
    EXPECT_TRUE(
        refused(heights("0 1 2\n"), {"s.txt: 1 lines of 3 heights make no surface; give at least 2"}));
    EXPECT_TRUE(refused(heights("0\n1\n"), {"2 lines of 1 heights make no surface"}));
    EXPECT_TRUE(refused(heights(""), {"0 lines of 0 heights"}));
    EXPECT_TRUE(refused(heights("0 1\n2 nan\n"), {"s.txt:2:", "\"nan\" is no finite number"}));
}

/// A cube of three samples along each axis about (1, 2, 3), of which the middle one is inside.
std::string grid_text(const std::string& middle = "-0.5")
{
    const std::string nine = "1 1 1 1 1 1 1 1 1\n";
    return "3 3 3\n0.5 1.5 2.5\n0.5\n" + nine + "1 1 1 1 " + middle + " 1 1 1 1\n" + nine;
}

// Of the 26 points around the middle those 14 that share an edge of a tetrahedron with it see it, each a
// third of the way out.
TEST_F(SurfaceFile, HasTheZeroLevelOfDistancesOverAGrid)
{
    const auto read = read_distance_grid(folder_.write("s.sdf", "# a point\n" + grid_text() + "\n\n"));
    ASSERT_TRUE(std::holds_alternative<Mesh>(read)) << std::get<Problems>(read).front();
    const Mesh& surface = std::get<Mesh>(read);
    EXPECT_EQ(surface.vertices.size(), 14U);
    EXPECT_EQ(surface.triangles.size(), 24U);
    Vector3d least = surface.vertices.front(), most = least;
    for (const Vector3d& vertex : surface.vertices) {
        least = least.cwiseMin(vertex);
        most = most.cwiseMax(vertex);
    }
    EXPECT_LE((least - Vector3d(1 - 0.5 / 3, 2 - 0.5 / 3, 3 - 0.5 / 3)).norm(), 1e-15);
    EXPECT_LE((most - Vector3d(1 + 0.5 / 3, 2 + 0.5 / 3, 3 + 0.5 / 3)).norm(), 1e-15);
}

// The numbers of the axes differ, and so do the distances along each.
TEST_F(SurfaceFile, HasDistancesWithXFastestThenYThenZ)
{
    const auto read = read_distance_grid(
        folder_.write("s.sdf", "2 3 4\n0 0 0\n1\n" + std::string("9 9 9 9 9 9\n9 9 9 -3 9 9\n") +
                                   "9 9 9 9 9 9\n9 9 9 9 9 9\n"));
    ASSERT_TRUE(std::holds_alternative<Mesh>(read)) << std::get<Problems>(read).front();
    for (const Vector3d& vertex : std::get<Mesh>(read).vertices) // about (1, 1, 1), a quarter of the way out
        EXPECT_NEAR((vertex - Vector3d(1, 1, 1)).cwiseAbs().maxCoeff(), 0.25, 1e-15);
}

TEST_F(SurfaceFile, OfDistancesIsRefusedWithLineTextAndRemedyWhereItIsMalformed)
{
    struct Case {
        std::string text;
        std::vector<std::string> parts;
    };
    const std::string head = "2 2 2\n0 0 0\n";
    const std::vector<Case> cases{
        {"", {"s.sdf: it ends before the numbers of samples, \"nx ny nz\"; get the whole file"}},
        {"2 2\n", {"s.sdf:1: \"2 2\": this line is to be the numbers of samples", "name a file of SDFGen's"}},
        {"2 2 2 2\n", {"this line is to be the numbers of samples"}},
        {"2 x 2\n", {"s.sdf:1: \"2 x 2\": \"x\" is no number of samples", "write a whole one, 2 or more"}},
        {"2 2.5 2\n", {"\"2.5\" is no number of samples"}},
        {"2 1 2\n", {"\"1\" is no number of samples along an axis"}},
        {"2 2 -2\n", {"\"-2\" is no number of samples"}},
        {"2 2 99999999999999999999\n", {"\"99999999999999999999\" is no number of samples"}},
        {"512 256 257\n", {"s.sdf:1:", "more than 33554432 samples; use a coarser grid"}},
        {"4294967296 4294967296 4\n", {"more than 33554432 samples"}},
        {"9223372036854775807 2 2\n", {"more than 33554432 samples"}},
        {"2 2 2\n", {"s.sdf: it ends before the place of the first sample, \"x y z\"; get the whole"}},
        {"2 2 2\n0 0\n", {"s.sdf:2: \"0 0\": this line is to be the place of the first sample"}},
        {"2 2 2\n0 nan 0\n", {"s.sdf:2:", "\"nan\" is no finite number"}},
        {head, {"s.sdf: it ends before the spacing of the samples; get the whole file"}},
        {head + "1 1\n", {"s.sdf:3: \"1 1\": this line is to be the spacing of the samples"}},
        {head + "0\n", {"s.sdf:3: \"0\": a spacing of 0 leaves no grid; use more than 0"}},
        {head + "-0.5\n", {"a spacing of -0.5 leaves no grid"}},
        {head + "inf\n", {"\"inf\" is no finite number"}},
        {"2 2 9\n0 0 1e30\n1e29\n", {"s.sdf:3:", "the grid reaches to 1.8e+30; use -1e30 to 1e30"}},
        {"2 2 2\n0 1e9 0\n1e-8\n",
         {"s.sdf:3:", "samples at 1e+09 are nearer to each other than a billionth"}},
        {"2 2 2\n0 -1e9 0\n0.9\n", {"s.sdf:3:", "are nearer to each other than a billionth of that"}},
        {head + "1\n1 1 1\n1 -1 1 1\n",
         {"s.sdf: 7 distances where a grid of 2 by 2 by 2 has 8; get the whole file, or correct"}},
        {head + "1\n", {"s.sdf: 0 distances where a grid of 2 by 2 by 2 has 8"}},
        {head + "1\n1 1 1\n1 -1 1 1 1 1\n",
         {"s.sdf:5: \"1 -1 1 1 1 1\": more than the 8 distances of a grid of 2 by 2 by 2; correct the "
          "first"}},
        {head + "1\n1 1 1 1 1 1 1 1,0\n", {"s.sdf:4:", "\"1,0\" is no finite number"}},
        {head + "1\n1 1 1 1 1 1 1 -nan\n", {"s.sdf:4:", "\"-nan\" is no finite number"}},
        {head + "1\n1 1 1 1 1 1 1 2e30\n", {"s.sdf:4:", "\"2e30\" is out of range"}},
        {grid_text("0.25"),
         {"s.sdf: its distances, of 0.25 to 1, have no surface between inside and outside; "
          "give some below 0 and some above"}},
        {grid_text("0"), {"its distances, of 0 to 1, have no surface"}},
        {grid_text("-1e-9"), {"its distances, of -1e-09 to 1, have no surface", "by more than rounding"}},
        {head + "1\n-1 -1 -1 -1 -2 -2 -2 -2\n", {"its distances, of -2 to -1, have no surface"}},
        {head + "1\n-1 -1 -1 -1 -2 -2 -2 0\n", {"its distances, of -2 to 0, have no surface"}},
    };
    for (const Case& each : cases)
        EXPECT_TRUE(refused(read_distance_grid(folder_.write("s.sdf", each.text)), each.parts)) << each.text;
    EXPECT_TRUE(
        refused(read_distance_grid(folder_.path() / "none.sdf"), {"none.sdf: there is no such file"}));
}

// A hundred samples along each axis that are inside and outside in turn.
TEST_F(SurfaceFile, OfDistancesIsRefusedWhereItsSurfaceHasMoreThanTheLimit)
{
    const std::string head = "100 100 100\n0 0 0\n1\n";
    std::string text;
    for (int i = 0; i < 500'000; ++i)
        text += i % 100 < 50 ? "1 -1 " : "-1 1 ";
    const auto read = [&] { return read_distance_grid(folder_.write("s.sdf", head + text)); };
    EXPECT_TRUE(refused(read(), {"line 4 is longer than 1048576 characters"}));
    std::replace(text.begin(), text.end(), ' ', '\n');
    EXPECT_TRUE(refused(read(), {"s.sdf: its surface has more than 1048576 vertices or 2097152 triangles; "
                                 "use a coarser grid"}));
}

// As any of the sound file's bytes is missing, doubled, or another one, it is a surface of finite places, or
// there is one reason why not.
TEST_F(SurfaceFile, OfDistancesWithAnyByteChangedIsASurfaceOrRefused)
{
    const std::string sound = grid_text();
    int taken = 0, refusals = 0;
    for (std::size_t i = 0; i < sound.size(); ++i) {
        for (const std::string by : {"", "-", "9", "e", ".", " ", "\n", "#", "\x01", "\xff"}) {
            std::string text = sound;
            text.replace(i, 1, by);
            const auto read = read_distance_grid(folder_.write("s.sdf", text));
            if (const auto* const found = std::get_if<Problems>(&read)) {
                ++refusals;
                ASSERT_TRUE(only_says(*found, {"s.sdf"})) << text;
                continue;
            }
            ++taken;
            ASSERT_FALSE(std::get<Mesh>(read).triangles.empty()) << text;
            for (const Vector3d& vertex : std::get<Mesh>(read).vertices)
                ASSERT_TRUE(vertex.allFinite()) << text;
        }
    }
    EXPECT_GT(taken, 50);
    EXPECT_GT(refusals, 300);
}

TEST_F(SurfaceFile, OfAColliderStartsFromTheScenesFolder)
{
    const std::string text = minimal_scene +
                             "[[collider]]\nname = \"bowl\"\nshape = \"mesh\"\nfile = \"s.obj\"\n"
                             "[[collider]]\nname = \"hill\"\nshape = \"heightfield\"\n"
                             "file = \"s.txt\"\n"
                             "[[collider]]\nname = \"pebble\"\nshape = \"distance_grid\"\n"
                             "file = \"s.sdf\"\n";
    mesh(square_ + "f 1 2 3\n");
    folder_.write("s.txt", "0 1\n2 3\n");
    folder_.write("s.sdf", grid_text());
    const auto loaded = load_scene(folder_.write("s.toml", text), {});
    ASSERT_TRUE(std::holds_alternative<Scene>(loaded)) << std::get<Problems>(loaded).front();
    const auto& colliders = std::get<Scene>(loaded).simulation.colliders;
    ASSERT_TRUE(colliders[0].mesh && colliders[1].mesh && colliders[2].mesh);
    EXPECT_EQ(colliders[0].mesh->triangles.size(), 1U);
    EXPECT_EQ(colliders[1].mesh->triangles.size(), 2U);
    EXPECT_EQ(colliders[2].mesh->triangles.size(), 24U);
}

TEST_F(SurfaceFile, OfAColliderIsRefusedWithTheKeysPlace)
{
    const auto found = [&](const std::string& keys) {
        return problems_of(minimal_scene + "[[collider]]\nname = \"bowl\"\nshape = \"mesh\"\n" + keys);
    };
    EXPECT_TRUE(only_says(found("file = \"none.obj\"\n"),
                          {"s.toml:8: collider.0.file = \"none.obj\":", "none.obj: there is no such file"}));
    EXPECT_TRUE(only_says(found(""), {"s.toml:5: collider.0.file = \"\" names none; use that"}));
    EXPECT_TRUE(only_says(found("file = 3\n"), {"s.toml:8: collider.0.file = 3 is no string"}));
}

TEST_F(SurfaceFile, IsRefusedUnreadForOtherShapes)
{
    EXPECT_TRUE(
        only_says(problems_of(minimal_scene + "[[collider]]\nname = \"floor\"\nfile = \"none.obj\"\n"),
                  {"s.toml:7: collider.0.file is no key of shape = \"plane\""}));
}

} // namespace
} // namespace slod::test
