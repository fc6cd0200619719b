// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Files of meshes as programs write them, and as they should not be.
#include "hooke/scene/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "hooke/core/shapes.h"
#include "hooke/scene/load_scene.h"
#include "hooke/scene/mesh_repair.h"
#include "scratch_folder.h"
#include "support/engines.h"
#include "support/made_meshes.h"
#include "support/openvdb.h"

namespace hooke::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint32_t kCubeFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}};
constexpr float kCubeCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

template <class T>
void append(std::string& bytes, T value, bool big = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

constexpr const char* kCamera = "element camera 2\nproperty float a\nproperty list uchar short view\n";
constexpr const char* kVertices = "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kFaces = "element face 6\nproperty list uchar int vertex_indices\nproperty uchar flag\n";

std::string ply_header(const std::string& format, bool camera = true) {
  return "ply\nformat " + format + " 1.0\ncomment by hand\nobj_info none\n" + (camera ? kCamera : "") + kVertices +
         kFaces + "end_header\n";
}

// The unit cube; something else comes first.
std::string text_ply() {
  std::string text = ply_header("ascii") + "1.5 2 7 8\n1.5 0\n";
  for (const auto& x : kCubeCorners)
    text += std::to_string(x[0]) + ' ' + std::to_string(x[1]) + ' ' + std::to_string(x[2]) + '\n';
  for (const auto& f : kCubeFaces) {
    text += '4';
    for (const std::uint32_t v : f) text += ' ' + std::to_string(v);
    text += " 1\n";
  }
  return text;
}

std::string binary_ply(bool big) {
  std::string text = ply_header(big ? "binary_big_endian" : "binary_little_endian");
  for (int camera = 0; camera < 2; ++camera) {
    append(text, 1.5F, big);
    append(text, static_cast<std::uint8_t>(camera), big);
    for (int k = 0; k < camera; ++k) append(text, std::int16_t{7}, big);
  }
  for (const auto& x : kCubeCorners) {
    for (const float c : x) append(text, c, big);
  }
  for (const auto& f : kCubeFaces) {
    append(text, std::uint8_t{4}, big);
    for (const std::uint32_t v : f) append(text, static_cast<std::int32_t>(v), big);
    append(text, std::uint8_t{1}, big);
  }
  return text;
}

// Calls visit(corners of a triangle) for each triangle of the unit cube.
template <class Visit>
void for_each_cube_triangle(const Visit& visit) {
  for (const auto& f : kCubeFaces) {
    for (const int k : {1, 2}) visit(std::array{f[0], f[k], f[k + 1]});
  }
}

std::string text_stl() {
  std::string text = "solid cube\n";
  for_each_cube_triangle([&](const std::array<std::uint32_t, 3>& t) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::uint32_t v : t) {
      text += "      vertex";
      for (const float c : kCubeCorners[v]) text += ' ' + std::to_string(c);
      text += '\n';
    }
    text += "    endloop\n  endfacet\n";
  });
  return text + "endsolid cube\n";
}

void append_facet(std::string& bytes, const std::array<std::uint32_t, 3>& t, float slip = 0) {
  for (int k = 0; k < 3; ++k) append(bytes, 0.0F);
  for (const std::uint32_t v : t) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, kCubeCorners[v][axis] + (axis == 1 ? slip : 0));
  }
  append(bytes, std::uint16_t{0});
}

std::string binary_stl(std::uint32_t facets = 12, const std::string& title = "solid but binary") {
  std::string bytes = title + std::string(80 - title.size(), ' ');
  append(bytes, facets);
  for_each_cube_triangle([&](const std::array<std::uint32_t, 3>& t) { append_facet(bytes, t); });
  return bytes;
}

class MeshFileTest : public testing::Test {
 protected:
  Expected<TriangleMesh> read(const std::string& name, std::string_view bytes) {
    warnings_.clear();
    return scene::read_mesh(folder_.write(name, bytes), &warnings_);
  }
  std::string refusal(const std::string& name, std::string_view bytes) {
    const auto mesh = read(name, bytes);
    return mesh ? "was read" : mesh.error().text();
  }
  void expect_cube(const std::string& name, std::string_view bytes) {
    const auto mesh = read(name, bytes);
    ASSERT_TRUE(mesh) << name << ": " << mesh.error().text();
    EXPECT_EQ(mesh->vertices.size(), 8U) << name;
    EXPECT_EQ(mesh->triangles.size(), 12U) << name;
    EXPECT_EQ(scene::count_open_edges(*mesh), 0U) << name;
    double volume = 0;
    for (const auto& t : mesh->triangles) {
      volume += dot(mesh->vertices[t[0]], cross(mesh->vertices[t[1]], mesh->vertices[t[2]])) / 6;
    }
    EXPECT_DOUBLE_EQ(volume, 1) << name;
  }
  // A scene with a ball above the mesh in `file`.
  Expected<scene::LoadedScene> load(const std::string& file, const std::string& extra = "",
                                    const scene::LoadOptions& options = {}) {
    return scene::parse_scene(R"({ "hooke": 1, "time": { "step": 0.001, "steps": 1500 }, "precision": "double",
        "gravity": [0, -9.81, 0], "domain": { "min": [-1, -1, -1], "max": [3, 3, 3], "walls": "open" },
        "materials": { "grain": { "radius": 0.25, "mass": 1, "stiffness": 10000, "damping": 60 } },
        "particles": [ { "material": "grain", "block": { "min": [0.5, 1.4, 0.5], "max": [0.5, 1.4, 0.5], "spacing": 1 } } ],
        "colliders": [ { "shape": { "mesh": { "file": ")" +
                                  file + "\"" + extra + " } } } ] }",
                              "scene.json", folder_.path(), options);
  }

  ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(MeshFileTest, ReadsPlyWithElementsBesides) {
  expect_cube("text.ply", text_ply());
  expect_cube("little.ply", binary_ply(false));
  expect_cube("big.ply", binary_ply(true));
  expect_cube("mark.ply", "\xEF\xBB\xBF" + text_ply());
}

TEST_F(MeshFileTest, ReadsDialectsOfStl) {
  std::string upper = text_stl();
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string dos;
  for (const char c : text_stl()) dos += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : {text_stl(), upper, dos, "\n \n" + text_stl(), "\xEF\xBB\xBF" + text_stl()}) {
    expect_cube("text.stl", text);
  }
  expect_cube("binary.stl", binary_stl());
  EXPECT_TRUE(warnings_.empty());
  expect_cube("trailing.stl", binary_stl() + "1234567");
  EXPECT_THAT(warnings_, ElementsAre("holds 7 bytes behind its 12 facets, which are passed over"));
}

TEST_F(MeshFileTest, ReadsObjInDouble) {
  std::string text = "\xEF\xBB\xBFmtllib ../secret.mtl\nf 1//1 4 \\\n3 2\n";  // faces may come first
  for (const auto& x : kCubeCorners) {
    text += "v 500000." + std::to_string(123456 + static_cast<int>(x[0])) + ' ' + std::to_string(x[1]) + ' ' +
            std::to_string(x[2]) + '\n';
  }
  for (int f = 1; f < 6; ++f) {
    text += 'f';
    for (const std::uint32_t v : kCubeFaces[f]) text += ' ' + std::to_string(static_cast<int>(v) - 8) + "/1";
    text += '\n';
  }
  const auto mesh = read("far.obj", text);
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_EQ(mesh->vertices.size(), 8U);
  EXPECT_EQ(mesh->vertices[0].x, 500000.123456);
  EXPECT_EQ(mesh->vertices[1].x, 500000.123457);
  EXPECT_EQ(scene::count_open_edges(*mesh), 0U);
}

TEST_F(MeshFileTest, CutsConcaveFacesIntoTrianglesInsideThem) {
  // An L: cut from its first corner, it would be larger than it is.
  const auto mesh = read("l.obj", "v 1 0 2\nv 0 0 2\nv 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nf 1 2 3 4 5 6\n");
  ASSERT_TRUE(mesh);
  double area = 0;
  for (const auto& t : mesh->triangles) {
    const Vec3d n = cross(mesh->vertices[t[1]] - mesh->vertices[t[0]], mesh->vertices[t[2]] - mesh->vertices[t[0]]);
    EXPECT_LT(n.y, 0) << "against y, as the corners go around";
    area -= 0.5 * n.y;
  }
  EXPECT_DOUBLE_EQ(area, 3);
  EXPECT_EQ(mesh->triangles.size(), 4U);
  std::string comb, face = "f";
  for (int i = 0; i < 1100; ++i) {
    comb += "v " + std::to_string(i) + " 0 " + (i % 2 == 0 ? "1" : "2") + "\n";
    face += ' ' + std::to_string(i + 1);
  }
  comb += "v 1100 0 0\nv -1 0 0\n";
  EXPECT_EQ(refusal("comb.obj", comb + face + " 1101 1102\n"),
            "holds a face of 1102 corners that is not convex; it may have 1024 at most");
}

TEST_F(MeshFileTest, RefusesBrokenPly) {
  const std::string good = text_ply();
  const std::string start = "can't be read as a mesh: ";
  EXPECT_EQ(refusal("p.ply", good.substr(0, 60)), start + "line 5 has \"\" elements; must be a whole number");
  EXPECT_EQ(refusal("p.ply", good.substr(0, 51)), start + "line 4 ends within the header");
  EXPECT_EQ(refusal("p.ply", good.substr(0, good.size() - 12)),
            start + "line 30 ends here, after 5 of 6 elements \"face\"");
  const auto with_face = [&](const std::string& face) {
    return refusal("p.ply", good.substr(0, good.find("4 0 3 2 1")) + face + '\n');
  };
  EXPECT_EQ(with_face("4 0 3 2 99 1"), start + "line 26 names the vertex 99; the 8 vertices have the numbers from 0");
  EXPECT_EQ(with_face("3 0 1 -1 1"), start + "line 26 names the vertex -1; the 8 vertices have the numbers from 0");
  EXPECT_EQ(with_face("3 0 1 x 1"), start + "line 26 names the vertex x; the 8 vertices have the numbers from 0");
  EXPECT_EQ(with_face("4 0 1 2"), start + "line 26 ends before vertex_indices");
  EXPECT_EQ(with_face("3 0 1 2 1 1"), start + "line 26 has more values than the header has properties");
  EXPECT_EQ(with_face("-3 0 1 2 1"), start + "line 26 has a list vertex_indices of length -3; must be a whole number");
  EXPECT_EQ(with_face("2 0 1 1\n2 0 1 1\n0 1\n0 1\n0 1\n0 1"), "holds no faces");
  EXPECT_EQ(refusal("p.ply", ply_header("ascii", false) + "0 0 inf\n"),
            start + "line 13 has z = inf; must be a finite number");
  EXPECT_EQ(refusal("p.ply", std::string("ply\nformat ascii 1.0\n") + kVertices + "end_header\n"),
            start + "line 7 ends a header without the element \"face\"");
  EXPECT_EQ(refusal("p.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 0\nend_header\n"),
            start + "line 6 ends a header whose element \"vertex\" has no property \"y\"");

  const std::string binary = binary_ply(false);
  const std::size_t faces = binary.size() - 6 * 18;
  EXPECT_EQ(refusal("p.ply", binary.substr(0, faces + 5)),
            start + "byte " + std::to_string(faces) + " ends within this entry");
  std::string other = binary;
  other[faces] = '\x7f';  // a face of 127 corners: it takes other faces for its own
  EXPECT_THAT(refusal("p.ply", other), HasSubstr("names the vertex"));
}

TEST_F(MeshFileTest, BelievesNoCountOfPly) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    std::string header = ply_header(format, false);
    header.replace(header.find("vertex 8"), 8, "vertex 4000000000");
    EXPECT_THAT(refusal("p.ply", header + "0 0 0\n1 0 0\n"), HasSubstr("ends"));
    header.replace(header.find("vertex 4000000000"), 17, "vertex 40000000000");
    EXPECT_EQ(refusal("p.ply", header), "states 40000000000 vertices; at most 4294967295 are possible");
  }
}

TEST_F(MeshFileTest, RefusesBrokenStl) {
  const std::string start = "can't be read as a mesh: ";
  const auto no_stl = [](int expected, int facets, int size) {
    return "is no STL file: it does not begin with \"solid\", as text does, and binary data would be " +
           std::to_string(expected) + " bytes for " + std::to_string(facets) + " facets; it has " +
           std::to_string(size);
  };
  EXPECT_EQ(refusal("p.stl", "this is no mesh\n"), no_stl(84, 0, 16));
  EXPECT_EQ(refusal("p.stl", binary_stl(13, "title")), no_stl(734, 13, 684));
  const std::string text = text_stl();
  EXPECT_EQ(refusal("p.stl", text.substr(0, text.find("endsolid"))),
            start + "line 85 ends a file that goes on, up to \"endsolid\"");
  EXPECT_EQ(refusal("p.stl", "solid\nfacet\nvertex 1 2\n"), start + "line 3 must be \"vertex\" and three numbers");
  EXPECT_EQ(refusal("p.stl", "solid\nvertex 1 2 3\n"),
            start + "line 2 starts with \"vertex\", which is out of place there");
  EXPECT_EQ(refusal("p.stl", "solid\nfacet\nendfacet\n"), start + "line 3 ends a facet of 0 corners; must be three");
  EXPECT_EQ(refusal("p.stl", "solid\nfrog\n"),
            start + "line 2 starts with \"frog\", which is no keyword of an STL file");
  EXPECT_EQ(refusal("p.stl", "solid\nendsolid\n"), "holds no faces");
  std::string infinite = binary_stl();
  infinite.replace(84 + 12, 4, std::string("\x00\x00\x80\x7f", 4));
  EXPECT_EQ(refusal("p.stl", infinite), start + "byte 84 is a facet with a corner at no finite place");
}

TEST_F(MeshFileTest, RefusesBrokenObj) {
  const std::string start = "can't be read as a mesh: ", known = "\"; the vertices have the numbers 1 to 3";
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal("p.obj", v + "f 1 2 4\n"), start + "line 4 names the vertex \"4" + known);
  EXPECT_EQ(refusal("p.obj", v + "f 1 2 -4\n"), start + "line 4 names the vertex \"-4" + known);
  EXPECT_EQ(refusal("p.obj", v + "f 1 2 0\n"), start + "line 4 names the vertex \"0" + known);
  EXPECT_EQ(refusal("p.obj", v + "f 1 2 99999999999\n"), start + "line 4 names the vertex \"99999999999" + known);
  EXPECT_EQ(refusal("p.obj", v + "f 1 2\n"), start + "line 4 is a face of less than three corners");
  EXPECT_EQ(refusal("p.obj", "v 0 nan 0\n"), start + "line 1 must be \"v\" and three numbers");
  EXPECT_EQ(refusal("p.obj", v), "holds no faces");
  EXPECT_EQ(refusal("p.obj", v + "f 1 1 2\n"), "holds no triangle with three corners apart");
}

// Every beginning of a file, and the file with each byte changed, is read or refused; what is read is sound.
TEST_F(MeshFileTest, StandsDamage) {
  const auto check = [&](const char* name, std::string_view bytes) {
    const auto mesh = read(name, bytes);
    if (!mesh) return;
    for (const auto& t : mesh->triangles) {
      for (const std::uint32_t v : t) ASSERT_LT(v, mesh->vertices.size());
    }
    for (const Vec3d& x : mesh->vertices) ASSERT_TRUE(std::isfinite(dot(x, x)));
  };
  const std::pair<const char*, std::string> files[] = {{"a.ply", text_ply()},
                                                       {"b.ply", binary_ply(false)},
                                                       {"a.stl", text_stl().substr(0, 500)},
                                                       {"b.stl", binary_stl()}};
  for (const auto& [name, bytes] : files) {
    for (std::size_t length = 0; length < bytes.size(); ++length)
      check(name, std::string_view(bytes).substr(0, length));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const int flipped : {0x01, 0x80, 0xff}) {
        std::string other = bytes;
        other[i] = static_cast<char>(other[i] ^ flipped);
        check(name, other);
      }
    }
  }
}

TEST_F(MeshFileTest, CountsDoubledTrianglesOnce) {
  std::string bytes = binary_stl(13);
  append_facet(bytes, {2, 0, 3});  // the first facet, from another corner on
  expect_cube("twice.stl", bytes);
  EXPECT_THAT(warnings_, ElementsAre("holds 1 triangle more than once; each counts once"));
}

TEST_F(MeshFileTest, WeldsSlits) {
  std::string bytes = binary_stl();
  bytes.resize(bytes.size() - 50);
  append_facet(bytes, {1, 6, 5}, 1e-6F);  // the last facet, aside
  const auto mesh = read("slit.stl", bytes);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices.size(), 8U);
  EXPECT_EQ(scene::count_open_edges(*mesh), 0U);
  EXPECT_THAT(warnings_,
              ElementsAre("has open edges with 3 vertices within 1.7e-05 of others, in the file's unit; they "
                          "are welded"));
  bytes.resize(bytes.size() - 50);
  append_facet(bytes, {1, 6, 5}, 1e-3F);
  const auto open = read("gap.stl", bytes);
  ASSERT_TRUE(open);
  EXPECT_EQ(scene::count_open_edges(*open), 6U);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(MeshFileTest, LeavesDetailsOfClosedSurfacesAlone) {
  const TriangleMesh ball = ball_mesh(0, 1, 16);
  std::string text = obj_text(box_mesh({0, 0, 0}, {1000, 1000, 1000}));
  for (const Vec3d& x : ball.vertices) {
    text += "v " + std::to_string(1e-3 * x.x) + ' ' + std::to_string(1e-3 * x.y - 1) + ' ' +
            std::to_string(1e-3 * x.z) + '\n';
  }
  for (const auto& t : ball.triangles) {
    text += "f " + std::to_string(t[0] + 9) + ' ' + std::to_string(t[1] + 9) + ' ' + std::to_string(t[2] + 9) + '\n';
  }
  const auto mesh = read("fine.obj", text);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices.size(), 8 + ball.vertices.size());
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(MeshFileTest, TellsWhichEdgesAreOpen) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][2], mesh.triangles[0][1]});  // from the other side
  scene::OpenEdges open = scene::open_edges(mesh);
  EXPECT_EQ(open.single, 0U);
  EXPECT_EQ(open.odd, 3U);
  mesh.triangles.resize(11);
  open = scene::open_edges(mesh);
  EXPECT_EQ(open.single, 3U);
  EXPECT_EQ(open.odd, 0U);
}

TEST_F(MeshFileTest, SaysInASceneWhatIsRemarkable) {
  HOOKE_NEEDS_OPENVDB();
  std::string bytes = binary_stl(13);
  append_facet(bytes, {0, 3, 2});
  folder_.write("twice.stl", bytes);
  const auto twice = load("twice.stl");
  ASSERT_TRUE(twice) << twice.error().text();
  ASSERT_EQ(twice->warnings.size(), 1U);
  EXPECT_EQ(twice->warnings[0].where, "colliders[0].shape.mesh.file");
  EXPECT_EQ(twice->warnings[0].message, "is \"twice.stl\", which holds 1 triangle more than once; each counts once");
  bytes = binary_stl(13);
  append_facet(bytes, {0, 2, 3});
  folder_.write("turned.stl", bytes);
  const auto turned = load("turned.stl");
  ASSERT_TRUE(turned);
  ASSERT_EQ(turned->warnings.size(), 1U);
  EXPECT_EQ(turned->warnings[0].message,
            "3 edges have three triangles or another odd number: the mesh is open, a shell that is touched from both "
            "sides");
  folder_.write("bad.ply", text_ply().substr(0, 51));
  EXPECT_EQ(
      load("bad.ply").error().text(),
      "colliders[0].shape.mesh.file: is \"bad.ply\", which can't be read as a mesh: line 4 ends within the header "
      "(line 5)");
}

TEST_F(MeshFileTest, RefusesAtOnceWhatIsTooLarge) {
  HOOKE_NEEDS_OPENVDB();
  folder_.write("sliver.obj", "v 0 0 0\nv 1e7 0 0\nv 5e6 0 0\nf 1 2 3\n");
  EXPECT_THAT(load("sliver.obj").error().text(),
              HasSubstr("colliders[0].shape.mesh: spans too many samples of its distance, 0.0833 m apart"));
  folder_.write("long.obj", "v 0 0 0\nv 2e5 0 0\nv 1e5 0 0\nf 1 2 3\n");
  EXPECT_THAT(load("long.obj").error().text(),
              HasSubstr("or more; at most 2.5e+08 are possible, so give a larger \"voxel\" or a smaller \"scale\""));
  folder_.write("cube.stl", binary_stl());
  scene::LoadOptions options;
  options.memory_limit = 1000;
  options.overrides = {"particles=[]"};
  EXPECT_THAT(load("cube.stl", "", options).error().text(), HasSubstr("1000 bytes are available"));
  EXPECT_GT(load("cube.stl")->fields.most, 4.0 * 12 * 729);
}

// Whatever wrote the file, a ball comes to rest on the unit cube, m g / k deep.
TEST_F(MeshFileTest, CarriesABall) {
  HOOKE_NEEDS_OPENVDB();
  std::string slit = binary_stl();
  slit.resize(slit.size() - 50);
  append_facet(slit, {1, 6, 5}, 1e-6F);
  folder_.write("a.ply", text_ply());
  folder_.write("b.ply", binary_ply(false));
  folder_.write("a.stl", "\n" + text_stl());
  folder_.write("b.stl", slit);
  for (const char* name : {"a.ply", "b.ply", "a.stl", "b.stl"}) {
    auto loaded = load(name);
    ASSERT_TRUE(loaded) << loaded.error().text();
    Simulation simulation = simulate(loaded->scene, loaded->particles, kReference);
    ASSERT_TRUE(advance(simulation, 1500));
    EXPECT_NEAR(simulation.positions()[0].y, 1.249019, 1e-6) << name;
  }
}

// A plane whose numbers are 5e5 m from 0, moved back: overlaps are as around 0.
TEST_F(MeshFileTest, IsExactFarFromTheOrigin) {
  HOOKE_NEEDS_OPENVDB();
  std::string far;
  for (int i = 0; i < 4; ++i) {
    far += "v " + std::to_string(i % 2 == 0 ? 499998.123456 : 500002.123456) + " 120.100000 " +
           std::to_string(i / 2 == 0 ? 499998.654321 : 500002.654321) + '\n';
  }
  folder_.write("far.obj", far + "f 1 2 4 3\n");
  const auto loaded = load("far.obj", R"(, "translate": [-500000.123456, -120.1, -500000.654321])");
  ASSERT_TRUE(loaded) << loaded.error().text();
  const Shape& plane = loaded->scene.colliders.at(0).shape;
  for (const double height : {0.09, 0.15, 0.2}) EXPECT_NEAR(distance(plane, {0.31, height, 0.77}), height, 1e-6);
}

}  // namespace
}  // namespace hooke::test
