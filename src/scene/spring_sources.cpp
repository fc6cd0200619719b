// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The scene's "springs": pairs of ids, in the scene or in CSV files.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "hooke/scene/csv_fields.h"
#include "hooke/scene/file_scanner.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/scene_path.h"
#include "hooke/scene/spelling.h"
#include "hooke/scene/structure_maker.h"

namespace hooke::scene {
namespace {

constexpr std::size_t kMostFindings = 20;  // of one kind
constexpr double kInitial = -1;            // rest length: the distance at the start

SpringMode mode_of(const Json& name) {
  return name == "compression" ? SpringMode::compression
         : name == "extension" ? SpringMode::extension
                               : SpringMode::both;
}

// Adds springs one by one and notes their faults.
class SpringReader {
 public:
  explicit SpringReader(StructureMaker& maker) : maker_(maker), before_(maker.structure.springs.size()) {}

  void read(const Json& entry, const std::string& path) {
    Spring spring;
    spring.stiffness = entry.at("stiffness").get<double>();
    spring.damping = entry.at("damping").get<double>();
    spring.rest_length = entry.at("rest_length").is_number() ? entry.at("rest_length").get<double>() : kInitial;
    spring.break_strain = break_strain_of(entry);
    spring.mode = mode_of(entry.at("mode"));
    spring.contact = entry.at("contact").get<bool>();
    sources_.push_back({path, "", maker_.structure.springs.size(), {}});
    if (entry.contains("pairs")) {
      const Json& pairs = entry.at("pairs");
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        spring.a = pairs[k][0].get<std::uint64_t>();
        spring.b = pairs[k][1].get<std::uint64_t>();
        add(spring, k);
      }
    } else {
      read_file(entry.at("file").get_ref<const std::string&>(), path, spring);
    }
  }

  // Refuses two springs between the same particles.
  void refuse_twins() {
    const SpringSet& s = maker_.structure.springs;
    struct Pair {
      std::uint64_t low, high;
      std::size_t index;
      auto operator<=>(const Pair&) const = default;
    };
    std::vector<Pair> pairs(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) pairs[i] = {std::min(s.a[i], s.b[i]), std::max(s.a[i], s.b[i]), i};
    std::sort(pairs.begin(), pairs.end());
    std::size_t twins = 0;
    for (std::size_t k = 1; k < pairs.size(); ++k) {
      const Pair &first = pairs[k - 1], &second = pairs[k];
      if (first.low != second.low || first.high != second.high || ++twins > kMostFindings) continue;
      const std::string other = first.index < before_ ? "a cloth or body" : where(first.index);
      complain(second.index,
               fmt::format("ties particles {} and {}, which {} does", s.a[second.index], s.b[second.index], other));
    }
    if (twins > kMostFindings) maker_.findings.add("springs", fmt::format("{} pairs are tied more than once", twins));
  }

 private:
  struct Source {
    std::string path, file;
    std::size_t begin;                 // its first spring
    std::vector<std::uint64_t> place;  // of each spring, in its list or file
  };

  std::string where(std::size_t spring) const {
    const auto after =
        std::find_if(sources_.begin(), sources_.end(), [=](const Source& s) { return spring < s.begin; });
    const Source& source = *(after - 1);
    const std::uint64_t place = source.place[spring - source.begin];
    return source.file.empty() ? join_path(join_path(source.path, "pairs"), place)
                               : fmt::format("{}:{}", source.file, place);
  }

  void complain(std::size_t spring, std::string message) { complain_at(where(spring), std::move(message)); }
  void complain_at(const std::string& where, std::string message) {
    if (sources_.back().file.empty()) {
      maker_.findings.add(where, std::move(message));
    } else {
      maker_.findings.add_elsewhere(where, std::move(message));
    }
  }

  void add(Spring spring, std::uint64_t place) {
    sources_.back().place.push_back(place);
    maker_.structure.springs.push_back(spring);
    const std::size_t index = maker_.structure.springs.size() - 1;
    std::string fault;
    for (const std::uint64_t id : {spring.a, spring.b}) {
      if (fault.empty() && maker_.particles.find(id) == maker_.particles.size()) {
        fault = fmt::format("names particle {}; there is none of this id", id);
      }
    }
    if (fault.empty() && spring.a == spring.b) fault = fmt::format("ties particle {} to itself", spring.a);
    if (fault.empty() && spring.rest_length == kInitial) {
      const double length = maker_.distance(spring.a, spring.b);
      if (!(length > 0)) fault = fmt::format("ties particles {} and {}, which are in one place", spring.a, spring.b);
      maker_.structure.springs.rest_length[index] = length;
    }
    if (!fault.empty() && ++faults_ <= kMostFindings) complain(index, std::move(fault));
  }

  void read_file(const std::string& name, const std::string& path, const Spring& common) {
    sources_.back().file = printable(name);
    const auto file = find_scene_file(maker_.folder, name, maker_.options.allow_outside);
    if (!file) {
      maker_.findings.add(join_path(path, "file"),
                          fmt::format("is \"{}\": {}", printable(name), file.error().findings.front().message));
      return;
    }
    try {
      read_rows(*file, common);
    } catch (const FileFault& fault) {
      maker_.findings.add_elsewhere(
          fault.place() > 0 ? fmt::format("{}:{}", printable(name), fault.place()) : printable(name), fault.what());
    }
  }

  void read_rows(const std::filesystem::path& file, const Spring& common) {
    FileScanner in(file);
    const std::string header(in.line().value_or(""));
    CsvFields fields;
    fields.split(header);
    const auto column = [&](std::string_view title) {
      return static_cast<std::size_t>(std::find(fields.at.begin(), fields.at.end(), title) - fields.at.begin());
    };
    const std::size_t width = fields.at.size(), a = column("a"), b = column("b");
    const std::size_t numbers[] = {column("rest_length"), column("stiffness"), column("damping")};
    if (a == width || b == width) throw FileFault(1, "has no columns a and b; a header must name them");
    while (const auto line = in.line()) {
      if (trimmed(*line).empty()) continue;
      fields.split(*line);
      Spring spring = common;
      const auto refuse = [&](const std::string& why) {
        if (++faults_ <= kMostFindings) complain_at(fmt::format("{}:{}", sources_.back().file, in.line_number()), why);
      };
      if (fields.at.size() != width) {
        refuse(fmt::format("has {} fields; the header has {}", fields.at.size(), width));
        continue;
      }
      if (!read_count(fields.at[a], spring.a) || !read_count(fields.at[b], spring.b)) {
        refuse(fmt::format("a and b are \"{}\" and \"{}\"; both must be ids", printable(fields.at[a], 40),
                           printable(fields.at[b], 40)));
        continue;
      }
      double* const values[] = {&spring.rest_length, &spring.stiffness, &spring.damping};
      constexpr const char* kTitles[] = {"rest_length", "stiffness", "damping"};
      bool good = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if (numbers[k] == width) continue;
        const bool number = read_number(fields.at[numbers[k]], *values[k]);
        if (number && (k == 0 ? *values[k] > 0 : *values[k] >= 0)) continue;
        refuse(fmt::format("{} is \"{}\"; must be a number {}", kTitles[k], printable(fields.at[numbers[k]], 40),
                           k == 0   ? "> 0 (m)"
                           : k == 1 ? ">= 0 (N/m)"
                                    : ">= 0 (N s/m)"));
        good = false;
      }
      if (good) add(spring, in.line_number());
    }
  }

  StructureMaker& maker_;
  std::size_t before_;  // springs from other sections
  std::vector<Source> sources_;
  std::size_t faults_ = 0;
};

}  // namespace

void StructureMaker::add_springs(const Json& springs) {
  SpringReader reader(*this);
  bool any = false;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const std::string path = join_path("springs", i);
    if (!springs[i].is_object() || findings.touches(path) || !options.with_particles) continue;
    reader.read(springs[i], path);
    end_group(path);
    any = true;
  }
  if (any) reader.refuse_twins();
}

}  // namespace hooke::scene
