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
#include <unordered_map>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/scene/file_scanner.h"
#include "hooke/scene/particle_file.h"

namespace hooke::scene {

/// What a column of a particle file holds. SI units.
enum class Quantity : std::uint8_t {
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
  passed_over,  ///< known but not used
  unknown,
};
inline constexpr std::size_t kNumbers = 8;  ///< number of quantities that are numbers: those before Quantity::id

struct Column {
  Quantity quantity;
  std::string title;  ///< the file's name for it
};

/// What a file may write in place of the name of a material.
struct MaterialLabels {
  std::string title = "material";  ///< what messages call a label
  bool numbers = false;            ///< whether numbers stand for materials
  std::uint64_t first = 1;         ///< number of the scene's first material, where the file names no materials
  std::map<std::uint64_t, std::string> names;  ///< names that the file gives to numbers
};

/// One particle while it is being read.
struct Row {
  std::array<double, kNumbers> number;
  std::uint64_t id;
  std::uint16_t material;

  /// The value of a number.
  double& operator[](Quantity quantity) {
    HOOKE_ASSERT(quantity < Quantity::id, quantity);
    return number[static_cast<std::size_t>(quantity)];
  }
};

/// Makes particles from the columns of a file, the same way for every format: checks values, finds materials, notes
/// faults (a limited number of them) and which columns were not used.
class ParticleRows {
 public:
  ParticleRows(const ParticleFileRules& rules, std::string name, bool only_count, Findings& findings,
               std::vector<Finding>& warnings);

  const ParticleFileRules& rules() const { return rules_; }

  /// Sets how the file refers to materials; without this call, by name alone. To be called before set_columns.
  void set_labels(MaterialLabels labels) {
    HOOKE_ASSERT(columns_.empty(), columns_.size());
    labels_ = std::move(labels);
    find_numbered();
  }
  /// From now on places are bytes, not lines.
  void set_binary() { out_.binary = true; }
  /// Sets the columns of every row. False, with findings at `place`, where particles can't be made from them.
  bool set_columns(std::vector<Column> columns, std::uint64_t place);
  /// Sets the box that the file gives its particles.
  void set_box(const FileBox& box) { out_.box = box; }
  /// Notes a column of the file that is not read.
  void ignore(std::string title) { ignored_.push_back(std::move(title)); }
  /// `count`: rows that the file states; `most`: rows that its size allows. False where only the number is wanted.
  [[nodiscard]] bool expect(std::uint64_t count, std::uint64_t most);
  std::uint64_t expected() const { return expected_; }

  /// A row with no values read yet.
  Row blank() const { return blank_; }
  /// Reads one value into `row`. False, with a finding, where the value is not valid.
  bool read(Quantity quantity, std::string_view title, std::string_view text, Row& row, std::uint64_t place);
  bool read(Quantity quantity, std::string_view title, double value, Row& row, std::uint64_t place);
  /// Reads a row of one text per column. False, with findings, where a value is not valid.
  bool read(std::span<const std::string_view> texts, Row& row, std::uint64_t place);
  /// Adds a row whose columns have all been read.
  void add(const Row& row, std::uint64_t place);
  /// Sets the velocity of the particle `id`, for files in which velocities follow the particles.
  void set_velocity(std::uint64_t id, const Vec3d& velocity, std::uint64_t place);

  /// Notes a fault after which reading continues.
  void complain(std::uint64_t place, std::string message);
  /// Notes the fault that ended the reading.
  void give_up(const FileFault& fault);
  /// Returns all particles and adds the warnings about them; a finding where there are none.
  FileParticles finish();

 private:
  // How far a column differs from what the materials say.
  struct Difference {
    std::uint64_t rows = 0;
    double worst = 0;  // relative
    double value = 0;
    std::uint16_t material = 0;
    std::uint64_t place = 0;
  };

  // Complains unless `axes` of the header's columns are x, y and z.
  bool has_axes(const std::array<bool, 3>& axes, const std::vector<std::string>& titles, std::uint64_t place);
  bool read_material(std::string_view label, std::uint16_t& index, std::uint64_t place);
  std::optional<std::uint16_t> find_material(std::string_view label) const;
  std::optional<std::uint16_t> find_number(std::uint64_t number) const;
  std::optional<std::uint16_t> find_name(std::string_view name) const;
  std::optional<std::uint16_t> find_exactly(std::string_view name) const;
  void find_numbered();
  std::string unknown_material(std::string_view label) const;
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
  std::unordered_map<std::string_view, std::uint16_t> by_name_;  // of the scene
  std::map<std::uint64_t, std::optional<std::uint16_t>> numbered_;  // what labels_.names comes to
  std::uint64_t expected_ = 0;
  bool has_id_ = false;
  Row blank_;
  std::string last_label_;
  std::optional<std::uint16_t> last_material_;
  Difference radius_;
  Difference mass_;
  bool gave_up_ = false;
  std::uint64_t said_ = 0;
  std::uint64_t held_back_ = 0;
  std::vector<std::pair<std::uint64_t, std::size_t>> by_id_;  // id and row, sorted, for velocities out of order
  std::size_t next_velocity_ = 0;
};

}  // namespace hooke::scene
