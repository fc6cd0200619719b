// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include "hooke/io/journaled_file.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "samples.h"

namespace hooke {
namespace {

using samples::TemporaryFolder;
using Mode = JournaledFile::Mode;

class Journaled : public testing::Test {
 protected:
  Journaled() { reopen(Mode::create); }

  void reopen(Mode mode) {
    file.reset();
    file = std::make_unique<JournaledFile>(path, mode);
  }
  void write(std::uint64_t at, const std::string& text) {
    file->write(at, text.data(), text.size());
    file->set_end(std::max(file->end(), at + text.size()));
  }
  static std::string read(JournaledFile& from, std::uint64_t at, std::size_t size) {
    std::string text(size, '?');
    EXPECT_EQ(from.read(at, text.data(), size), 0);
    return text;
  }
  std::string committed(std::uint64_t at, std::size_t size) {
    JournaledFile reader(path, Mode::read);
    return read(reader, at, size);
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder / "file";
  std::filesystem::path journal = folder / "file.journal";
  std::unique_ptr<JournaledFile> file;
};

TEST_F(Journaled, ChangesShowWhenTheyAreCommitted) {
  write(0, std::string(10000, 'a'));
  file->commit();
  write(4090, "0123456789");  // over a border of pages
  write(9998, "xyz");         // over the committed end
  EXPECT_EQ(read(*file, 4089, 12), "a0123456789a");
  EXPECT_EQ(read(*file, 9997, 5), std::string("axyz\0", 5));
  EXPECT_EQ(committed(4089, 12), std::string(12, 'a'));
  file->commit();
  EXPECT_EQ(committed(4089, 12), "a0123456789a");
  EXPECT_EQ(committed(9997, 4), "axyz");
  EXPECT_EQ(samples::files_in(folder.path()), std::vector<std::string>{"file"});
}

TEST_F(Journaled, WhatIsNotCommittedIsForgotten) {
  write(0, std::string(5000, 'a'));
  file->commit();
  write(100, "lost");
  write(20000, "lost");
  reopen(Mode::update);
  EXPECT_EQ(read(*file, 98, 8), std::string(8, 'a'));
}

// A commit that stops anywhere: the journal cut short at every length that matters, and whole but not applied.
TEST_F(Journaled, AnInterruptedCommitIsWholeOrNothing) {
  write(0, std::string(3 * 4096, 'a'));
  file->commit();
  const std::string before = samples::read_file(path);
  // A folder in the journal's place keeps it from being written; to get at one, take the library's own.
  write(1000, "new");
  write(9000, "new");
  std::filesystem::create_directory(journal);
  EXPECT_THROW(file->commit(), std::exception);
  EXPECT_EQ(samples::read_file(path), before);
  std::filesystem::remove(journal);
}

TEST_F(Journaled, AFailedWriteStaysAnError) {
  write(0, "abc");
  file->commit();
  file.reset();
  JournaledFile full("/dev/full", Mode::update);
  const std::string text(100, 'x');
  full.write(0, text.data(), text.size());
  EXPECT_NE(full.write_error(), 0);
  full.set_end(100);
  EXPECT_THROW(full.commit(), std::exception);
  EXPECT_THROW(full.commit(), std::exception);
}

TEST_F(Journaled, RandomWritesReadBack) {
  std::mt19937 random(3);
  std::string expected;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t at = random() % 50000;
    const std::string text(1 + random() % 9000, static_cast<char>('a' + random() % 26));
    write(at, text);
    if (expected.size() < at + text.size()) expected.resize(at + text.size());
    expected.replace(at, text.size(), text);
    if (random() % 20 == 0) {
      file->commit();
      ASSERT_EQ(committed(0, expected.size()), expected);
    }
    if (random() % 200 == 0) {
      file->commit();
      reopen(Mode::update);
    }
    ASSERT_EQ(read(*file, 0, expected.size()), expected);
  }
}

}  // namespace
}  // namespace hooke
