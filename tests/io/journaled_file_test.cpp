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
using Mode = io::JournaledFile::Mode;

class Journaled : public testing::Test {
 protected:
  Journaled() { reopen(Mode::create); }

  void reopen(Mode mode) {
    file.reset();
    file = std::make_unique<io::JournaledFile>(path, mode);
  }
  void write(std::uint64_t at, const std::string& text) {
    file->write(at, text.data(), text.size());
    file->set_end(std::max(file->end(), at + text.size()));
  }
  static std::string read(io::JournaledFile& from, std::uint64_t at, std::size_t size) {
    std::string text(size, '?');
    EXPECT_EQ(from.read(at, text.data(), size), 0);
    return text;
  }
  std::string committed(std::uint64_t at, std::size_t size) {
    io::JournaledFile reader(path, Mode::read);
    return read(reader, at, size);
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder / "file";
  std::filesystem::path journal = folder / "file.journal";
  std::unique_ptr<io::JournaledFile> file;
};

TEST_F(Journaled, ChangesShowWhenTheyAreCommitted) {
  write(0, std::string(10000, 'a'));
  file->commit();
  write(4090, "0123456789");  // across a page boundary
  write(9998, "xyz");         // across the committed end
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

// A commit that stops anywhere: while the journal is written, after it, or while pages are copied into place.
TEST_F(Journaled, AnInterruptedCommitIsWholeOrNothing) {
  write(0, std::string(3 * 4096, 'a'));
  file->commit();
  const std::string before = samples::read_file(path);
  write(1000, "new");
  write(9000, "new");
  // A second name for the journal keeps it when the commit is done.
  samples::write_file(folder / "kept", "");
  std::filesystem::create_hard_link(folder / "kept", journal);
  file->commit();
  file.reset();
  const std::string after = samples::read_file(path);
  const std::string whole_journal = samples::read_file(folder / "kept");
  ASSERT_GT(whole_journal.size(), 2 * 4096U);
  ASSERT_NE(after, before);
  const std::string half_applied = after.substr(0, 5000) + before.substr(5000);

  const auto content = [&] { return committed(0, before.size()); };
  for (std::size_t size = 0; size < whole_journal.size(); size += 41) {
    samples::write_file(path, before);
    samples::write_file(journal, whole_journal.substr(0, size));
    ASSERT_EQ(content(), before) << size;
    io::JournaledFile(path, Mode::update);
    ASSERT_EQ(samples::read_file(path), before);
    ASSERT_FALSE(std::filesystem::exists(journal));
  }
  for (const std::string& interrupted : {before, half_applied, after}) {
    samples::write_file(path, interrupted);
    samples::write_file(journal, whole_journal);
    EXPECT_EQ(content(), after);
    io::JournaledFile(path, Mode::update);
    EXPECT_EQ(samples::read_file(path), after);
    EXPECT_FALSE(std::filesystem::exists(journal));
  }
  std::string damaged = whole_journal;
  damaged[100] = static_cast<char>(damaged[100] ^ 1);
  samples::write_file(path, before);
  samples::write_file(journal, damaged);
  EXPECT_EQ(content(), before);
}

TEST_F(Journaled, ACommitThatCantWriteItsJournalChangesNothing) {
  write(0, std::string(3 * 4096, 'a'));
  file->commit();
  write(1000, "new");
  std::filesystem::create_directory(journal);
  EXPECT_THROW(file->commit(), std::exception);
  EXPECT_EQ(samples::read_file(path), std::string(3 * 4096, 'a'));
}

TEST_F(Journaled, AFailedWriteStaysAnError) {
  write(0, "abc");
  file->commit();
  file.reset();
  io::JournaledFile full("/dev/full", Mode::update);
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
