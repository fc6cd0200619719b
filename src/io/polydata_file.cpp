// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/io/polydata_file.h"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <numeric>

#include "hooke/base/assert.h"
#include "hooke/io/output_file.h"

namespace hooke::io {

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

void append_base64(std::string& text, const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;  // three bytes, four digits
    for (std::size_t k = i; k < i + 3; ++k) {
      group = group << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= std::min<std::size_t>(bytes.size() - i, 3) ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
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
      time_(time) {
  HOOKE_ASSERT(cells == Cells::vertices || point_count % 2 == 0, point_count);
}

template <class T>
std::string PolyDataFile::array(const char* name, const std::vector<T>& values, int components) {
  std::string element = fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">)",
                                    kTypeName<T>, name, components);
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
  append_base64(element, bytes);
  return element + "</DataArray>\n";
}

template std::string PolyDataFile::array(const char*, const std::vector<float>&, int);
template std::string PolyDataFile::array(const char*, const std::vector<double>&, int);
template std::string PolyDataFile::array(const char*, const std::vector<std::int64_t>&, int);
template std::string PolyDataFile::array(const char*, const std::vector<std::uint16_t>&, int);
template std::string PolyDataFile::array(const char*, const std::vector<std::uint8_t>&, int);

void PolyDataFile::write(const fs::path& file) {
  HOOKE_ASSERT(!points_.empty());
  const std::size_t corners = cells_ == Cells::lines ? 2 : 1;
  std::vector<std::int64_t> connectivity(point_count_), ends(point_count_ / corners);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t c = 0; c < ends.size(); ++c) ends[c] = static_cast<std::int64_t>((c + 1) * corners);
  const std::string topology = array("connectivity", connectivity, 1) + array("offsets", ends, 1);
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
      "<PointData{}>\n",
      number(time_), point_count_, cells_ == Cells::vertices ? ends.size() : 0,
      cells_ == Cells::lines ? ends.size() : 0, vectors_.empty() ? "" : fmt::format(" Vectors=\"{}\"", vectors_)));
  out.write(point_data_);
  out.write("</PointData>\n<CellData>\n");
  out.write(cell_data_);
  out.write("</CellData>\n<Points>\n");
  out.write(points_);
  out.write(fmt::format("</Points>\n<{}>\n", cells));
  out.write(topology);
  out.write(fmt::format("</{}>\n</Piece>\n</PolyData>\n</VTKFile>\n", cells));
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
  const fs::path list = is_collection ? job.file : fs::path(job.file).replace_extension(".pvd");
  WrittenFiles written;
  std::string collection =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (std::size_t k = 0; k < job.indices.size(); ++k) {
    const fs::path file = numbered_file(pieces, k, job.indices.size());
    write(job.indices[k], file);
    written.add(file);
    collection += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                              number(job.run.times()[job.indices[k]]), xml_text(file.filename().string()));
  }
  OutputFile out(list);
  out.write(collection + "</Collection>\n</VTKFile>\n");
  out.finish();
  std::vector<fs::path> files = written.keep();
  files.insert(files.begin(), list);
  return files;
}

}  // namespace hooke::io
