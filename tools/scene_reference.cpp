// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Writes docs/scene.md from the schema and the example beside it:
//     scene_reference schema/scene.json schema/example.json > docs/scene.md

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace {

using Json = nlohmann::ordered_json;

std::string type_of(const Json& part) {
  if (part.contains("$ref")) {
    const std::string reference = part.at("$ref"), name = reference.substr(reference.rfind('/') + 1);
    return "[" + name + "](#" + name + ")";
  }
  if (part.contains("const")) return part.at("const").dump();
  if (part.contains("anyOf")) {
    std::string types;
    for (const Json& branch : part.at("anyOf")) types += (types.empty() ? "" : ", or ") + type_of(branch);
    return types;
  }
  if (part.contains("enum")) {
    std::string names;
    for (const Json& name : part.at("enum")) names += (names.empty() ? "`" : ", `") + name.dump() + "`";
    return names;
  }
  const std::string type = part.at("type");
  if (type == "integer") return "whole number";
  if (type == "string") return "text";
  if (type == "boolean") return "`true`, `false`";
  if (type != "array") return type;
  const std::string of =
      part.contains("items") && part.at("items").contains("type") ? type_of(part.at("items")) : "value";
  const std::string many = of.rfind("list ", 0) == 0 ? "lists" + of.substr(4) : of + "s";
  if (!part.contains("maxItems")) return "list of " + many;
  return "list of " + part.at("maxItems").dump() + (part.at("items").contains("enum") ? ", each " + of : " " + many);
}

std::string range_of(const Json& part) {
  std::string range;
  const auto add = [&](const char* keyword, const char* sign) {
    if (part.contains(keyword)) range += (range.empty() ? "" : ", ") + (sign + part.at(keyword).dump());
  };
  for (const Json& branch : part.value("anyOf", Json::array())) {
    if (range.empty()) range = range_of(branch);
  }
  add("exclusiveMinimum", "> ");
  add("minimum", ">= ");
  // The limit of exact whole numbers would only be noise here.
  if (part.contains("maximum") && part.at("maximum") != 9007199254740992) add("maximum", "<= ");
  return range;
}

bool is_required(const Json& object, const std::string& key) {
  for (const Json& name : object.value("required", Json::array())) {
    if (name == key) return true;
  }
  return false;
}

std::string fallback_of(const Json& object, const std::string& key, const Json& part) {
  if (is_required(object, key)) return "required";
  return part.contains("default") ? "`" + part.at("default").dump() + "`" : "";
}

// The object that an entry of the scene holds, if it holds any: itself, an entry of a list, or a named one.
const Json* object_in(const Json& part, std::string& path) {
  if (part.contains("properties")) return &part;
  if (part.contains("items") && part.at("items").contains("properties")) {
    path += "[]";
    return &part.at("items");
  }
  if (part.contains("placeholder")) {
    path += "." + part.at("placeholder").get<std::string>();
    return &part.at("additionalProperties");
  }
  return nullptr;
}

void write_object(const Json& object, const std::string& path) {
  std::cout << "\n## " << (path.empty() ? "The scene" : "`" + path + "`") << "\n\n"
            << object.at("description").get<std::string>() << "\n\n"
            << "| key | what | type | unit | range | default |\n|---|---|---|---|---|---|\n";
  for (const auto& [key, part] : object.at("properties").items()) {
    std::string description = part.at("description");
    if (part.contains("examples")) description += " For instance `" + part.at("examples").front().dump() + "`.";
    std::cout << "| `" << key << "` | " << description << " | " << type_of(part) << " | " << part.value("unit", "")
              << " | " << range_of(part) << " | " << fallback_of(object, key, part) << " |\n";
  }
  for (const auto& [key, part] : object.at("properties").items()) {
    std::string below = path.empty() ? key : path + "." + key;
    if (const Json* inner = object_in(part, below)) write_object(*inner, below);
  }
}

std::string read(const char* file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "usage: scene_reference SCHEMA EXAMPLE\n";
    return 2;
  }
  std::cout
      << "<!-- Made from schema/scene.json and schema/example.json by tools/scene_reference.cpp; edit those. -->\n"
         "# Scene files\n\n"
         "A scene is JSON with `//` and `/* */` comments, UTF-8, at most 64 levels deep. SI units. Everything is\n"
         "checked before anything runs: unknown keys, wrong types and values out of range are errors that name the\n"
         "JSON path, the value and what is allowed, up to 200 of them at once. `hooke schema` prints the JSON Schema\n"
         "behind this page; an editor that is pointed to it completes and checks as you type.\n\n"
         "```jsonc\n"
      << read(argv[2])
      << "```\n\n"
         "## Particle files\n\n"
         "The extension of a file says what it is. Positions are required; velocities, ids and materials are read\n"
         "where present and go before what the entry says. SI units throughout.\n\n"
         "| extension | what | columns | material |\n|---|---|---|---|\n"
         "| `.csv`, `.txt` | a header, then a particle a line | `x`, `y`, `z`, `vx`, `vy`, `vz`, `id`, `material` "
         "| a name |\n"
         "| `.ply` | PLY, ascii or binary in either order of bytes: the vertices | `x`, `y`, `z`; `vx`, `vy`, `vz`, "
         "or `velocity_x` ..., or a list `velocity`; `id`, `id_high` (the upper 32 bits); `material`; `radius` or "
         "`pscale`, `mass` | a number from 0, named by lines `comment material 0 water` |\n"
         "| `.xyz`, `.extxyz` | XYZ, plain (species, x, y, z) or extended | `pos`, `velo` (or `vel`, `velocity`, "
         "`velocities`), `id`, `species`, `type`, `radius`, `mass` | a name, or a number from 1 |\n"
         "| `.data`, `.lmp` | LAMMPS data file; the section `Atoms # STYLE`, of `sphere`, `atomic`, `charge`, "
         "`molecular` or `full`; `Velocities` | those of the style | a number from 1, named by the section "
         "`Atom Type Labels`, by comments of the section `Masses` (`1 18.0 # water`), or by comments of the head "
         "(`# type 1 water`) |\n"
         "| `.dump`, `.lammpstrj` | LAMMPS dump, as text | `x`, else `xu`, `xs`, `xsu`, and so on; `vx`, `vy`, `vz`, "
         "`id`, `element`, else `type`; `radius` or `diameter`, `mass` | a name (`element`), or a number from 1 |\n\n"
         "A name is that of a material of the scene; but for CSV, `salt%20water` is `salt water`, or else a material\n"
         "that is called `salt%20water`. What has only a number is of the entry's `material`, or without one of the\n"
         "scene's material in that place. `types` comes before all of this:\n"
         "`\"types\": { \"1\": \"oil\", \"Ar\": \"water\" }`.\n\n"
         "A material fixes the radius and the mass of its particles: where a file has others, a warning names the\n"
         "worst (of a CSV file they are ignored). Columns that Hooke does not read are ignored, with a warning.\n"
         "Particles without an id number on from the largest one so far. A path is relative to the scene's folder and\n"
         "may not leave it without `--allow-outside`. A file without particles is an error, and so is a box of the\n"
         "file that is tilted or of another size where the domain is periodic. Lines end with LF, CRLF or CR; a byte\n"
         "order mark is passed over. Errors name file and line, the first being line 1; in a binary file the byte.\n\n"
         "## Changing a value for one run\n\n"
         "`--set PATH=VALUE` puts a JSON value at a path, and is checked like the scene: `--set time.step=0.002`,\n"
         "`--set particles[0].block.count=1000`, `--set 'materials[\"salt water\"].radius=0.1'`. A key that excludes\n"
         "another (`time.end`, `time.steps`) takes its place.\n";
  const Json schema = Json::parse(read(argv[1]));
  write_object(schema, "");
  for (const auto& [name, definition] : schema.at("definitions").items()) write_object(definition, name);
  return 0;
} catch (const std::exception& fault) {
  std::cerr << "scene_reference: " << fault.what() << '\n';
  return 1;
}
