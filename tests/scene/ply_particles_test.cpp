// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cstring>

#include "file_reading.h"

namespace hooke {
namespace {

class PlyParticlesTest : public FileReading {};

template <class T>
void append(std::string& bytes, T value, bool big) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

constexpr const char* kHeader =
    "comment made by hand\n"
    "comment material 0 salt%20water\n"
    "comment material 1 water\n"
    "element camera 2\n"
    "property list uchar short view\n"
    "property double zoom\n"
    "element vertex 2\n"
    "property double x\n"
    "property float y\n"
    "property float z\n"
    "property list uchar int neighbours\n"
    "property float vx\n"
    "property float vy\n"
    "property float vz\n"
    "property uint id\n"
    "property float temperature\n"
    "property uchar material\n"
    "property uchar red\n"
    "element face 1\n"
    "property list uchar int vertex_indices\n"
    "end_header\n";

std::string binary(bool big) {
  std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kHeader;
  for (int camera = 0; camera < 2; ++camera) {
    append(text, std::uint8_t{3}, big);
    for (const int v : {1, 2, 3}) append(text, static_cast<std::int16_t>(v), big);
    append(text, 35.0, big);
  }
  for (int i = 0; i < 2; ++i) {
    const auto f = static_cast<float>(i);
    append(text, 0.1 + i, big);
    append(text, 2 + f, big);
    append(text, -3 - f, big);
    append(text, static_cast<std::uint8_t>(i), big);
    for (int k = 0; k < i; ++k) append(text, std::int32_t{-5}, big);
    for (const float v : {4 + f, 5 + f, 6 + f}) append(text, v, big);
    append(text, std::uint32_t{4000000000U} + static_cast<std::uint32_t>(i), big);
    append(text, 20.0F, big);
    append(text, static_cast<std::uint8_t>(i), big);
    append(text, std::uint8_t{255}, big);
  }
  append(text, std::uint8_t{1}, big);
  append(text, std::int32_t{0}, big);
  return text;
}

void expect_both(const scene::FileParticles& p) {
  EXPECT_EQ(p.id, (std::vector<std::uint64_t>{4000000000U, 4000000001U}));
  EXPECT_EQ(p.material, (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(p.position, (std::vector<Vec3d>{{0.1, 2, -3}, {1.1, 3, -4}}));
  EXPECT_EQ(p.velocity, (std::vector<Vec3d>{{4, 5, 6}, {5, 6, 7}}));
}

TEST_F(PlyParticlesTest, ReadsBothOrdersOfBytes) {
  for (const bool big : {false, true}) {
    const auto p = read("p.ply", binary(big));
    EXPECT_EQ(complaints(), "");
    expect_both(p);
    EXPECT_TRUE(p.binary);
    EXPECT_EQ(
        warnings(),
        "p.ply: columns that Hooke does not read are ignored: \"neighbours\", \"temperature\", \"element camera\", "
        "\"element face\"");
    // The first vertex is behind the header and two cameras of 15 bytes.
    EXPECT_EQ(p.place.at(0), binary(big).find("end_header\n") + 11 + 30);
    EXPECT_EQ(p.place.at(1) - p.place.at(0), 8 + 8 + 1 + 12 + 4 + 4 + 2U);
  }
}

TEST_F(PlyParticlesTest, ReadsText) {
  const auto p = read("p.ply", std::string("ply\r\nformat ascii 1.0\n") + kHeader +
                                   "3 1 2 3 35\n0 35\n"
                                   "0.1 2 -3 0 4 5 6 4000000000 20 0 255\n"
                                   "1.1 3 -4 1 -5 5 6 7 4000000001 20 1 255\r\n"
                                   "1 0\n");
  EXPECT_EQ(complaints(), "");
  expect_both(p);
  EXPECT_EQ(p.place, (std::vector<std::uint64_t>{26, 27}));
}

TEST_F(PlyParticlesTest, ReadsVelocityAsAList) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property list uchar float velocity\nproperty int material\nend_header\n";
  EXPECT_EQ(read("p.ply", header + "1 2 3 3 4 5 6 1\n").velocity, (std::vector<Vec3d>{{4, 5, 6}}));
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(refusal("p.ply", header + "1 2 3 2 4 5 1\n"), "p.ply:10: has a list velocity of length 2; must be 3");
}

TEST_F(PlyParticlesTest, KeepsIdsOf64Bits) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property uint id\nproperty uint id_high\nproperty int material\nend_header\n";
  EXPECT_EQ(read("p.ply", header + "1 2 3 5 2147483646 0\n").id,
            (std::vector<std::uint64_t>{(std::uint64_t{2147483646} << 32U) + 5}));
  EXPECT_EQ(complaints(), "");
  EXPECT_EQ(refusal("p.ply", header + "1 2 3 5 2147483647 0\n"),
            "p.ply:11: id_high is 2147483647; must be a whole number up to 2147483646");
}

TEST_F(PlyParticlesTest, RefusesWhatIsNoNumber) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
      "property double z\nproperty double id\nproperty char material\nend_header\n";
  const std::string place = std::to_string(text.size());
  for (const double v : {1.0, HUGE_VAL, -HUGE_VAL, 1.5}) append(text, v, false);
  append(text, std::int8_t{-1}, false);
  EXPECT_EQ(refusal("p.ply", text), "p.ply, byte " + place + ": y is inf; must be a finite number\np.ply, byte " +
                                        place + ": z is -inf; must be a finite number\np.ply, byte " + place +
                                        ": id is 1.5; must be a whole number from 0 to 9007199254740992\np.ply, byte " +
                                        place + ": material is -1; must be a whole number from 0 to 9007199254740992");
}

TEST_F(PlyParticlesTest, SaysWhatIsWrongWithAHeader) {
  const std::string good = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(refusal("p.ply", ""), "p.ply:1: is not \"ply\": it is no PLY file");
  EXPECT_EQ(refusal("p.ply", "plyx\n"), "p.ply:1: is not \"ply\": it is no PLY file");
  EXPECT_EQ(refusal("p.ply", "ply\nelement vertex 1\nend_header\n"),
            "p.ply:3: ends a header that has no line \"format\"");
  EXPECT_EQ(refusal("p.ply", "ply\nformat binary 1.0\n"),
            "p.ply:2: has format \"binary\"; must be ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(refusal("p.ply", "ply\nformat ascii 2.0\n"), "p.ply:2: has version \"2.0\"; must be 1.0");
  EXPECT_EQ(refusal("p.ply", good + "elemnt vertex 1\n"),
            "p.ply:3: starts with \"elemnt\", which is no keyword of a PLY header");
  EXPECT_EQ(refusal("p.ply", good + "element vertex -1\n"), "p.ply:3: has \"-1\" elements; must be a whole number");
  EXPECT_EQ(refusal("p.ply", good + "property float x\n"), "p.ply:3: is a property of no element");
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\nproperty long x\n"),
            "p.ply:4: has type \"long\"; must be char, uchar, short, ushort, int, uint, float or double");
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\nproperty list float int x\n"),
            "p.ply:4: has a list whose length is no whole number");
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\nproperty float\n"), "p.ply:4: is a property without a name");
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\n"), "p.ply:3: ends within the header");
  EXPECT_EQ(refusal("p.ply", good + "element face 1\nend_header\n"),
            "p.ply:4: ends a header without the element \"vertex\"");
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\n" + xyz + "end_header\n1 2 3\n"),
            "p.ply:7: has no column \"material\", and the scene's entry names no material either");
  rules_.material = std::uint16_t{0};
  EXPECT_EQ(refusal("p.ply", good + "element vertex 1\nproperty float x\nproperty float x\nend_header\n1 2\n"),
            "p.ply:6: has two columns \"x\"\n"
            "p.ply:6: has no columns \"y\", \"z\"; the header must name x, y and z, and names \"x\", \"x\"");
  EXPECT_EQ(read("p.ply", "\xef\xbb\xbf" + good + "element vertex 1\n" + xyz + "end_header\n1 2 3\n").position,
            (std::vector<Vec3d>{{1, 2, 3}}))
      << "after a byte order mark";
  EXPECT_EQ(refusal("p.ply", good + "element vertex 2\n" + xyz + "end_header\n1 2\n1 2 3 4\n"),
            "p.ply:8: ends before z\np.ply:9: has more values than the header has properties");
}

TEST_F(PlyParticlesTest, BelievesNoCount) {
  rules_.material = std::uint16_t{0};
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string head = std::string("ply\nformat ") + format + " 1.0\n";
    const std::string vertex =
        "element vertex 1000000000000000000\nproperty float x\nproperty float y\nproperty float z\n";
    const auto file = folder_.write("p.ply", head + vertex + "end_header\n");
    EXPECT_LE(scene::count_particles(file, rules_), 1U);
    EXPECT_NE(
        refusal("p.ply", head + vertex + "end_header\n").find("ends here, after 0 of 1000000000000000000 particles"),
        std::string::npos);
    const std::string huge = "element face 18446744073709551615\nproperty list uint float a\n";
    EXPECT_EQ(refusal("p.ply", head + huge + vertex + "end_header\n1 2 3\n"),
              "p.ply: ends within the elements \"face\"");
  }
}

TEST_F(PlyParticlesTest, StandsDamage) {
  damage("p.ply", binary(false), 2);
  damage("p.ply",
         std::string("ply\nformat ascii 1.0\n") + kHeader +
             "3 1 2 3 35\n0 35\n0.1 2 -3 0 4 5 6 4000000000 20 0 255\n"
             "1.1 3 -4 1 -5 5 6 7 4000000001 20 1 255\n1 0\n",
         2);
}

}  // namespace
}  // namespace hooke
