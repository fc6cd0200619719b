// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/file_scanner.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace hooke {
namespace {

TEST(FileScanner, ReadsLinesOfEveryForm) {
  const ScratchFolder folder;
  scene::FileScanner in(folder.write("f", "one\r\n\ntwo\nthree"));
  EXPECT_EQ(in.remaining(), 15U);
  EXPECT_EQ(in.line(), "one");
  EXPECT_EQ(in.line(), "");
  EXPECT_EQ(in.line_number(), 2U);
  const auto here = in.place();
  EXPECT_EQ(in.line(), "two");
  EXPECT_EQ(in.line(), "three");
  EXPECT_EQ(in.line(), std::nullopt);
  EXPECT_EQ(in.line_number(), 4U);
  EXPECT_EQ(in.remaining(), 0U);
  in.go_back(here);
  EXPECT_EQ(in.line(), "two");
  EXPECT_EQ(in.line_number(), 3U);
  EXPECT_FALSE(in.skip_lines(2));
}

TEST(FileScanner, ReadsLinesThatEndWithCr) {
  const ScratchFolder folder;
  scene::FileScanner in(folder.write("f", "one\r\rtwo\rthree\r"));
  for (const char* line : {"one", "", "two", "three"}) EXPECT_EQ(in.line(), line);
  EXPECT_EQ(in.line(), std::nullopt);
  EXPECT_EQ(in.line_number(), 4U);
  // Binary data that begins with the byte of an LF.
  scene::FileScanner binary(folder.write("g", "ply\rend_header\r\n123"));
  EXPECT_EQ(binary.line(), "ply");
  EXPECT_EQ(binary.line(), "end_header");
  EXPECT_EQ(std::string_view(binary.bytes(4), 4), "\n123");
  // Ends of all kinds, and one at the end of a piece.
  const std::string longest(scene::FileScanner::kLongestLine, 'x');
  scene::FileScanner mixed(folder.write("h", "a\r\nb\rc\n" + longest + "\r\nd"));
  for (const std::string& line : {std::string("a"), std::string("b"), std::string("c"), longest, std::string("d")}) {
    EXPECT_EQ(mixed.line(), line);
  }
}

TEST(FileScanner, PassesAByteOrderMark) {
  const ScratchFolder folder;
  scene::FileScanner in(folder.write("f",
                                     "\xef\xbb\xbf"
                                     "one\ntwo"));
  const auto start = in.place();
  EXPECT_EQ(in.line(), "one");
  in.go_back(start);
  EXPECT_EQ(in.line(), "one");
  EXPECT_EQ(scene::FileScanner(folder.write("g", "\xef\xbb\xbf")).line(), std::nullopt);
  EXPECT_THROW(scene::FileScanner(folder.write("h", "\xff\xfex")), scene::FileFault);
}

// Lines and bytes that cross the pieces in which a file is read stay whole.
TEST(FileScanner, JoinsItsPieces) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 300000; ++i) text += std::to_string(i) + "\n";
  scene::FileScanner in(folder.write("f", text));
  for (int i = 0; i < 300000; ++i) ASSERT_EQ(in.line(), std::to_string(i));
  EXPECT_EQ(in.offset(), text.size());
  in.go_back({});
  for (std::size_t at = 0; at + 7 <= text.size(); at += 7) {
    const char* bytes = in.bytes(7);
    ASSERT_NE(bytes, nullptr);
    ASSERT_EQ(std::string_view(bytes, 7), std::string_view(text).substr(at, 7));
  }
  in.go_back({});
  EXPECT_TRUE(in.skip_bytes(text.size() - 2));
  EXPECT_EQ(in.bytes(3), nullptr);
  EXPECT_EQ(std::string_view(in.bytes(2), 2), "9\n");
  EXPECT_FALSE(in.skip_bytes(1));
}

TEST(FileScanner, RefusesALineWithoutEnd) {
  const ScratchFolder folder;
  const std::string longest(scene::FileScanner::kLongestLine, 'x');
  scene::FileScanner good(folder.write("good", "a\n" + longest + "\nb"));
  EXPECT_EQ(good.line(), "a");
  EXPECT_EQ(good.line(), longest);
  EXPECT_EQ(good.line(), "b");
  scene::FileScanner bad(folder.write("bad", "a\n" + longest + "x\n"));
  EXPECT_EQ(bad.line(), "a");
  try {
    bad.line();
    FAIL() << "took it";
  } catch (const scene::FileFault& fault) {
    EXPECT_EQ(fault.place(), 2U);
    EXPECT_STREQ(fault.what(), "is longer than 1048576 bytes: no line of particles");
  }
}

}  // namespace
}  // namespace hooke
