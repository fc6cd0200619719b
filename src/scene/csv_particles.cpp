// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/csv_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "hooke/scene/json_reader.h"
#include "hooke/scene/nearest.h"
#include "hooke/scene/text_file.h"

namespace hooke {
namespace {

enum Column : std::size_t { x, y, z, vx, vy, vz, id, material, kColumns };
constexpr std::array<std::string_view, kColumns> kNames{"x", "y", "z", "vx", "vy", "vz", "id", "material"};
constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Takes the next line off `rest`, without its end.
std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

// The fields of one line. Their text is that of the line, or of `unquoted` where quotes had to be taken off.
struct Fields {
  std::vector<std::string_view> at;
  std::vector<std::string> unquoted;
  bool open_quote = false;

  void split(std::string_view line) {
    at.clear();
    unquoted.clear();
    open_quote = false;
    if (line.find('"') != std::string_view::npos) return split_quoted(line);
    while (true) {
      const auto comma = line.find(',');
      at.push_back(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

 private:
  void split_quoted(std::string_view line) {
    std::string field;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"' && open_quote && i + 1 < line.size() && line[i + 1] == '"') {
        field += line[i++];  // a doubled quote within quotes is one
      } else if (line[i] == '"') {
        open_quote = !open_quote;
      } else if (line[i] == ',' && !open_quote) {
        unquoted.push_back(std::exchange(field, ""));
      } else {
        field += line[i];
      }
    }
    unquoted.push_back(std::move(field));
    for (const std::string& text : unquoted) at.push_back(trimmed(text));
  }
};

class Reader {
 public:
  Reader(const std::string& name, const CsvDefaults& defaults, Findings& findings)
      : name_(name),
        defaults_(defaults),
        findings_(findings) {}

  CsvParticles read(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
    if (trimmed(text).find_first_not_of('\n') == std::string_view::npos) {
      complain("is empty; it must start with a header that has columns x, y, z");
      return {};
    }
    if (!read_header(take_line(text))) return {};
    reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
    while (!text.empty()) {
      const std::string_view line = take_line(text);
      ++line_;
      if (!trimmed(line).empty()) read_row(line);
    }
    if (held_back_ > 0) {
      findings_.add_elsewhere(name_, fmt::format("{} more findings like those above", held_back_));
    }
    return std::move(out_);
  }

 private:
  // A file with one kind of fault on every line would bury everything else.
  void complain(std::string message) {
    constexpr std::uint64_t kMost = 20;
    if (said_++ >= kMost) {
      ++held_back_;
    } else {
      findings_.add_elsewhere(fmt::format("{}:{}", name_, line_), std::move(message));
    }
  }

  bool read_header(std::string_view line) {
    fields_.split(line);
    columns_ = fields_.at.size();
    column_.fill(kAbsent);
    bool usable = true;
    std::vector<std::string> unknown;
    std::vector<std::string> titles;
    for (std::size_t i = 0; i < columns_; ++i) {
      const std::string_view title = fields_.at[i];
      titles.push_back(printable(title, 40));
      const auto known = std::find(kNames.begin(), kNames.end(), title);
      if (known == kNames.end()) {
        unknown.push_back(titles.back());
      } else if (std::size_t& column = column_[static_cast<std::size_t>(known - kNames.begin())]; column != kAbsent) {
        complain(fmt::format("has two columns \"{}\"", title));
        usable = false;
      } else {
        column = i;
      }
    }
    for (std::size_t axis = x; axis <= z; ++axis) {
      if (column_[axis] != kAbsent) continue;
      complain(fmt::format("has no column \"{}\"; the header must name x, y and z, and names {}", kNames[axis],
                           quoted_list(titles)));
      usable = false;
    }
    if (usable && column_[material] == kAbsent && !defaults_.material) {
      complain("has no column \"material\", and the scene's entry names no material either");
      usable = false;
    }
    out_.ignored_columns = std::move(unknown);
    return usable;
  }

  void reserve(std::size_t rows) {
    if (column_[id] != kAbsent) out_.id.reserve(rows);
    out_.material.reserve(rows);
    out_.position.reserve(rows);
    out_.velocity.reserve(rows);
    out_.line.reserve(rows);
  }

  void read_row(std::string_view line) {
    fields_.split(line);
    if (fields_.open_quote) return complain("has a quote that is not closed");
    if (fields_.at.size() != columns_) {
      return complain(fmt::format("has {} fields, the header {}", fields_.at.size(), columns_));
    }
    std::array<double, 6> numbers{0, 0, 0, defaults_.velocity.x, defaults_.velocity.y, defaults_.velocity.z};
    bool good = true;
    for (std::size_t i = x; i <= vz; ++i) {
      if (column_[i] != kAbsent) good = read_number(i, numbers[i]) && good;
    }
    std::uint64_t particle_id = 0;
    if (column_[id] != kAbsent) good = read_id(particle_id) && good;
    std::uint16_t index = defaults_.material.value_or(0);
    if (column_[material] != kAbsent) good = read_material(index) && good;
    if (!good) return;
    if (column_[id] != kAbsent) out_.id.push_back(particle_id);
    out_.material.push_back(index);
    out_.position.push_back({numbers[x], numbers[y], numbers[z]});
    out_.velocity.push_back({numbers[vx], numbers[vy], numbers[vz]});
    out_.line.push_back(line_);
  }

  bool read_number(std::size_t column, double& value) {
    std::string_view text = fields_.at[column_[column]];
    const std::string_view written = text;
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = stop == text.data() + text.size();
    // Too small for a double is as good as 0; too large is not: strtod tells them apart.
    if (fault == std::errc::result_out_of_range && whole) value = std::strtod(std::string(text).c_str(), nullptr);
    if ((fault == std::errc() || fault == std::errc::result_out_of_range) && whole && std::isfinite(value)) return true;
    complain(fmt::format("{} is \"{}\"; must be a finite number", kNames[column], printable(written, 40)));
    return false;
  }

  bool read_id(std::uint64_t& value) {
    const std::string_view text = fields_.at[column_[id]];
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    // The next free id must exist, too.
    constexpr std::uint64_t kLargest = std::numeric_limits<std::int64_t>::max();
    if (fault == std::errc() && stop == text.data() + text.size() && value < kLargest) return true;
    complain(fmt::format("id is \"{}\"; must be a whole number from 0 to 9223372036854775806", printable(text, 40)));
    return false;
  }

  bool read_material(std::uint16_t& index) {
    const std::string_view name = fields_.at[column_[material]];
    if (name.empty()) {
      if (!defaults_.material) complain("material is empty, and the scene's entry names none either");
      return defaults_.material.has_value();
    }
    // Most rows name what the row before did.
    if (name == last_name_) {
      index = last_index_;
      return true;
    }
    const auto& known = defaults_.materials;
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      const std::string hint = did_you_mean(name, known);
      complain(fmt::format("material is \"{}\", which the scene does not have{}{} it has {}", printable(name, 40), hint,
                           hint.empty() ? ";" : "", quoted_list(known)));
      return false;
    }
    last_name_ = *found;
    index = last_index_ = static_cast<std::uint16_t>(found - known.begin());
    return true;
  }

  const std::string& name_;
  const CsvDefaults& defaults_;
  Findings& findings_;
  CsvParticles out_;
  Fields fields_;
  std::array<std::size_t, kColumns> column_{};  // where each known column stands
  std::size_t columns_ = 0;
  std::uint32_t line_ = 1;
  std::uint64_t said_ = 0;
  std::uint64_t held_back_ = 0;
  std::string_view last_name_;
  std::uint16_t last_index_ = 0;
};

}  // namespace

CsvParticles read_csv_particles(const std::filesystem::path& file, const std::string& name, const CsvDefaults& defaults,
                                Findings& findings) {
  const auto text = read_text_file(file, std::numeric_limits<std::uint64_t>::max());
  if (!text) {
    findings.add_elsewhere(name, text.error().findings.front().message);
    return {};
  }
  return Reader(name, defaults, findings).read(*text);
}

}  // namespace hooke
