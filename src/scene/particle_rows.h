// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/scene/file_scanner.h"
#include "hooke/scene/particle_file.h"

namespace hooke {

/// What a column of a file of particles holds. SI units.
enum class Field : std::uint8_t {
  x,
  y,
  z,
  vx,
  vy,
  vz,
  radius,
  mass,
  id,
  material,     ///< a name, or a number that stands for one
  passed_over,  ///< known, and of no use
  unknown,
};
inline constexpr std::size_t kNumbers = 8;  ///< fields that are numbers: those before Field::id

struct Column {
  Field field;
  std::string title;  ///< as the file calls it
};

/// What particles of a file may say instead of the name of a material.
struct MaterialLabels {
  std::string title = "material";  ///< how messages call a label
  bool numbers = false;            ///< whether numbers stand for materials
  std::uint64_t first = 1;         ///< number of the scene's first material, where the file names none
  std::map<std::uint64_t, std::string> names;  ///< that the file gives to numbers
};

/// One particle on its way.
struct Row {
  std::array<double, kNumbers> number;
  std::uint64_t id;
  std::uint16_t material;

  /// Of a field that is a number.
  double& operator[](Field field) {
    HOOKE_ASSERT(field < Field::id, field);
    return number[static_cast<std::size_t>(field)];
  }
};

/// Makes particles from the columns of a file, the same way for every format: checks values, finds materials, notes
/// what is wrong (all of it, but not forever) and which columns were of no use.
class ParticleRows {
 public:
  ParticleRows(const ParticleFileRules& rules, std::string name, bool only_count, Findings& findings,
               std::vector<Finding>& warnings);

  const ParticleFileRules& rules() const { return rules_; }

  /// What the file calls materials; by name alone if this is not called. Before set_columns.
  void set_labels(MaterialLabels labels) {
    HOOKE_ASSERT(columns_.empty(), columns_.size());
    labels_ = std::move(labels);
  }
  /// Places from now on are bytes, not lines.
  void set_binary() { out_.binary = true; }
  /// The columns of every row. False, with findings at `place`, where they can't make particles.
  bool set_columns(std::vector<Column> columns, std::uint64_t place);
  /// Something in the file that is not read.
  void ignore(std::string title) { ignored_.push_back(std::move(title)); }
  /// How many rows the file says there are, and how many its size allows. False if no more was to be found out.
  [[nodiscard]] bool expect(std::uint64_t count, std::uint64_t most);
  std::uint64_t expected() const { return expected_; }

  /// A row in which nothing has been read yet.
  Row blank() const { return blank_; }
  /// Reads one value into `row`. False, with a finding, where it is not good.
  bool read(Field field, std::string_view title, std::string_view text, Row& row, std::uint64_t place);
  bool read(Field field, std::string_view title, double value, Row& row, std::uint64_t place);
  /// Reads a row of as many texts as there are columns. False, with findings, where it is not good.
  bool read(std::span<const std::string_view> texts, Row& row, std::uint64_t place);
  /// A row in which every column has been read.
  void add(const Row& row, std::uint64_t place);
  /// Velocities of particles that are known by their ids, where they follow later.
  void set_velocity(std::uint64_t id, const Vec3d& velocity, std::uint64_t place);

  /// Notes a fault after which reading goes on.
  void complain(std::uint64_t place, std::string message);
  /// Notes what ended the reading.
  void give_up(const FileFault& fault);
  /// All particles, and the warnings about them.
  FileParticles finish();

 private:
  // How far a column is from what the materials say.
  struct Difference {
    std::uint64_t rows = 0;
    double worst = 0;  // relative
    double value = 0;
    std::uint16_t material = 0;
    std::uint64_t place = 0;
  };

  bool read_material(std::string_view label, std::uint16_t& index, std::uint64_t place);
  std::optional<std::uint16_t> find_material(std::string_view label, std::uint64_t place);
  std::optional<std::uint16_t> find_name(std::string_view name) const;
  void compare(double value, double expected, const Row& row, std::uint64_t place, Difference& difference) const;
  void warn_of(const char* what, double Material::* expected, const Difference& difference);

  const ParticleFileRules& rules_;
  std::string name_;
  bool only_count_;
  Findings& findings_;
  std::vector<Finding>& warnings_;
  FileParticles out_;
  std::vector<Column> columns_;
  std::vector<std::string> ignored_;
  MaterialLabels labels_;
  std::uint64_t expected_ = 0;
  bool has_id_ = false;
  Row blank_;
  std::string last_label_;
  std::optional<std::uint16_t> last_material_;
  Difference radius_;
  Difference mass_;
  std::uint64_t said_ = 0;
  std::uint64_t held_back_ = 0;
  std::vector<std::pair<std::uint64_t, std::size_t>> by_id_;  // id and row, once velocities are looked for
  std::size_t next_velocity_ = 0;
};

}  // namespace hooke
