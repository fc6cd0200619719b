// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/particle_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>

#include "hooke/scene/available_memory.h"
#include "hooke/scene/json_path.h"
#include "hooke/scene/particle_source.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/scene_path.h"
#include "hooke/scene/source_slices.h"
#include "hooke/scene/spelling.h"

namespace hooke::scene {
namespace {

constexpr const char* kTies[] = {"cloths", "bodies", "springs"};
constexpr std::size_t kMostFindings = 20;  // of one kind, about the particles of one source
constexpr double kBytesPerHeldParticle = 120;  // on the host, and once more while its columns grow

// The range of one source's particles among all particles.
struct Span {
  const ParticleSource* source;
  std::size_t begin;
  std::size_t end;
  std::vector<std::uint64_t> places;  // in the source's file
  bool binary = false;                // places are bytes, not lines

  std::string where(std::size_t particle) const {
    return places.empty() ? source->path : place_in_file(source->file_name, places[particle - begin], binary);
  }
};

// Whether the scene has what is tied to particles by their ids.
bool ties_particles(const Json& json) {
  return std::any_of(std::begin(kTies), std::end(kTies), [&json](const char* key) {
    const auto entries = json.find(key);
    return entries != json.end() && !entries->empty();
  });
}

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
      // An entry with both a block and a file, for example, still has a material to check.
      if (entries[i].is_object()) plan_source(entries[i], path);
    }
  }

  // Whether there is memory for the planned particles: for this machine's share of them, and for those that are held
  // as a whole, all or the largest source, while others get theirs.
  bool fits(bool holds_all) {
    double particles = 0, held = 0;
    for (const ParticleSource& source : sources_) {
      const double count = expected_count(source);
      particles += count;
      if (!is_lattice(source)) held = std::max(held, count);
    }
    if (holds_all) held = particles;
    const std::uint64_t limit = options_.memory_limit != 0 ? options_.memory_limit : available_memory();
    const double share = options_.share_here;
    const double needed = particles * kBytesPerParticle * share + held * kBytesPerHeldParticle * (1 - share);
    if (limit == 0 || needed <= static_cast<double>(limit)) return true;
    findings_.add("particles", fmt::format("are about {:.0f} and need about {} of memory; {} are available", particles,
                                           in_bytes(needed), in_bytes(static_cast<double>(limit))));
    return false;
  }

  // Null where only the whole set will do.
  std::shared_ptr<const ParticleSlices> make_slices() {
    if (!findings_.empty()) return nullptr;
    auto slices = std::make_shared<SourceSlices>(scene_, sources_);
    return slices->prepare(options_, warnings_) ? slices : nullptr;
  }

  ParticleSet make() {
    for (const ParticleSource& source : sources_) {
      if (source.block) {
        append_block(source);
      } else if (source.cluster) {
        append_cluster(source);
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
    ParticleSource source;
    source.path = path;
    source.rules.materials = scene_.materials;
    plan_material(entry, source);
    plan_types_and_frame(entry, source);
    const bool is_block = entry.contains("block");
    const bool is_cluster = entry.contains("cluster");
    if ((is_block || is_cluster) && !entry.contains("file") && !entry.contains("material")) {
      findings_.add(join_path(path, "material"),
                    fmt::format("is missing; must be one of the scene's materials: {}", quoted_list(names_)));
    }
    if (entry.contains("file") && !findings_.touches(join_path(path, "file"))) plan_file(entry.at("file"), source);
    if (is_block && !findings_.touches(join_path(path, "block")) && domain_known_)
      plan_block(entry.at("block"), source);
    if (is_cluster && !findings_.touches(join_path(path, "cluster"))) plan_cluster(entry.at("cluster"), source);
    if (findings_.touches(path)) return;
    source.rules.velocity = vec3_or(entry.at("velocity"), {});
    if (source.block || source.cluster || !source.file.empty()) sources_.push_back(std::move(source));
  }

  // Index of the material of this name; a finding at `where` where the scene has no such material.
  std::optional<std::uint16_t> material_named(const std::string& name, const std::string& where) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) {
      const auto index = static_cast<std::size_t>(found - names_.begin());
      if (scene_.materials[index].is_of_particles()) return static_cast<std::uint16_t>(index);
      findings_.add(where, fmt::format("is \"{}\", which has neither radius nor mass: only colliders may have it",
                                       printable(name, 60)));
      return std::nullopt;
    }
    if (findings_.overflows()) return std::nullopt;  // the likeliest name is dear to find
    const std::string hint = did_you_mean(name, names_);
    findings_.add(where, fmt::format("is \"{}\", which is no material{}{} the scene has {}", printable(name, 60), hint,
                                     hint.empty() ? ";" : "", quoted_list(names_)));
    return std::nullopt;
  }

  void plan_material(const Json& entry, ParticleSource& source) {
    const std::string where = join_path(source.path, "material");
    if (!entry.contains("material") || findings_.touches(where)) return;
    source.rules.material = material_named(entry.at("material").get_ref<const std::string&>(), where);
  }

  // Keys that only files have.
  void plan_types_and_frame(const Json& entry, ParticleSource& source) {
    for (const char* key : {"types", "frame"}) {
      if (entry.contains(key) && !entry.contains("file")) {
        findings_.add(join_path(source.path, key), "is of no use without \"file\"");
      }
    }
    const std::string types = join_path(source.path, "types");
    if (entry.contains("types") && !findings_.touches(types)) {
      for (const auto& type : entry.at("types").items()) {
        const auto material = material_named(type.value().get_ref<const std::string&>(), join_path(types, type.key()));
        if (material) source.rules.types.emplace(type.key(), *material);
      }
    }
    if (!entry.contains("frame") || findings_.touches(join_path(source.path, "frame"))) return;
    const Json& frame = entry.at("frame");
    source.rules.frame = frame.is_string() ? kLastFrame : frame.get<std::uint64_t>();
  }

  void plan_file(const std::string& name, ParticleSource& source) {
    source.file_name = printable(name);
    const auto complain = [&](const char* key, const std::string& message) {
      findings_.add(join_path(source.path, key), message);
    };
    if (options_.with_particles) {
      auto file = find_scene_file(folder_, name, options_.allow_outside);
      if (!file) {
        return complain("file", fmt::format("is \"{}\": {}", source.file_name, file.error().findings.front().message));
      }
      source.file = std::move(*file);
    }
    const auto format = particle_file_format(name);
    if (!format) {
      std::vector<std::string> known;
      for (const ParticleFileFormat& f : particle_file_formats()) {
        known.insert(known.end(), f.extensions.begin(), f.extensions.end());
      }
      complain("file", fmt::format("is \"{}\": its extension names no format of particles; known are {}",
                                   source.file_name, quoted_list(known)));
    } else if (!format->has_frames && source.rules.frame.value_or(0) != 0 && source.rules.frame != kLastFrame) {
      complain("frame",
               fmt::format("is {}; a {} file holds one snapshot, 0", *source.rules.frame, format->extensions.front()));
    }
  }

  void plan_block(const Json& json, ParticleSource& source) {
    const std::string path = join_path(source.path, "block");
    // A block with a count ends one radius from the domain's faces: without a valid radius nothing can be planned.
    if (!source.rules.material || findings_.touches(join_path("materials", names_[*source.rules.material]))) return;
    source.block = read_block(json, path, scene_, scene_.materials[*source.rules.material].radius, findings_);
    if (source.block && source.block->lattice == "random" && json.at("jitter") != 0) {
      warnings_.push_back({join_path(path, "jitter"), "is passed over: a random block keeps its centres apart"});
    }
  }

  void plan_cluster(const Json& json, ParticleSource& source) {
    if (!source.rules.material || findings_.touches(join_path("materials", names_[*source.rules.material]))) return;
    const ClusterSource cluster = read_cluster(json);
    if (dot(cluster.normal, cluster.normal) > 0) {
      source.cluster = cluster;
    } else {
      findings_.add(join_path(join_path(source.path, "cluster"), "normal"), "is [0,0,0], which has no direction");
    }
  }

  void append_cluster(const ParticleSource& source) {
    ClusterParticles made =
        make_cluster(*source.cluster, scene_.materials[*source.rules.material].mass, scene_.attraction);
    for (Vec3d& v : made.velocity) v += source.rules.velocity;
    const Span span{&source, particles_.size(), particles_.size() + made.position.size(), {}};
    particles_.position.insert(particles_.position.end(), made.position.begin(), made.position.end());
    append_common(span, std::vector<std::uint16_t>(made.position.size(), *source.rules.material), made.velocity, {});
  }

  void append_block(const ParticleSource& source) {
    const std::vector<Vec3d> centres = block_centres(*source.block, scene_.domain, findings_);
    const Span span{&source, particles_.size(), particles_.size() + centres.size(), {}};
    particles_.position.insert(particles_.position.end(), centres.begin(), centres.end());
    append_common(span, std::vector<std::uint16_t>(centres.size(), *source.rules.material),
                  std::vector<Vec3d>(centres.size(), source.rules.velocity), {});
  }

  void append_file(const ParticleSource& source) {
    FileParticles read = read_particle_file(source.file, source.file_name, source.rules, findings_, warnings_);
    if (read.box && domain_known_) check_box(*read.box, source.file_name, scene_.domain, findings_, warnings_);
    Span span{&source, particles_.size(), particles_.size() + read.position.size(), std::move(read.place), read.binary};
    particles_.position.insert(particles_.position.end(), read.position.begin(), read.position.end());
    append_common(std::move(span), read.material, read.velocity, read.id);
  }

  // Appends everything but the positions, which are in place. Particles without ids of their own get the next ones.
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

  void refuse_outside(const Span& span) {
    std::size_t outside = 0;
    const auto text = [](const Vec3d& x) { return fmt::format("[{}, {}, {}]", x.x, x.y, x.z); };
    // A block is one thing to correct, but the rows of a file are many.
    const std::size_t most = span.places.empty() ? 1 : kMostFindings;
    for (std::size_t i = span.begin; i < span.end; ++i) {
      if (can_start_at(scene_.domain, particles_.position[i]) || ++outside > most) continue;
      const Vec3d& x = particles_.position[i];
      complain(
          span, span.where(i),
          fmt::format(
              "centre {} is outside the domain {} to {}{}", text(x), text(scene_.domain.min), text(scene_.domain.max),
              is_on_periodic_face(scene_.domain, x) ? "; the upper face of a periodic axis is its lower one" : ""));
    }
    if (outside > most) {
      complain(span, span.places.empty() ? span.source->path : span.source->file_name,
               fmt::format("{} of {} centres are outside the domain", outside, span.end - span.begin));
    }
  }

  // Findings about a block refer to the scene's text, findings about a file to the file's text.
  void complain(const Span& span, const std::string& where, std::string message) {
    if (span.places.empty()) {
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
  std::vector<ParticleSource> sources_;
  std::vector<Span> spans_;
  ParticleSet particles_;
  std::uint64_t largest_id_ = 0;
};

}  // namespace

double expected_count(const ParticleSource& source) {
  return source.block     ? expected_count(*source.block)
         : source.cluster ? static_cast<double>(source.cluster->count)
                          : static_cast<double>(count_particles(source.file, source.rules));
}

ParticleSet load_particles(const Json& json, const Scene& scene, const std::filesystem::path& folder,
                           const LoadOptions& options, Findings& findings, std::vector<Finding>& warnings,
                           std::shared_ptr<const ParticleSlices>& slices) {
  const auto entries = json.find("particles");
  if (entries == json.end() || !entries->is_array()) return {};
  Loader loader(scene, folder, options, findings, warnings);
  loader.plan(*entries);
  const bool in_slices = options.in_slices && !ties_particles(json);
  if (!options.with_particles || !loader.fits(!in_slices)) return {};
  if (in_slices) {
    slices = loader.make_slices();
    if (slices) return {};
  }
  return loader.make();
}

}  // namespace hooke::scene
