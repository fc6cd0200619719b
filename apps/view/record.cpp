// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "record.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <system_error>

namespace hooke::view {
namespace {

constexpr int kVersion = 1;

std::string hex(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::filesystem::path folder_of(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::absolute(file, ignored).parent_path();
}

// How many of the entries are actions.
std::size_t action_count(const std::vector<RecordEntry>& entries) {
  return static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), [](const RecordEntry& entry) {
    return std::holds_alternative<Action>(entry.what);
  }));
}

// Takes back what came after `steps` steps and `actions` actions.
void take_back(std::vector<RecordEntry>& entries, std::int64_t steps, std::size_t actions) {
  std::size_t count = action_count(entries);
  while (!entries.empty() && (entries.back().steps > steps || count > actions)) {
    if (std::holds_alternative<Action>(entries.back().what)) --count;
    entries.pop_back();
  }
}

RecordHead read_head(const scene::Json& json, const std::filesystem::path& folder) {
  if (json.at("hooke_record").get<int>() != kVersion) throw std::runtime_error("is of another version");
  RecordHead head;
  head.scene = (folder / json.at("scene").get<std::string>()).lexically_normal();
  head.overrides = json.at("set").get<std::vector<std::string>>();
  head.allow_outside = json.at("allow_outside").get<bool>();
  head.device = json.at("device").get<std::string>();
  return head;
}

void read_line(const scene::Json& json, std::vector<RecordEntry>& entries) {
  const auto steps = json.at("steps").get<std::int64_t>();
  if (steps < 0 || (!entries.empty() && !json.contains("back") && steps < entries.back().steps)) {
    throw std::runtime_error("its steps must not descend");
  }
  if (json.contains("hash")) {
    entries.push_back({steps, std::stoull(json["hash"].get<std::string>(), nullptr, 16)});
  } else if (json.contains("back")) {
    take_back(entries, steps, json["back"].get<std::size_t>());
  } else {
    auto action = action_from_json(json);
    if (!action) throw std::runtime_error(action.error().text());
    entries.push_back({steps, std::move(*action)});
  }
}

}  // namespace

Expected<RecordWriter> RecordWriter::create(const std::filesystem::path& file, const RecordHead& head) {
  std::ofstream out(file, std::ios::binary);
  if (!out) return fail(Error::Kind::io, file.string(), "can't be written");
  RecordWriter writer(std::move(out));
  std::error_code ignored;
  const std::filesystem::path scene = std::filesystem::absolute(head.scene, ignored);
  const std::filesystem::path from_here = std::filesystem::relative(scene, folder_of(file), ignored);
  scene::Json json = {{"hooke_record", kVersion}};
  json["scene"] = (from_here.empty() ? scene : from_here).string();
  json["set"] = head.overrides;
  json["allow_outside"] = head.allow_outside;
  json["device"] = head.device;
  writer.write(json);
  if (!writer.is_good()) return fail(Error::Kind::io, file.string(), "can't be written");
  return writer;
}

void RecordWriter::write(const scene::Json& line) { file_ << line.dump() << '\n' << std::flush; }

void RecordWriter::add(std::int64_t steps, const Action& action) {
  scene::Json line = {{"steps", steps}};
  line.update(to_json(action));
  write(line);
}

void RecordWriter::add_hash(std::int64_t steps, std::uint64_t hash) { write({{"steps", steps}, {"hash", hex(hash)}}); }

void RecordWriter::go_back(std::int64_t steps, std::size_t actions) { write({{"steps", steps}, {"back", actions}}); }

Expected<Record> read_record(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(Error::Kind::bad_input, file.string(), "can't be read");
  Record record;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    const auto complain = [&](const std::string& what) {
      return fail(Error::Kind::bad_input, fmt::format("{}:{}", file.string(), number), what);
    };
    try {
      const scene::Json json = scene::Json::parse(text);
      if (number == 1) {
        record.head = read_head(json, folder_of(file));
      } else {
        read_line(json, record.entries);
      }
    } catch (const std::exception& thrown) {
      // The last line may have been cut off when the window was killed.
      if (number > 1 && in.eof()) break;
      return complain(number == 1 ? std::string("is no record of hooke view: ") + thrown.what() : thrown.what());
    }
  }
  if (record.head.scene.empty())
    return fail(Error::Kind::bad_input, file.string(), "is empty, no record of hooke view");
  return record;
}

}  // namespace hooke::view
