// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// A build without OpenVDB: it refuses exports that need OpenVDB, by name, and writes no file for them.
#include <gtest/gtest.h>

#include "hooke/io/export.h"
#include "hooke/volumes/openvdb_support.h"
#include "samples.h"

namespace hooke {
namespace {

TEST(WithoutOpenVdb, ExportsNameTheFileThatCantBe) {
  if (volumes::has_openvdb()) GTEST_SKIP() << "OpenVDB is in this build";
  const samples::TemporaryFolder folder;
  const io::RunReader run = samples::write_run(folder / "run", samples::run_info(), {samples::snapshot(8, 10)});
  const std::pair<io::ExportContent, const char*> needed[] = {{io::ExportContent::particles, "f.vdb"},
                                                              {io::ExportContent::volume, "f.vdb"},
                                                              {io::ExportContent::surface, "f.obj"},
                                                              {io::ExportContent::surface, "f.ply"}};
  for (const auto& [content, name] : needed) {
    io::ExportOptions options;
    options.content = content;
    const auto files = io::export_run(run, std::vector<std::size_t>{0}, folder / name, options);
    ASSERT_FALSE(files) << name;
    EXPECT_EQ(files.error().kind, Error::Kind::bad_input);
    EXPECT_EQ(files.error().text(),
              (folder / name).string() + ": needs OpenVDB, which is not in this build (HOOKE_WITH_OPENVDB)");
  }
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"run"});
}

}  // namespace
}  // namespace hooke
