// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_lines.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "hooke/scene/json_cursor.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/json_reader.h"

namespace hooke::scene {
namespace {

// A value that is looked for, or that lies above one.
struct Wanted {
  int line = 0;  // 0 until it is found
  std::map<std::variant<std::string, std::size_t>, Wanted> parts;

  Wanted* part(const std::variant<std::string, std::size_t>& step) {
    const auto found = parts.find(step);
    // Of two equal keys the first counts.
    return found == parts.end() || found->second.line != 0 ? nullptr : &found->second;
  }
};

// Follows the parser through the text, and down the tree of what is wanted.
class LineFinder : public nlohmann::json_sax<Json> {
 public:
  LineFinder(JsonCursor& cursor, Wanted& root) : cursor_(cursor), root_(root) {}

  bool null() override { return plain(); }
  bool boolean(bool) override { return plain(); }
  bool number_integer(number_integer_t) override { return plain(); }
  bool number_unsigned(number_unsigned_t) override { return plain(); }
  bool number_float(number_float_t, const string_t&) override { return plain(); }
  bool string(string_t&) override { return plain(); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = open_.back();
    level.next = level.value == nullptr || level.value->parts.empty() ? nullptr : level.value->part(std::move(name));
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  struct Level {
    Wanted* value;  // null where nothing in it is wanted
    Wanted* next;   // in an object, the value of the key read last
    std::size_t index;
    bool is_array;
  };

  Wanted* next() {
    if (open_.empty()) return &root_;
    Level& level = open_.back();
    if (!level.is_array) return level.next;
    return level.value == nullptr || level.value->parts.empty() ? nullptr : level.value->part(level.index);
  }
  Wanted* found() {
    Wanted* const value = next();
    if (value != nullptr) value->line = cursor_.line();
    return value;
  }
  bool plain() {
    found();
    if (!open_.empty()) ++open_.back().index;
    return true;
  }
  bool open(bool is_array) {
    if (open_.size() >= kDepthLimit) return false;
    open_.push_back({found(), nullptr, 0, is_array});
    return true;
  }
  bool close() {
    open_.pop_back();
    if (!open_.empty()) ++open_.back().index;
    return true;
  }

  JsonCursor& cursor_;
  Wanted& root_;
  std::vector<Level> open_;
};

}  // namespace

std::vector<int> lines_of(std::string_view text, const std::vector<std::string>& paths) {
  Wanted root;
  struct Place {
    const Wanted* value;
    const Wanted* above;
  };
  std::vector<Place> places;
  for (const std::string& path : paths) {
    Place place{&root, &root};
    Wanted* at = &root;
    for (auto& step : parse_path(path).value_or(JsonPath{})) {
      place.above = at;
      at = &at->parts[std::move(step)];
    }
    place.value = at;
    places.push_back(place);
  }
  JsonCursor cursor(text);
  LineFinder finder(cursor, root);
  Json::sax_parse(cursor.begin(), cursor.end(), &finder, Json::input_format_t::json, /*strict=*/true,
                  /*ignore_comments=*/true);
  std::vector<int> lines;
  for (const Place& place : places) lines.push_back(place.value->line != 0 ? place.value->line : place.above->line);
  return lines;
}

}  // namespace hooke::scene
