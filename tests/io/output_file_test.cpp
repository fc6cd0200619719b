// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <future>

#include "hooke/io/export.h"
#include "hooke/io/failure.h"
#include "hooke/io/report.h"
#include "samples.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
 protected:
  samples::TemporaryFolder folder;
  const std::string text = std::string(3'000'000, 'x');  // longer than any buffer
};

TEST_F(Outputs, ReplaceAFileWhenTheyAreComplete) {
  samples::write_file(folder / "f", "old");
  {
    io::OutputFile out(folder / "f");
    out.write(text);
    EXPECT_EQ(samples::read_file(folder / "f"), "old");
  }
  EXPECT_EQ(samples::read_file(folder / "f"), "old");
  ASSERT_TRUE(io::write_text_file(folder / "f", text));
  EXPECT_EQ(samples::read_file(folder / "f"), text);
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"f"});
}

TEST_F(Outputs, WriteTheTargetOfASymbolicLink) {
  fs::create_directories(folder / "a/b");
  samples::write_file(folder / "a/b/target", "old");
  fs::create_symlink("b/target", folder / "a/second");
  fs::create_symlink(folder / "a/second", folder / "first");
  fs::create_symlink("a/b/new", folder / "dangling");
  for (const char* name : {"first", "dangling"}) {
    ASSERT_TRUE(io::write_text_file(folder / name, text));
    EXPECT_TRUE(fs::is_symlink(folder / name));
    EXPECT_EQ(samples::read_file(folder / name), text);
  }
  EXPECT_TRUE(fs::is_symlink(folder / "a/second"));
  EXPECT_EQ(samples::files_in(folder / "a/b"), (std::vector<std::string>{"new", "target"}));

  fs::create_symlink("loop", folder / "loop");
  const auto looping = io::write_text_file(folder / "loop", text);
  ASSERT_FALSE(looping);
  EXPECT_NE(looping.error().text().find("loop: can't be written"), std::string::npos);
}

TEST_F(Outputs, GoThroughAPipe) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  auto reader = std::async(std::launch::async, [&] { return samples::read_file(pipe); });
  ASSERT_TRUE(io::write_text_file(pipe, text));
  EXPECT_TRUE(reader.get() == text);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"pipe"});
}

TEST_F(Outputs, AReaderThatLeavesIsAnErrorAndNoSignal) {
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  auto reader =
      std::async(std::launch::async, [&] { return io::Descriptor(::open(pipe.c_str(), O_RDONLY)).get() >= 0; });
  const auto written = io::write_text_file(pipe, text);
  EXPECT_TRUE(reader.get());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().text(), pipe.string() + ": can't be written: Broken pipe");
}

TEST_F(Outputs, GoToADeviceThatStays) {
  ASSERT_TRUE(io::write_text_file("/dev/null", text));
  const auto full = io::write_text_file("/dev/full", text);
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().text(), "/dev/full: can't be written: No space left on device");
  for (const char* device : {"/dev/null", "/dev/full"}) EXPECT_TRUE(fs::is_character_file(device)) << device;
  const auto checkpoint = io::write_checkpoint("/dev/null", samples::state(1, 2), samples::run_info());
  ASSERT_FALSE(checkpoint);
  EXPECT_NE(checkpoint.error().text().find("only a file"), std::string::npos);
}

// As the shell's > and >> leave it: other output of the process stands before and after.
TEST_F(Outputs, GoOnWhereAnOpenFileStands) {
  const io::Descriptor log(::open((folder / "log").c_str(), O_WRONLY | O_CREAT, 0600));
  const std::string name = "/dev/fd/" + std::to_string(log.get());
  ASSERT_EQ(::write(log.get(), "before\n", 7), 7);
  ASSERT_TRUE(io::write_text_file(name, "report\n"));
  ASSERT_EQ(::write(log.get(), "after\n", 6), 6);
  EXPECT_EQ(samples::read_file(folder / "log"), "before\nreport\nafter\n");
}

// An export of several files is there as a whole or not at all.
TEST_F(Outputs, AFailedExportLeavesNoFile) {
  const io::RunReader run =
      samples::write_run(folder / "run", samples::run_info(),
                         {samples::snapshot(0, 5), samples::snapshot(8, 5), samples::snapshot(16, 5)});
  for (const char* name : {"x.ply", "x.vtp", "x.pvd", "x.data"}) {
    const fs::path out = folder / "out";
    fs::create_directories(
        out / (fs::path(name).stem().string() + "_0002" +
               (fs::path(name).extension() == ".pvd" ? ".vtp" : fs::path(name).extension().string()) + ".unfinished"));
    EXPECT_FALSE(io::export_run(run, std::vector<std::size_t>{0, 1, 2}, out / name)) << name;
    EXPECT_EQ(samples::files_in(out).size(), 1U) << name;
    fs::remove_all(out);
  }
}

}  // namespace
}  // namespace hooke
