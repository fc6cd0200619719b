// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "lammps_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "source_dir.h"

namespace hooke::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

int significant_digits(const std::string& number) {
  int digits = 0;
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if (c >= '0' && c <= '9' && (digits > 0 || c != '0')) ++digits;
  }
  return digits;
}

bool is_file_of_an_instant(const fs::directory_entry& entry) {
  return entry.path().filename().string().starts_with("expected_step");
}

// Consecutive rows of the same step, as instants.
std::vector<ExpectedInstant> instants_of(const Table& table) {
  std::vector<ExpectedInstant> instants;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto step = static_cast<std::int64_t>(table.at(row, "step"));
    if (instants.empty() || instants.back().step != step) instants.push_back({step, {}, {}, {}});
    ExpectedInstant& now = instants.back();
    now.id.push_back(static_cast<std::uint64_t>(table.at(row, "id")));
    now.position.push_back({table.at(row, "x"), table.at(row, "y"), table.at(row, "z")});
    now.velocity.push_back({table.at(row, "vx"), table.at(row, "vy"), table.at(row, "vz")});
  }
  return instants;
}

}  // namespace

bool Table::has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::size_t Table::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::runtime_error("no column " + name);
  return static_cast<std::size_t>(found - columns.begin());
}

double Table::rounding(double value) const { return digits >= 15 ? 0 : 5 * std::abs(value) * std::pow(10.0, -digits); }

Table read_table(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("can't open " + file.string());
  Table table;
  std::string line;
  std::getline(in, line);
  table.columns = split(line);
  while (std::getline(in, line)) {
    std::vector<double> row;
    for (const std::string& cell : split(line)) {
      row.push_back(std::strtod(cell.c_str(), nullptr));
      table.digits = std::max(table.digits, significant_digits(cell));
    }
    if (row.size() != table.columns.size()) throw std::runtime_error(file.string() + ": a row of another length");
    table.rows.push_back(std::move(row));
  }
  return table;
}

scene::LoadedScene LammpsCase::load(const std::vector<std::string>& overrides) const {
  scene::LoadOptions options;
  options.overrides = overrides;
  auto loaded = scene::load_scene(folder / "scene.json", options);
  if (!loaded) throw std::runtime_error(loaded.error().text());
  return std::move(*loaded);
}

bool LammpsCase::has_instants() const {
  return has("expected.csv") ||
         std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), is_file_of_an_instant);
}

std::size_t LammpsCase::particle_count() const {
  std::ifstream in(folder / "initial.csv");
  if (!in) throw std::runtime_error("can't open initial.csv in " + folder.string());
  std::size_t lines = 0;
  for (std::string line; std::getline(in, line);) ++lines;
  return lines - 1;
}

std::vector<std::pair<ExpectedInstant, Table>> LammpsCase::instants(const std::string& file) const {
  std::vector<std::pair<ExpectedInstant, Table>> all;
  const auto take = [&](const fs::path& path) {
    const Table table = read_table(path);
    Table kind{table.columns, {}, table.digits};
    for (ExpectedInstant& instant : instants_of(table)) all.emplace_back(std::move(instant), kind);
  };
  if (has(file)) {
    take(folder / file);
  } else if (file == "expected.csv") {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (is_file_of_an_instant(entry)) take(entry.path());
    }
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first.step < b.first.step; });
  return all;
}

std::map<std::int64_t, double> LammpsCase::deviations(const std::string& what) const {
  std::ifstream in(folder / "README.md");
  const std::regex entry(R"((\d+): ([0-9.]+e[-+][0-9]+))");
  std::map<std::int64_t, double> by_step;
  for (std::string line; std::getline(in, line);) {
    const bool largest = line.starts_with("Max |dx|") || line.starts_with("Perturbed start");
    if (!largest || line.find(what) == std::string::npos) continue;
    for (auto it = std::sregex_iterator(line.begin(), line.end(), entry); it != std::sregex_iterator(); ++it) {
      by_step[std::stoll((*it)[1])] = std::stod((*it)[2]);
    }
  }
  return by_step;
}

std::vector<LammpsCase> lammps_cases() {
  const fs::path source = HOOKE_SOURCE_DIR;
  fs::path all = source / ".." / "shared" / "reference" / "lammps";
  if (!fs::is_directory(all)) all = source / "tests" / "reference" / "lammps";
  std::vector<LammpsCase> cases;
  for (const auto& entry : fs::directory_iterator(all)) {
    if (!fs::exists(entry.path() / "scene.json")) continue;
    cases.push_back({entry.path().filename().string(), entry.path()});
  }
  std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return cases;
}

}  // namespace hooke::test
