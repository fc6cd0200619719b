// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "page.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include "hooke/scene/load_scene.h"

namespace hooke::test {
namespace {

constexpr std::string_view kIndent = "    ";

// The text between ` and ` in a line.
void add_inside(const std::string& line, std::size_t number, std::vector<CodeBlock>& blocks) {
  for (std::size_t begin = line.find('`'); begin != std::string::npos;) {
    const std::size_t end = line.find('`', begin + 1);
    if (end == std::string::npos) return;
    blocks.push_back({CodeBlock::Kind::inside, "", "", line.substr(begin + 1, end - begin - 1), number});
    begin = line.find('`', end + 1);
  }
}

// Whether line `number` follows on an indented block.
bool goes_on(const std::vector<CodeBlock>& blocks, std::size_t number) {
  if (blocks.empty() || blocks.back().kind != CodeBlock::Kind::indented) return false;
  const std::string& text = blocks.back().text;
  return blocks.back().line + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) == number;
}

bool is_scene(const CodeBlock& block) {
  return block.language == "json" && block.text.find("\"hooke\"") != std::string::npos;
}

}  // namespace

std::vector<CodeBlock> blocks_of(const std::filesystem::path& page) {
  std::ifstream in(page);
  std::vector<CodeBlock> blocks;
  bool fenced = false;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      fenced = !fenced;
      if (!fenced) continue;
      std::istringstream words(line.substr(3));
      blocks.push_back({CodeBlock::Kind::fenced, "", "", "", number});
      words >> blocks.back().language >> blocks.back().name;
    } else if (fenced) {
      blocks.back().text += line + '\n';
    } else if (line.starts_with(kIndent)) {
      if (!goes_on(blocks, number)) blocks.push_back({CodeBlock::Kind::indented, "", "", "", number});
      blocks.back().text += line.substr(kIndent.size()) + '\n';
    } else {
      add_inside(line, number, blocks);
    }
  }
  return blocks;
}

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

PageTest::PageTest() {
  std::filesystem::create_directories(path("bin"));
  std::filesystem::create_symlink(program_file(), path("bin/hooke"));
}

std::string PageTest::shell(const std::string& script, int status) const {
  write("script.sh", script);
  const std::string folder = path(".").string();
  const int ended = std::system(("cd '" + folder + "' && PATH='" + folder + "/bin':/usr/bin:\"$PATH\" " +
                                 "sh -eu script.sh > script.out 2>&1 < /dev/null")
                                    .c_str());
  EXPECT_TRUE(WIFEXITED(ended) && WEXITSTATUS(ended) == status) << script << read("script.out");
  return read("script.out");
}

std::string PageTest::follow(const std::filesystem::path& page) const {
  std::string output;
  for (const CodeBlock& block : blocks_of(page)) {
    if (block.kind != CodeBlock::Kind::fenced) continue;
    const std::string where = page.filename().string() + ":" + std::to_string(block.line);
    const testing::ScopedTrace trace(__FILE__, __LINE__, where);
    if (block.language == "sh") {
      output += shell(block.text, block.name == "fails" ? 2 : 0);
    } else if (!block.name.empty()) {
      write(block.name, block.text);
    }
    if (is_scene(block)) {
      scene::LoadOptions options;
      options.with_particles = false;  // a command further down may make the files
      const auto loaded = scene::parse_scene(block.text, where, path("."), options);
      EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().text());
    }
    if (testing::Test::HasFailure()) break;
  }
  return output;
}

}  // namespace hooke::test
