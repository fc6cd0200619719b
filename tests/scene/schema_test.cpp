// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/schema.h"

#include <gtest/gtest.h>

#include "hooke/scene/load_scene.h"
#include "hooke/scene/schema_check.h"
#include "minimal_scene.h"

namespace hooke {
namespace {

// Calls `look` with every part of the schema that constrains a value, and its path.
template <class Look>
void walk(const scene::Json& schema, const std::string& path, Look look) {
  look(schema, path);
  for (const char* keyword : {"items", "additionalProperties"}) {
    if (schema.contains(keyword) && schema.at(keyword).is_object())
      walk(schema.at(keyword), path + "." + keyword, look);
  }
  if (!schema.contains("properties")) return;
  for (const auto& property : schema.at("properties").items())
    walk(property.value(), path + "." + property.key(), look);
}

TEST(Schema, DescribesEveryKey) {
  walk(scene::schema_root(), "", [](const scene::Json& part, const std::string& path) {
    if (path.size() >= 6 && path.substr(path.size() - 6) == ".items" && part.value("type", "") != "object") return;
    EXPECT_TRUE(part.contains("description")) << path;
    if (part.value("type", "") == "object") {
      EXPECT_TRUE(part.contains("additionalProperties")) << path << " lets unknown keys pass";
    }
  });
}

TEST(Schema, IsWhatIsPublished) {
  EXPECT_EQ(scene::Json::parse(scene::scene_schema()).at("$schema"), "http://json-schema.org/draft-07/schema#");
}

TEST(Schema, DefaultsAreThoseOfTheStructs) {
  const auto loaded = scene::parse_scene(kMinimalScene, "scene.json", ".");
  ASSERT_TRUE(loaded) << loaded.error().text();
  const Scene plain;
  EXPECT_EQ(loaded->scene.integrator, plain.integrator);
  EXPECT_EQ(loaded->scene.precision, plain.precision);
  EXPECT_EQ(loaded->scene.gravity, plain.gravity);
  EXPECT_EQ(loaded->scene.domain.boundary, plain.domain.boundary);
  EXPECT_EQ(loaded->scene.materials[0].contact.shear, Material{}.contact.shear);
  EXPECT_EQ(loaded->scene.materials[0].contact.damping, Material{}.contact.damping);
  EXPECT_EQ(loaded->scene.materials[0].drag, Material{}.drag);
  EXPECT_EQ(loaded->scene.materials[0].color, Material{}.color);
}

TEST(Schema, DefaultsObeyIt) {
  walk(scene::schema_root(), "", [](const scene::Json& part, const std::string& path) {
    if (!part.contains("default")) return;
    const scene::Json& branch = scene::chosen_branch(part, part.at("default"));
    EXPECT_TRUE(scene::has_type(branch, part.at("default"))) << path;
    if (branch.contains("enum")) {
      const scene::Json& names = branch.at("enum");
      EXPECT_NE(std::find(names.begin(), names.end(), part.at("default")), names.end()) << path;
    }
  });
}

TEST(Schema, SaysWhatIsAllowed) {
  const auto allowed = [](const char* text) { return scene::allowed_by(scene::Json::parse(text)); };
  EXPECT_EQ(allowed(R"({"type":"number","exclusiveMinimum":0,"unit":"m"})"), "a number > 0 (m)");
  EXPECT_EQ(allowed(R"({"type":"integer","minimum":1,"maximum":9})"), "a whole number >= 1 and <= 9");
  EXPECT_EQ(allowed(R"({"type":"string","enum":["a","b","c"]})"), R"("a", "b" or "c")");
  EXPECT_EQ(allowed(R"({"type":"array","items":{"type":"number"},"minItems":3,"maxItems":3})"), "a list of 3 numbers");
  EXPECT_EQ(allowed(R"({"anyOf":[{"const":1},{"type":"object"}]})"), "1, or an object {...}");
}

}  // namespace
}  // namespace hooke
