// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/io/polydata_file.h"

#include <fmt/format.h>
#include <strings.h>

#include <numeric>

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
template <>
constexpr const char* kTypeName<std::uint8_t> = "UInt8";

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

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

}  // namespace

PolyDataFile::PolyDataFile(Cells cells, std::size_t point_count, double time)
    : cells_(cells),
      point_count_(point_count),
      time_(time) {}

template <class T>
std::string PolyDataFile::declare(const char* name, const std::vector<T>& values, int components) {
  const std::string element =
      fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)"
                  "\n",
                  kTypeName<T>, name, components, bytes_.size());
  const std::uint64_t size = values.size() * sizeof(T);
  bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
  bytes_.append(reinterpret_cast<const char*>(values.data()), size);
  return element;
}

template std::string PolyDataFile::declare(const char*, const std::vector<float>&, int);
template std::string PolyDataFile::declare(const char*, const std::vector<double>&, int);
template std::string PolyDataFile::declare(const char*, const std::vector<std::int64_t>&, int);
template std::string PolyDataFile::declare(const char*, const std::vector<std::uint16_t>&, int);
template std::string PolyDataFile::declare(const char*, const std::vector<std::uint8_t>&, int);

void PolyDataFile::write(const fs::path& file) {
  const std::size_t corners = cells_ == Cells::lines ? 2 : 1;
  std::vector<std::int64_t> connectivity(point_count_), ends(point_count_ / corners);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t c = 0; c < ends.size(); ++c) ends[c] = static_cast<std::int64_t>((c + 1) * corners);
  const std::string topology = declare("connectivity", connectivity, 1) + declare("offsets", ends, 1);
  const char* const cells = cells_ == Cells::lines ? "Lines" : "Verts";

  OutputFile out(file);
  out.write(fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<PolyData>\n"
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n"
      "<PointData{}>\n{}</PointData>\n<CellData>\n{}</CellData>\n<Points>\n{}</Points>\n<{}>\n{}</{}>\n"
      "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_",
      number(time_), point_count_, cells_ == Cells::vertices ? ends.size() : 0,
      cells_ == Cells::lines ? ends.size() : 0, vectors_.empty() ? "" : fmt::format(" Vectors=\"{}\"", vectors_),
      point_data_, cell_data_, points_, cells, topology, cells));
  out.write(bytes_);
  out.write("\n</AppendedData>\n</VTKFile>\n");
  out.finish();
}

std::vector<fs::path> export_polydata(const ExportJob& job,
                                      const std::function<void(std::size_t, const fs::path&)>& write) {
  const bool is_collection = strcasecmp(job.file.extension().c_str(), ".pvd") == 0;
  if (!is_collection && job.indices.size() == 1) {
    write(job.indices.front(), job.file);
    return {job.file};
  }
  const fs::path pieces = fs::path(job.file).replace_extension(".vtp");
  std::vector<fs::path> written{is_collection ? job.file : fs::path(job.file).replace_extension(".pvd")};
  std::string collection =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t k = 0; k < job.indices.size(); ++k) {
    const fs::path file = numbered_file(pieces, k, job.indices.size());
    write(job.indices[k], file);
    written.push_back(file);
    collection += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                              number(job.run.times()[job.indices[k]]), xml_text(file.filename().string()));
  }
  OutputFile out(written.front());
  out.write(collection + "</Collection>\n</VTKFile>\n");
  out.finish();
  return written;
}

}  // namespace hooke
