// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/load_scene.h"

#include <exception>
#include <new>

#include "hooke/scene/default_warnings.h"
#include "hooke/scene/findings.h"
#include "hooke/scene/json_reader.h"
#include "hooke/scene/overlap_check.h"
#include "hooke/scene/overrides.h"
#include "hooke/scene/particle_sources.h"
#include "hooke/scene/scene_builder.h"
#include "hooke/scene/schema.h"
#include "hooke/scene/schema_check.h"
#include "hooke/scene/structure_maker.h"
#include "hooke/scene/text_file.h"

namespace hooke::scene {
namespace {

Expected<LoadedScene> parse(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                            const LoadOptions& options) {
  Findings findings(name);
  const auto refuse = [&findings] { return fail(Error{Error::Kind::bad_input, findings.take()}); };

  JsonReading reading = read_json(text, name);
  findings.set_text(reading.readable.empty() ? text : reading.readable);
  for (auto& [path, message] : reading.faults) findings.add(path, std::move(message));
  if (reading.stopped) findings.add_elsewhere(reading.stopped->where, reading.stopped->message);
  if (!reading.value) return refuse();
  Json& json = *reading.value;

  apply_overrides(options.overrides, json, findings);
  check_against_schema(json, findings);
  if (!json.is_object() || findings.overflows()) return refuse();
  fill_defaults(schema_root(), json);

  LoadedScene loaded;
  build_scene(json, folder, options, findings, loaded);
  loaded.particles = load_particles(json, loaded.scene, folder, options, findings, loaded.warnings, loaded.slices);
  LoadOptions ties = options;
  ties.with_particles = options.with_particles && !findings.touches("particles");  // only then are the ids reliable
  loaded.scene.structure =
      load_structure(json, loaded.scene, folder, ties, findings, loaded.particles, loaded.warnings, loaded.fields);
  if (findings.empty()) refuse_overlaps(loaded.scene, loaded.particles, options, findings);
  if (!findings.empty()) return refuse();
  for (Finding& warning : default_warnings(loaded.scene)) loaded.warnings.push_back(std::move(warning));
  loaded.resolved = pretty(json);
  return loaded;
}

}  // namespace

Expected<LoadedScene> parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                  const LoadOptions& options) {
  // The libraries used below throw; no scene should make them throw, and no exception leaves this function.
  try {
    return parse(text, name, folder, options);
  } catch (const std::bad_alloc&) {
    return fail(Error::Kind::bad_input, name, "needs more memory than there is");
  } catch (const std::exception& fault) {
    return fail(Error::Kind::bad_input, name, std::string("can't be read: ") + fault.what());
  }
}

Expected<LoadedScene> load_scene(const std::filesystem::path& file, const LoadOptions& options) {
  constexpr std::uint64_t kLargestScene = std::uint64_t{64} << 20U;  // particles by the million belong in CSV files
  const auto text = read_text_file(file, kLargestScene);
  if (!text) return fail(text.error());
  return parse_scene(*text, file.string(), file.parent_path(), options);
}

}  // namespace hooke::scene
