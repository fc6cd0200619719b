// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_set>

#include "hooke/scene/json_path.h"

namespace hooke {
namespace {

// Walks over the text for the parser and tells the event handler how far the parser has read.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  const char** furthest = nullptr;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    *furthest = ++at;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at == b.at; }
};

struct Overflow {
  std::size_t begin = 0;
  std::size_t size = 0;  // 0: no overflow
};

// Builds the value from the parser's events and notes faults that the parser itself would accept.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& name, const std::string& path, JsonReading& out)
      : text_(text),
        name_(name),
        root_path_(path),
        out_(out),
        read_to_(text.data()),
        counted_to_(text.data()) {}

  CountingIterator begin() { return {text_.data(), &read_to_}; }
  CountingIterator end() { return {text_.data() + text_.size(), &read_to_}; }
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
    if (level.doubled && level.container != nullptr) {
      out_.faults.emplace_back(join_path(level.path, v),
                               fmt::format("is given twice in one object, the second time on line {}", line()));
    }
    level.key = std::move(v);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& fault) override {
    constexpr int kNumberOverflow = 406;
    if (fault.id == kNumberOverflow) {
      overflow_ = {position - token.size(), token.size()};
      out_.faults.emplace_back(next_path(),
                               fmt::format("is {}, beyond the largest number (1.8e308)", printable(token, 40)));
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
    std::string path;
    std::string key;    // in an object, the key read last
    bool doubled;       // the object already had that key
    std::unordered_set<std::string> keys;
    std::size_t index;  // in an array, the index of the next value
    bool is_array;
  };

  std::string next_path() const {
    if (open_.empty()) return root_path_;
    const Level& level = open_.back();
    return level.is_array ? join_path(level.path, level.index) : join_path(level.path, level.key);
  }

  // The line of the token read last. The parser reads one character past the end of a number.
  int line() {
    const char* const token_end = read_to_ > text_.data() ? read_to_ - 1 : read_to_;
    if (token_end > counted_to_) {
      line_ += static_cast<int>(std::count(counted_to_, token_end, '\n'));
      counted_to_ = token_end;
    }
    return line_;
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
    if (insert(std::move(value)) != nullptr) out_.lines.emplace(next_path(), line());
    if (!open_.empty()) ++open_.back().index;
    return true;
  }

  bool open(Json&& empty) {
    if (open_.size() >= kDepthLimit) {
      const std::size_t at = static_cast<std::size_t>(read_to_ - text_.data());
      return stop(at == 0 ? 0 : at - 1, fmt::format("is nested deeper than {} levels", kDepthLimit));
    }
    const bool is_array = empty.is_array();
    std::string path = next_path();
    Json* const container = insert(std::move(empty));
    if (container != nullptr) out_.lines.emplace(path, line());
    if (!open_.empty()) ++open_.back().index;
    open_.push_back({container, std::move(path), "", false, {}, 0, is_array});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  bool stop(std::size_t offset, std::string what) {
    const std::string_view before = text_.substr(0, offset);
    const auto newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    const auto lines = 1 + std::count(before.begin(), before.end(), '\n');
    out_.stopped = Finding{fmt::format("{}:{}:{}", name_, lines, column), std::move(what)};
    return false;
  }

  std::string_view text_;
  const std::string& name_;
  const std::string& root_path_;
  JsonReading& out_;
  const char* read_to_;
  const char* counted_to_;
  int line_ = 1;
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
    Builder builder(text, name, path, reading);
    const bool read = Json::sax_parse(builder.begin(), builder.end(), &builder, Json::input_format_t::json,
                                      /*strict=*/true, /*ignore_comments=*/true);
    const Overflow overflow = builder.overflow();
    if (overflow.size == 0) {
      if (!read) reading.value.reset();
      reading.faults.insert(reading.faults.begin(), overflows.begin(), overflows.end());
      return reading;
    }
    overflows.push_back(std::move(reading.faults.back()));
    reading = JsonReading{};
    if (overflows.size() > kMostOverflows) {
      reading.faults = std::move(overflows);
      return reading;
    }
    if (copy.empty()) copy = text;
    copy.replace(overflow.begin, overflow.size, overflow.size - 1, ' ').insert(overflow.begin, 1, '0');
    text = copy;
  }
}

std::string printable(std::string_view text, std::size_t most) {
  // The dump replaces ill-formed bytes and escapes control characters; its quotes are removed.
  std::string all = Json(std::string(text.substr(0, most))).dump(-1, ' ', false, Json::error_handler_t::replace);
  all = all.substr(1, all.size() - 2);
  std::string plain;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == '\\' && i + 1 < all.size() && (all[i + 1] == '"' || all[i + 1] == '\\')) ++i;
    plain += all[i];
  }
  return text.size() > most ? plain + "..." : plain;
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

}  // namespace hooke
