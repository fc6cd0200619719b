// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Every page's commands and scenes. Fenced commands are run as they stand; docs/interchange.md has a test of its own.
// Indented ones, of scenes that take minutes, are run for two steps and in small pictures. Those inside of a line, and
// those of the window, are compared with the program's help.

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "page.h"
#include "source_dir.h"
#include "support/openvdb.h"

namespace hooke::test {
namespace {

std::vector<std::string> pages() {
  std::vector<std::string> pages{"README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"};
  for (const auto& file : std::filesystem::directory_iterator(HOOKE_SOURCE_DIR "/docs")) {
    if (file.path().extension() == ".md") pages.push_back("docs/" + file.path().filename().string());
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

// A command line without its comment, in words; empty where it doesn't call the program.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line.substr(0, line.find(" #")));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.empty() || (words[0] != "hooke" && words[0] != "build/hooke")) return {};
  words.erase(words.begin());
  return words;
}

class Pages : public PageTest, public testing::WithParamInterface<std::string> {
 protected:
  Pages() { std::filesystem::create_directory_symlink(HOOKE_SOURCE_DIR "/scenes", path("scenes")); }

  std::filesystem::path page() const { return std::filesystem::path(HOOKE_SOURCE_DIR) / GetParam(); }

  // The command exists and has these options.
  void expect_known(const std::vector<std::string>& words) {
    if (words.empty() || !std::isalpha(static_cast<unsigned char>(words[0][0]))) return;
    std::string& help = help_[words[0]];
    if (help.empty()) {
      const Outcome outcome = hooke({"help", words[0]});
      if (words[0] == "view" && outcome.status != 0) return;  // the window is built where its libraries are
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      help = outcome.out;
    }
    for (const std::string& word : words) {
      if (!word.starts_with("-") || word.size() < 2 || !std::isalpha(static_cast<unsigned char>(word.back()))) continue;
      EXPECT_TRUE(std::regex_search(help, std::regex("[ ,]" + word.substr(0, word.find('=')) + "[ ,\n]")))
          << "hooke " << words[0] << " has no " << word;
    }
  }

  // Runs the command, in little time.
  void try_out(std::vector<std::string> words) {
    const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
    const auto drop = [&](const char* option) {
      const auto found = std::find(words.begin(), words.end(), option);
      if (found != words.end()) words.erase(found, found + 2);
    };
    if (words[0] == "view") return expect_known(words);
    if (words[0] == "run") {
      drop("--end");
      words.insert(words.end(), {"--steps", "2"});
    }
    for (const char* option : {"--time", "--from", "--to"}) drop(option);
    if (words[0] == "render" || has("--film")) {
      drop("--size");
      words.insert(words.end(), {"--size", "64x36"});
    }
    const Outcome outcome = hooke(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

 private:
  std::map<std::string, std::string> help_;
};

TEST_P(Pages, FencedCommandsRun) {
  if (GetParam() == "docs/interchange.md") GTEST_SKIP() << "has a test of its own";
  HOOKE_NEEDS_OPENVDB();
  follow(page());
}

TEST_P(Pages, IndentedCommandsRun) {
  HOOKE_NEEDS_OPENVDB();
  std::filesystem::create_directories(path("out"));
  for (const CodeBlock& block : blocks_of(page())) {
    if (block.kind != CodeBlock::Kind::indented) continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) {
      SCOPED_TRACE(GetParam() + ":" + std::to_string(block.line) + ": " + line);
      if (const auto words = words_of(line); !words.empty()) try_out(words);
    }
  }
}

TEST_P(Pages, CommandsInsideOfLinesExist) {
  for (const CodeBlock& block : blocks_of(page())) {
    if (block.kind != CodeBlock::Kind::inside) continue;
    SCOPED_TRACE(GetParam() + ":" + std::to_string(block.line) + ": " + block.text);
    expect_known(words_of(block.text));
  }
}

INSTANTIATE_TEST_SUITE_P(Docs, Pages, testing::ValuesIn(pages()), [](const auto& page) {
  std::string name = page.param;
  std::replace_if(name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace hooke::test
