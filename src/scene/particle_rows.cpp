// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/particle_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "hooke/base/assert.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/spelling.h"
#include "hooke/scene/words.h"

namespace hooke::scene {

namespace {

constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();
// The next free id must exist as well.
constexpr std::uint64_t kIdLimit = std::numeric_limits<std::int64_t>::max();

constexpr std::uint64_t kMostFindings = 20;

// Formats that separate columns by blanks write "salt water" as "salt%20water", and "salt%20water" as "salt%2520water".
std::string without_escapes(std::string_view word) {
  std::string plain;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = word.data() + i + 1;
    if (word[i] == '%' && i + 2 < word.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      plain += static_cast<char>(byte);
      i += 2;
    } else {
      plain += word[i];
    }
  }
  return plain;
}

}  // namespace

ParticleRows::ParticleRows(const ParticleFileRules& rules, std::string name, bool only_count, Findings& findings,
                           std::vector<Finding>& warnings)
    : rules_(rules),
      name_(std::move(name)),
      only_count_(only_count),
      findings_(findings),
      warnings_(warnings),
      blank_{{0, 0, 0, rules.velocity.x, rules.velocity.y, rules.velocity.z, kNotSaid, kNotSaid},
             0,
             rules.material.value_or(0)} {
  for (std::size_t m = 0; m < rules.materials.size(); ++m) {
    by_name_.emplace(rules.materials[m].name, static_cast<std::uint16_t>(m));
  }
}

// A file with the same fault on every line would bury everything else.
void ParticleRows::complain(std::uint64_t place, std::string message) {
  if (said_++ < kMostFindings) {
    findings_.add_elsewhere(place_in_file(name_, place, out_.binary), std::move(message));
  } else {
    ++held_back_;
  }
}

void ParticleRows::give_up(const FileFault& fault) {
  gave_up_ = true;
  findings_.add_elsewhere(place_in_file(name_, fault.place(), out_.binary), fault.what());
}

bool ParticleRows::set_columns(std::vector<Column> columns, std::uint64_t place) {
  columns_ = std::move(columns);
  std::vector<std::string> titles;
  std::array<std::size_t, static_cast<std::size_t>(Quantity::passed_over)> count{};
  bool usable = true;
  for (const Column& column : columns_) {
    titles.push_back(printable(column.title, 40));
    if (column.quantity == Quantity::unknown && (ignored_.empty() || ignored_.back() != titles.back())) {
      ignored_.push_back(titles.back());
    }
    if (column.quantity >= Quantity::passed_over) continue;
    if (++count[static_cast<std::size_t>(column.quantity)] != 2) continue;
    complain(place, fmt::format("has two columns \"{}\"", titles.back()));
    usable = false;
  }
  const auto has = [&count](Quantity quantity) { return count[static_cast<std::size_t>(quantity)] > 0; };
  usable = has_axes({has(Quantity::x), has(Quantity::y), has(Quantity::z)}, titles, place) && usable;
  if (usable && !has(Quantity::material) && !rules_.material) {
    complain(place, "has no column \"material\", and the scene's entry names no material either");
    usable = false;
  }
  has_id_ = has(Quantity::id);
  return usable;
}

bool ParticleRows::has_axes(const std::array<bool, 3>& axes, const std::vector<std::string>& titles,
                            std::uint64_t place) {
  std::vector<std::string> missing;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!axes[axis]) missing.emplace_back(1, "xyz"[axis]);
  }
  if (missing.empty()) return true;
  complain(place, fmt::format("has no column{} {}; the header must name x, y and z, and names {}",
                              missing.size() > 1 ? "s" : "", quoted_list(missing), quoted_list(titles)));
  return false;
}

bool ParticleRows::expect(std::uint64_t count, std::uint64_t most) {
  expected_ = std::min(count, most);
  if (only_count_) return false;
  const auto rows = static_cast<std::size_t>(expected_);
  if (has_id_) out_.id.reserve(rows);
  out_.material.reserve(rows);
  out_.position.reserve(rows);
  out_.velocity.reserve(rows);
  out_.place.reserve(rows);
  return true;
}

bool ParticleRows::read(Quantity quantity, std::string_view title, std::string_view text, Row& row,
                        std::uint64_t place) {
  if (quantity < Quantity::id) {
    if (read_number(text, row[quantity])) return true;
    complain(place, fmt::format("{} is \"{}\"; must be a finite number", printable(title, 40), printable(text, 40)));
    return false;
  }
  if (quantity == Quantity::id) {
    if (read_count(text, row.id) && row.id < kIdLimit) return true;
    complain(place,
             fmt::format("id is \"{}\"; must be a whole number from 0 to {}", printable(text, 40), kIdLimit - 1));
    return false;
  }
  return quantity != Quantity::material || read_material(text, row.material, place);
}

bool ParticleRows::read(Quantity quantity, std::string_view title, double value, Row& row, std::uint64_t place) {
  if (quantity < Quantity::id) {
    row[quantity] = value;
    if (std::isfinite(value)) return true;
    complain(place, fmt::format("{} is {}; must be a finite number", printable(title, 40), value));
    return false;
  }
  if (quantity >= Quantity::passed_over) return true;
  // Above 2^53 a double can't represent every whole number.
  constexpr double kMost = 9007199254740992;
  if (!(value >= 0 && value <= kMost && value == std::floor(value))) {
    complain(place,
             fmt::format("{} is {}; must be a whole number from 0 to {:.0f}", printable(title, 40), value, kMost));
    return false;
  }
  const auto whole = static_cast<std::uint64_t>(value);
  if (quantity == Quantity::material) return read_material(fmt::format_int(whole).c_str(), row.material, place);
  row.id = whole;
  return true;
}

bool ParticleRows::read(std::span<const std::string_view> texts, Row& row, std::uint64_t place) {
  if (texts.size() != columns_.size()) {
    complain(place, fmt::format("has {} fields, the header {}", texts.size(), columns_.size()));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const Quantity quantity = columns_[i].quantity;
    if (quantity < Quantity::passed_over) good = read(quantity, columns_[i].title, texts[i], row, place) && good;
  }
  return good;
}

void ParticleRows::add(const Row& row, std::uint64_t place) {
  const auto& [x, y, z, vx, vy, vz, radius, mass] = row.number;
  HOOKE_ASSERT(row.material < rules_.materials.size(), row.material, rules_.materials.size(), place);
  const Material& material = rules_.materials[row.material];
  compare(radius, material.radius, row, place, radius_);
  compare(mass, material.mass, row, place, mass_);
  if (has_id_) out_.id.push_back(row.id);
  out_.material.push_back(row.material);
  out_.position.push_back({x, y, z});
  out_.velocity.push_back({vx, vy, vz});
  out_.place.push_back(place);
}

void ParticleRows::set_velocity(std::uint64_t id, const Vec3d& velocity, std::uint64_t place) {
  // Most files list velocities in the order of the particles.
  if (next_velocity_ < out_.id.size() && out_.id[next_velocity_] == id) {
    out_.velocity[next_velocity_++] = velocity;
    return;
  }
  if (by_id_.empty()) {
    for (std::size_t i = 0; i < out_.id.size(); ++i) by_id_.emplace_back(out_.id[i], i);
    std::sort(by_id_.begin(), by_id_.end());
  }
  const auto found = std::lower_bound(by_id_.begin(), by_id_.end(), std::pair<std::uint64_t, std::size_t>{id, 0});
  if (found != by_id_.end() && found->first == id) {
    out_.velocity[found->second] = velocity;
    next_velocity_ = found->second + 1;
  } else if (said_ == 0) {  // a faulty particle was left out
    complain(place, fmt::format("has the velocity of id {}, which no particle has", id));
  }
}

FileParticles ParticleRows::finish() {
  if (out_.position.empty() && said_ == 0 && !gave_up_) findings_.add_elsewhere(name_, "holds no particles");
  if (held_back_ > 0) {
    findings_.add_elsewhere(name_, fmt::format("{} more findings like those above", held_back_));
  }
  if (!ignored_.empty()) {
    warnings_.push_back(
        {name_, fmt::format("columns that Hooke does not read are ignored: {}", quoted_list(ignored_))});
  }
  warn_of("radius", &Material::radius, radius_);
  warn_of("mass", &Material::mass, mass_);
  return std::move(out_);
}

bool ParticleRows::read_material(std::string_view label, std::uint16_t& index, std::uint64_t place) {
  // Most rows name the same material as the row before.
  if (!last_material_ || label != last_label_) {
    last_material_ = find_material(label);
    last_label_ = label;
  }
  if (!last_material_) {
    complain(place, said_ < kMostFindings ? unknown_material(label) : "");
    return false;
  }
  index = *last_material_;
  return true;
}

std::optional<std::uint16_t> ParticleRows::find_material(std::string_view label) const {
  if (const auto type = rules_.types.find(label); type != rules_.types.end()) return type->second;
  if (label.empty()) return rules_.material;
  std::uint64_t number = 0;
  if (!labels_.numbers || !read_count(label, number)) return find_name(label);
  if (const auto named = numbered_.find(number); named != numbered_.end()) return named->second;
  const auto name = find_name(label);  // of a material that is called like a number
  return name ? name : find_number(number);
}

// What a number means that the file gives no name to.
std::optional<std::uint16_t> ParticleRows::find_number(std::uint64_t number) const {
  if (rules_.material) return rules_.material;
  if (number < labels_.first || number - labels_.first >= rules_.materials.size()) return std::nullopt;
  return static_cast<std::uint16_t>(number - labels_.first);
}

// A name may itself hold what looks like an escape, so what it is an escape of comes first.
std::optional<std::uint16_t> ParticleRows::find_name(std::string_view name) const {
  if (labels_.numbers && name.find('%') != std::string_view::npos) {
    if (const auto found = find_exactly(without_escapes(name))) return found;
  }
  return find_exactly(name);
}

std::optional<std::uint16_t> ParticleRows::find_exactly(std::string_view name) const {
  if (const auto type = rules_.types.find(name); type != rules_.types.end()) return type->second;
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? std::nullopt : std::optional(found->second);
}

// Once, and not for each row: a name may be long.
void ParticleRows::find_numbered() {
  numbered_.clear();
  for (const auto& [number, name] : labels_.names) numbered_.emplace(number, find_name(name));
}

std::string ParticleRows::unknown_material(std::string_view label) const {
  if (label.empty()) return fmt::format("{} is empty, and the scene's entry names none either", labels_.title);
  std::string_view name = label;
  std::uint64_t number = 0;
  if (labels_.numbers && read_count(label, number)) {
    if (const auto named = labels_.names.find(number); named != labels_.names.end()) name = named->second;
  }
  std::vector<std::string> known;
  for (const Material& m : rules_.materials) known.push_back(m.name);
  const std::string hint = did_you_mean(name, known);
  return fmt::format("{} is \"{}\", which the scene does not have{}{} it has {}{}", labels_.title, printable(name, 40),
                     hint, hint.empty() ? ";" : "", quoted_list(known),
                     labels_.numbers ? "; the entry's \"types\" can say what it stands for" : "");
}

void ParticleRows::compare(double value, double expected, const Row& row, std::uint64_t place,
                           Difference& difference) const {
  // Many programs write six digits.
  constexpr double kRounding = 1e-5;
  const double relative = std::abs(value - expected) / expected;
  if (!(relative > kRounding)) return;  // also true where the file gives no value (NaN)
  ++difference.rows;
  if (relative <= difference.worst) return;
  difference.worst = relative;
  difference.value = value;
  difference.material = row.material;
  difference.place = place;
}

void ParticleRows::warn_of(const char* what, double Material::* expected, const Difference& difference) {
  if (difference.rows == 0) return;
  const Material& material = rules_.materials[difference.material];
  warnings_.push_back(
      {place_in_file(name_, difference.place, out_.binary),
       fmt::format("{} is {:.7g}, but {:.7g} of its material \"{}\", which is taken; {} particle{} differ{}, "
                   "this one most",
                   what, difference.value, material.*expected, printable(material.name), difference.rows,
                   difference.rows == 1 ? "" : "s", difference.rows == 1 ? "s" : "")});
}

}  // namespace hooke::scene
