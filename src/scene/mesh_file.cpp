// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <tuple>
#include <unordered_map>

#include "hooke/base/hash.h"
#include "hooke/scene/text_file.h"

namespace hooke {
namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30U;

// A text in memory as a stream.
class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(const std::string& text) : text_(text) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (text_.size() - at_) / size);
    std::memcpy(to, text_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : text_.size();
    if (origin == aiOrigin_END ? offset > from : offset > text_.size() - from) return aiReturn_FAILURE;
    at_ = origin == aiOrigin_END ? from - offset : from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return text_.size(); }
  void Flush() override {}

 private:
  const std::string& text_;
  std::size_t at_ = 0;
};

// A file system that holds one file and no other.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, const std::string& text) : name_(std::move(name)), text_(text) {}

  bool Exists(const char* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char*) override {
    return Exists(name) ? new MemoryStream(text_) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  const std::string& text_;
};

struct PlaceHash {
  std::size_t operator()(const std::array<float, 3>& x) const {
    std::uint64_t hash = 0;
    for (const float c : x) hash = combine64(hash, std::bit_cast<std::uint32_t>(c + 0.0f));
    return hash;
  }
};

// Collects triangles and merges vertices at the same position.
class Welder {
 public:
  void add(const aiMesh& mesh) {
    std::vector<std::uint32_t> index(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& x = mesh.mVertices[v];
      finite = finite && std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
      const auto next = static_cast<std::uint32_t>(out.vertices.size());
      const auto [found, added] = places_.try_emplace({x.x + 0.0f, x.y + 0.0f, x.z + 0.0f}, next);
      if (added) out.vertices.push_back({x.x, x.y, x.z});
      index[v] = found->second;
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      const std::array<std::uint32_t, 3> t{index[face.mIndices[0]], index[face.mIndices[1]], index[face.mIndices[2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.triangles.push_back(t);
    }
  }

  TriangleMesh out;
  bool finite = true;

 private:
  std::unordered_map<std::array<float, 3>, std::uint32_t, PlaceHash> places_;
};

}  // namespace

Expected<TriangleMesh> read_mesh(const std::filesystem::path& file) {
  const auto refuse = [](std::string why) { return fail(Error::Kind::bad_input, "", std::move(why)); };
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".obj" && extension != ".stl" && extension != ".ply") {
    return refuse("is of no format of meshes that can be read: .obj, .stl, .ply");
  }
  const auto text = read_text_file(file, kLargestFile);
  if (!text) return refuse(text.error().findings.front().message);
  Assimp::Importer importer;
  const std::string name = "mesh" + extension;
  importer.SetIOHandler(new OneFile(name, *text));  // the importer owns it from now on
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_COLORS | aiComponent_TEXCOORDS |
                                                          aiComponent_MATERIALS);
  const aiScene* scene =
      importer.ReadFile(name, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) return refuse(std::string("can't be read as a mesh: ") + importer.GetErrorString());
  Welder welder;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) welder.add(*scene->mMeshes[m]);
  if (!welder.finite) return refuse("holds a vertex that is at no finite place");
  if (welder.out.triangles.empty()) return refuse("holds no triangles");
  return std::move(welder.out);
}

std::size_t count_open_edges(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back(std::uint64_t{a} << 32U | b);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    open += (last - first) % 2;
  }
  return open;
}

}  // namespace hooke
