// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace hooke::scene {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

constexpr std::size_t kPiece = std::size_t{1} << 20U;

}  // namespace

Expected<std::string> read_text_file(const std::filesystem::path& path, std::uint64_t most) {
  const auto refuse = [&path](const std::string& why) { return fail(Error::Kind::bad_input, path.string(), why); };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return refuse("can't be read: it is a folder");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return refuse(std::string("can't be opened: ") + std::strerror(errno));
  std::string text;
  while (true) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    const std::size_t got = std::fread(text.data() + before, 1, kPiece, file.get());
    text.resize(before + got);
    if (text.size() > most) return refuse("is larger than " + std::to_string(most) + " bytes");
    if (got < kPiece) break;
  }
  if (std::ferror(file.get()) != 0) return refuse(std::string("can't be read: ") + std::strerror(errno));
  return text;
}

}  // namespace hooke::scene
