// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "hooke/scene/json_cursor.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/words.h"

namespace hooke::scene {
namespace {

struct Overflow {
  std::size_t begin = 0;
  std::size_t size = 0;  // 0: no overflow
};

// Builds the value from the parser's events and notes faults that the parser itself would accept.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(JsonCursor& cursor, const std::string& name, const std::string& path, JsonReading& out)
      : cursor_(cursor),
        name_(name),
        root_path_(path),
        out_(out) {}

  Overflow overflow() const { return overflow_; }

  bool null() override { return put(nullptr); }
  bool boolean(bool v) override { return put(v); }
  bool number_integer(number_integer_t v) override { return put(v); }
  bool number_unsigned(number_unsigned_t v) override { return put(v); }
  bool number_float(number_float_t v, const string_t&) override {
    // 1e6 and 4.0 are allowed where a whole number is asked for.
    constexpr double kExact = 9007199254740992;
    const bool whole = std::trunc(v) == v && std::abs(v) <= kExact && !(v == 0 && std::signbit(v));
    return whole ? put(static_cast<number_integer_t>(v)) : put(v);
  }
  bool string(string_t& v) override { return put(std::move(v)); }
  bool binary(binary_t&) override { return false; }  // JSON text has none

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& v) override {
    Level& level = open_.back();
    level.doubled = !level.keys.insert(v).second;
    level.key = std::move(v);
    if (level.doubled && level.container != nullptr) {
      note(fmt::format("is given twice in one object, the second time on line {}", cursor_.line()));
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& fault) override {
    constexpr int kNumberOverflow = 406;
    if (fault.id == kNumberOverflow) {
      overflow_ = {position - token.size(), token.size()};
      out_.faults.emplace_back(path(), fmt::format("is {}, beyond the largest number (1.8e308)", printable(token, 40)));
      return false;
    }
    // "[json.exception.parse_error.101] parse error at line 3, column 7: what": our own message names the place.
    std::string what = fault.what();
    const auto column = what.find("column");
    const auto colon = what.find(": ", column == std::string::npos ? 0 : column);
    if (colon != std::string::npos) what.erase(0, colon + 2);
    if (what.find("ill-formed UTF-8") != std::string::npos) what = "the text is not valid UTF-8 here";
    out_.syntax_error = true;
    return stop(position == 0 ? 0 : position - 1, printable(what));
  }

 private:
  // An array or object being read.
  struct Level {
    Json* container;  // null within the second value of a duplicate key, which is dropped
    std::string key;    // in an object, the key read last
    bool doubled;       // the object already had that key
    std::unordered_set<std::string> keys;
    std::size_t index;  // in an array, the index of the value being read
    bool is_array;
  };

  // Of the value being read. Made where a fault needs it: kept for each value, paths would take more than the text.
  std::string path() const {
    std::string all = root_path_;
    for (const Level& level : open_) {
      all = level.is_array ? join_path(all, level.index) : join_path(all, level.key);
    }
    return all;
  }

  // More than the findings that are kept would only take memory.
  void note(std::string message) {
    if (out_.faults.size() <= Findings::kMost) out_.faults.emplace_back(path(), std::move(message));
  }

  // Puts a value into its container; null within a value that is dropped.
  Json* insert(Json&& value) {
    if (open_.empty()) return &out_.value.emplace(std::move(value));
    Level& level = open_.back();
    if (level.container == nullptr || level.doubled) return nullptr;
    if (level.is_array) return &level.container->emplace_back(std::move(value));
    // The key is known to be new, so there is no need to search for it again.
    auto& members = level.container->get_ref<Json::object_t&>();
    static_cast<Json::object_t::Container&>(members).emplace_back(level.key, std::move(value));
    return &members.back().second;
  }

  bool put(Json&& value) {
    insert(std::move(value));
    return end_value();
  }

  bool open(Json&& empty) {
    if (open_.size() >= kDepthLimit)
      return stop(cursor_.offset(), fmt::format("is nested deeper than {} levels", kDepthLimit));
    const bool is_array = empty.is_array();
    Json* const container = insert(std::move(empty));
    open_.push_back({container, "", false, {}, 0, is_array});
    return true;
  }

  bool close() {
    open_.pop_back();
    return end_value();
  }

  bool end_value() {
    if (!open_.empty()) ++open_.back().index;
    return true;
  }

  bool stop(std::size_t offset, std::string what) {
    const std::string_view before = cursor_.text().substr(0, offset);
    const auto line_end = before.find_last_of("\r\n");
    const std::size_t column = line_end == std::string_view::npos ? before.size() + 1 : before.size() - line_end;
    out_.stopped =
        Finding{fmt::format("{}:{}:{}", name_, 1 + count_line_ends(before, 0, before.size()), column), std::move(what)};
    return false;
  }

  JsonCursor& cursor_;
  const std::string& name_;
  const std::string& root_path_;
  JsonReading& out_;
  std::vector<Level> open_;
  Overflow overflow_;
};

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

void write_pretty(const Json& value, std::size_t indent, std::string& out) {
  const auto is_plain = [](const Json& v) { return !v.is_structured() || v.empty(); };
  if (is_plain(value)) {
    out += value.dump();
    return;
  }
  const bool one_line = value.is_array() && std::all_of(value.begin(), value.end(), is_plain);
  const std::string separator = one_line ? ", " : ",\n" + std::string(indent + 2, ' ');
  out += value.is_array() ? '[' : '{';
  if (!one_line) out += '\n' + std::string(indent + 2, ' ');
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) out += separator;
    first = false;
    if (value.is_object()) out += Json(item.key()).dump() + ": ";
    write_pretty(item.value(), indent + 2, out);
  }
  if (!one_line) out += '\n' + std::string(indent, ' ');
  out += value.is_array() ? ']' : '}';
}

}  // namespace

JsonReading read_json(std::string_view text, const std::string& name, const std::string& path) {
  JsonReading reading;
  text = without_byte_order_mark(text);
  if (is_blank(text)) {
    reading.syntax_error = true;
    reading.stopped = Finding{name, text.empty() ? "is empty" : "is blank: it holds nothing but white space"};
    return reading;
  }
  // The parser can't go on after a number that overflows. The number is blanked out and the text read again, so that
  // all findings are reported at once.
  constexpr std::size_t kMostOverflows = 50;
  std::string copy;
  std::vector<std::pair<std::string, std::string>> overflows;
  while (true) {
    JsonCursor cursor(text);
    Builder builder(cursor, name, path, reading);
    const bool read = Json::sax_parse(cursor.begin(), cursor.end(), &builder, Json::input_format_t::json,
                                      /*strict=*/true, /*ignore_comments=*/true);
    const Overflow overflow = builder.overflow();
    if (overflow.size == 0) {
      if (!read) reading.value.reset();
      reading.faults.insert(reading.faults.begin(), overflows.begin(), overflows.end());
      break;
    }
    overflows.push_back(std::move(reading.faults.back()));
    reading = JsonReading{};
    if (copy.empty()) copy = text;
    copy.replace(overflow.begin, overflow.size, overflow.size - 1, ' ').insert(overflow.begin, 1, '0');
    text = copy;
    if (overflows.size() > kMostOverflows) {
      reading.faults = std::move(overflows);
      break;
    }
  }
  reading.readable = std::move(copy);
  return reading;
}

std::string brief(const Json& value) {
  constexpr std::size_t kMost = 60;
  if (value.is_string()) return '"' + printable(value.get_ref<const std::string&>(), kMost) + '"';
  if (value.is_object() && !value.empty()) return "an object";
  const auto is_plain = [](const Json& item) { return !item.is_structured(); };
  if (value.is_array() && (value.size() > 6 || !std::all_of(value.begin(), value.end(), is_plain))) {
    return fmt::format("a list of {} entr{}", value.size(), value.size() == 1 ? "y" : "ies");
  }
  return printable(value.dump(-1, ' ', false, Json::error_handler_t::replace), kMost);
}

std::string pretty(const Json& value) {
  std::string out;
  write_pretty(value, 0, out);
  out += '\n';
  return out;
}

}  // namespace hooke::scene
