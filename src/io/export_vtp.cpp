// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <numeric>

#include "hooke/io/export_format.h"
#include "hooke/io/failure.h"
#include "hooke/io/output_file.h"

namespace hooke {

namespace {

namespace fs = std::filesystem;

template <class T>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<float> = "Float32";
template <>
constexpr const char* kTypeName<double> = "Float64";
template <>
constexpr const char* kTypeName<std::int64_t> = "Int64";
template <>
constexpr const char* kTypeName<std::uint16_t> = "UInt16";

/// The arrays of a file: declared in its XML, their bytes appended behind it.
class AppendedArrays {
 public:
  /// The XML element of an array whose values come next.
  template <class T>
  std::string declare(const char* name, const std::vector<T>& values, int components) {
    const std::string element =
        fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)"
                    "\n",
                    kTypeName<T>, name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

template <class Real>
std::vector<Real> flatten(const std::vector<Vec3d>& vectors) {
  std::vector<Real> values;
  values.reserve(3 * vectors.size());
  for (const Vec3d& v : vectors) {
    for (const double c : {v.x, v.y, v.z}) values.push_back(static_cast<Real>(c));
  }
  return values;
}

template <class Real>
void write_vtp(const Snapshot& snapshot, const RunInfo& info, const fs::path& file) {
  const ParticleSet& p = snapshot.particles;
  std::vector<Real> radius;
  for (const std::uint16_t material : p.material) radius.push_back(static_cast<Real>(info.materials[material].radius));
  std::vector<std::int64_t> first_vertices(p.size()), vertex_ends(p.size());
  std::iota(first_vertices.begin(), first_vertices.end(), 0);
  std::iota(vertex_ends.begin(), vertex_ends.end(), 1);

  AppendedArrays arrays;
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<PolyData>\n";
  std::string time;
  append_number(time, snapshot.time);
  xml += fmt::format(
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n",
      time);
  xml += fmt::format(
      "<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      p.size());
  xml += "<PointData Vectors=\"velocity\">\n";
  xml += arrays.declare("id", std::vector<std::int64_t>(p.id.begin(), p.id.end()), 1);
  xml += arrays.declare("velocity", flatten<Real>(p.velocity), 3);
  xml += arrays.declare("radius", radius, 1);
  xml += arrays.declare("material", p.material, 1);
  xml += "</PointData>\n<Points>\n";
  xml += arrays.declare("Points", flatten<Real>(p.position), 3);
  xml += "</Points>\n<Verts>\n";
  xml += arrays.declare("connectivity", first_vertices, 1);
  xml += arrays.declare("offsets", vertex_ends, 1);
  xml += "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";

  OutputFile out(file);
  out.write(xml);
  out.write(arrays.bytes());
  out.write("\n</AppendedData>\n</VTKFile>\n");
  out.finish();
}

void write_vtp(const RunReader& run, std::size_t index, const fs::path& file) {
  const Snapshot snapshot = take(run.read(index));
  if (run.info().precision == Precision::single_precision) {
    write_vtp<float>(snapshot, run.info(), file);
  } else {
    write_vtp<double>(snapshot, run.info(), file);
  }
}

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::vector<fs::path> export_vtp(const ExportJob& job) {
  if (job.indices.size() > 1) {
    return export_pvd({job.run, job.indices, fs::path(job.file).replace_extension(".pvd"), job.options});
  }
  write_vtp(job.run, job.indices.front(), job.file);
  return {job.file};
}

std::vector<fs::path> export_pvd(const ExportJob& job) {
  std::vector<fs::path> written{job.file};
  std::string collection =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t k = 0; k < job.indices.size(); ++k) {
    const fs::path file = numbered_file(fs::path(job.file).replace_extension(".vtp"), k, job.indices.size());
    write_vtp(job.run, job.indices[k], file);
    written.push_back(file);
    std::string time;
    append_number(time, job.run.times()[job.indices[k]]);
    collection +=
        fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, xml_text(file.filename().string()));
  }
  OutputFile out(job.file);
  out.write(collection + "</Collection>\n</VTKFile>\n");
  out.finish();
  return written;
}

}  // namespace hooke
