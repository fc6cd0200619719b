// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/particle_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "hooke/scene/available_memory.h"
#include "hooke/scene/block_source.h"
#include "hooke/scene/csv_particles.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/nearest.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/scene_path.h"
#include "hooke/scene/text_file.h"

namespace hooke {
namespace {

constexpr std::size_t kMostFindings = 20;  // of one kind about the particles of one source

// One entry of "particles", looked at but not yet made.
struct Source {
  std::string path;  // in the scene: "particles[0]"
  std::optional<std::uint16_t> material;
  Vec3d velocity{0, 0, 0};
  std::optional<BlockSource> block;
  std::string file_name;  // as the scene writes it
  std::filesystem::path file;
};

// Where the particles of one source lie among all.
struct Span {
  const Source* source;
  std::size_t begin;
  std::size_t end;
  std::vector<std::uint32_t> lines;  // in the source's file

  std::string where(std::size_t particle) const {
    return lines.empty() ? source->path : fmt::format("{}:{}", source->file_name, lines[particle - begin]);
  }
};

class Loader {
 public:
  Loader(const Scene& scene, const std::filesystem::path& folder, const LoadOptions& options, Findings& findings,
         std::vector<Finding>& warnings)
      : scene_(scene),
        folder_(folder),
        options_(options),
        findings_(findings),
        warnings_(warnings) {
    for (const Material& m : scene.materials) names_.push_back(m.name);
    domain_known_ = !findings.touches("domain") && !findings.touches("gravity");
  }

  void plan(const Json& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::string path = join_path("particles", i);
      // An entry with both a block and a file, say, still has a material to be looked at.
      if (entries[i].is_object()) plan_source(entries[i], path);
    }
  }

  // Whether there is memory for what is planned.
  bool fits() {
    double particles = 0;
    for (const Source& source : sources_) {
      particles += source.block ? expected_count(*source.block) : static_cast<double>(count_lines(source.file));
    }
    const std::uint64_t limit = options_.memory_limit != 0 ? options_.memory_limit : available_memory();
    const double needed = particles * kBytesPerParticle;
    if (limit == 0 || needed <= static_cast<double>(limit)) return true;
    findings_.add("particles", fmt::format("are about {:.0f} and need about {} of memory; {} are available", particles,
                                           in_bytes(needed), in_bytes(static_cast<double>(limit))));
    return false;
  }

  ParticleSet make() {
    for (const Source& source : sources_) {
      if (source.block) {
        append_block(source);
      } else {
        append_file(source);
      }
    }
    refuse_doubled_ids();
    particles_.sort_by_id();
    return std::move(particles_);
  }

 private:
  void plan_source(const Json& entry, const std::string& path) {
    Source source;
    source.path = path;
    plan_material(entry, source);
    const bool is_block = entry.contains("block");
    if (is_block && !entry.contains("file") && !entry.contains("material")) {
      findings_.add(join_path(path, "material"),
                    fmt::format("is missing; must be one of the scene's materials: {}", quoted_list(names_)));
    }
    if (entry.contains("file") && !findings_.touches(join_path(path, "file"))) plan_file(entry.at("file"), source);
    if (is_block && !findings_.touches(join_path(path, "block")) && domain_known_)
      plan_block(entry.at("block"), source);
    if (findings_.touches(path)) return;
    source.velocity = vec3_or(entry.at("velocity"), {});
    if (source.block || !source.file.empty()) sources_.push_back(std::move(source));
  }

  void plan_material(const Json& entry, Source& source) {
    const std::string where = join_path(source.path, "material");
    if (!entry.contains("material") || findings_.touches(where)) return;
    const std::string& name = entry.at("material").get_ref<const std::string&>();
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) {
      const std::string hint = did_you_mean(name, names_);
      findings_.add(where, fmt::format("is \"{}\", which is no material{}{} the scene has {}", printable(name, 60),
                                       hint, hint.empty() ? ";" : "", quoted_list(names_)));
      return;
    }
    source.material = static_cast<std::uint16_t>(found - names_.begin());
  }

  void plan_file(const std::string& name, Source& source) {
    if (!options_.with_particles) return;
    source.file_name = printable(name);
    auto file = find_scene_file(folder_, name, options_.allow_outside);
    if (file) {
      source.file = std::move(*file);
    } else {
      findings_.add(join_path(source.path, "file"),
                    fmt::format("is \"{}\": {}", source.file_name, file.error().findings.front().message));
    }
  }

  void plan_block(const Json& json, Source& source) {
    const std::string path = join_path(source.path, "block");
    // A block with a count ends one radius from the domain's faces: without a good radius there is nothing to plan.
    if (!source.material || findings_.touches(join_path("materials", names_[*source.material]))) return;
    source.block = read_block(json, path, scene_, scene_.materials[*source.material].radius, findings_);
    if (source.block && source.block->lattice == "random" && json.at("jitter") != 0) {
      warnings_.push_back({join_path(path, "jitter"), "is passed over: a random block keeps its centres apart"});
    }
  }

  void append_block(const Source& source) {
    const std::vector<Vec3d> centres = block_centres(*source.block, scene_.domain, findings_);
    const Span span{&source, particles_.size(), particles_.size() + centres.size(), {}};
    particles_.position.insert(particles_.position.end(), centres.begin(), centres.end());
    append_common(span, std::vector<std::uint16_t>(centres.size(), *source.material),
                  std::vector<Vec3d>(centres.size(), source.velocity), {});
  }

  void append_file(const Source& source) {
    CsvParticles rows =
        read_csv_particles(source.file, source.file_name, {names_, source.material, source.velocity}, findings_);
    if (!rows.ignored_columns.empty()) {
      warnings_.push_back({source.file_name, fmt::format("columns that Hooke does not read are ignored: {}",
                                                         quoted_list(rows.ignored_columns))});
    }
    Span span{&source, particles_.size(), particles_.size() + rows.position.size(), std::move(rows.line)};
    particles_.position.insert(particles_.position.end(), rows.position.begin(), rows.position.end());
    append_common(std::move(span), rows.material, rows.velocity, rows.id);
  }

  // Everything but the positions, which are in place. Without ids of their own, particles number on.
  void append_common(Span span, const std::vector<std::uint16_t>& material, const std::vector<Vec3d>& velocity,
                     const std::vector<std::uint64_t>& id) {
    particles_.material.insert(particles_.material.end(), material.begin(), material.end());
    particles_.velocity.insert(particles_.velocity.end(), velocity.begin(), velocity.end());
    if (id.empty()) {
      particles_.id.resize(span.end);
      std::iota(particles_.id.begin() + static_cast<std::ptrdiff_t>(span.begin), particles_.id.end(), largest_id_ + 1);
      largest_id_ += span.end - span.begin;
    } else {
      particles_.id.insert(particles_.id.end(), id.begin(), id.end());
      largest_id_ = std::max(largest_id_, *std::max_element(id.begin(), id.end()));
    }
    if (domain_known_) refuse_outside(span);
    spans_.push_back(std::move(span));
  }

  // The two faces of a periodic axis are the same place; it belongs to the lower one.
  bool is_on_periodic_face(const Vec3d& x) const {
    for (int axis = 0; axis < 3; ++axis) {
      const bool periodic = scene_.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic;
      if (periodic && component(x, axis) == component(scene_.domain.max, axis)) return true;
    }
    return false;
  }

  bool is_inside(const Vec3d& x) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = component(x, axis);
      if (!(value >= component(scene_.domain.min, axis) && value <= component(scene_.domain.max, axis))) return false;
    }
    return !is_on_periodic_face(x);
  }

  void refuse_outside(const Span& span) {
    std::size_t outside = 0;
    const auto text = [](const Vec3d& x) { return fmt::format("[{}, {}, {}]", x.x, x.y, x.z); };
    // A block is one thing to correct, a file's rows are many.
    const std::size_t most = span.lines.empty() ? 1 : kMostFindings;
    for (std::size_t i = span.begin; i < span.end; ++i) {
      if (is_inside(particles_.position[i]) || ++outside > most) continue;
      const Vec3d& x = particles_.position[i];
      complain(span, span.where(i),
               fmt::format("centre {} is outside the domain {} to {}{}", text(x), text(scene_.domain.min),
                           text(scene_.domain.max),
                           is_on_periodic_face(x) ? "; the upper face of a periodic axis is its lower one" : ""));
    }
    if (outside > most) {
      complain(span, span.lines.empty() ? span.source->path : span.source->file_name,
               fmt::format("{} of {} centres are outside the domain", outside, span.end - span.begin));
    }
  }

  // A block's findings are about the scene's text, a file's about a text of its own.
  void complain(const Span& span, const std::string& where, std::string message) {
    if (span.lines.empty()) {
      findings_.add(where, std::move(message));
    } else {
      findings_.add_elsewhere(where, std::move(message));
    }
  }

  void refuse_doubled_ids() {
    const auto& id = particles_.id;
    if (std::adjacent_find(id.begin(), id.end(), std::greater_equal<>()) == id.end()) return;
    std::vector<std::size_t> order(id.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&id](std::size_t a, std::size_t b) { return id[a] < id[b]; });
    std::size_t doubled = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (id[order[i]] != id[order[i - 1]] || ++doubled > kMostFindings) continue;
      const Span& second = span_of(order[i]);
      const Span& first = span_of(order[i - 1]);
      complain(second, second.where(order[i]),
               fmt::format("id {} is taken, by {}", id[order[i]], first.where(order[i - 1])));
    }
    if (doubled > kMostFindings) {
      findings_.add("particles", fmt::format("{} ids are given more than once", doubled));
    }
  }

  const Span& span_of(std::size_t particle) const {
    return *std::find_if(spans_.begin(), spans_.end(), [particle](const Span& s) { return particle < s.end; });
  }

  const Scene& scene_;
  const std::filesystem::path& folder_;
  const LoadOptions& options_;
  Findings& findings_;
  std::vector<Finding>& warnings_;
  std::vector<std::string> names_;
  bool domain_known_;
  std::vector<Source> sources_;
  std::vector<Span> spans_;
  ParticleSet particles_;
  std::uint64_t largest_id_ = 0;
};

}  // namespace

ParticleSet load_particles(const Json& json, const Scene& scene, const std::filesystem::path& folder,
                           const LoadOptions& options, Findings& findings, std::vector<Finding>& warnings) {
  const auto entries = json.find("particles");
  if (entries == json.end() || !entries->is_array()) return {};
  Loader loader(scene, folder, options, findings, warnings);
  loader.plan(*entries);
  if (!options.with_particles || !loader.fits()) return {};
  return loader.make();
}

}  // namespace hooke
